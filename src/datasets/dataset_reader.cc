// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/dataset_reader.h"

#include "sslcd/datasets/dataset.h"

namespace sslcd {

// To add a format, define such a function in a file of its own and add a line to the table below.
DatasetReader SequenceFolderReader();
DatasetReader KittiOdometryReader();
DatasetReader KittiRawReader();
DatasetReader KittiTrackingReader();

const std::vector<DatasetReader>& DatasetReaders() {
  static const std::vector<DatasetReader> readers = {
      SequenceFolderReader(),
      KittiOdometryReader(),
      KittiRawReader(),
      KittiTrackingReader(),
  };
  return readers;
}

std::vector<std::string> DatasetFormatNames() {
  std::vector<std::string> names = {"auto"};
  for (const DatasetReader& reader : DatasetReaders()) names.push_back(reader.name);
  return names;
}

}  // namespace sslcd
