// SPDX-License-Identifier: BSD-3-Clause
#include "dataset_options.h"

namespace sslcd::apps {

void AddTo(CLI::App& command, DatasetRequest& request) {
  command.add_option("--format", request.format, "layout of the folder; guessed where not given")
      ->check(CLI::IsMember(DatasetFormatNames()));
  command.add_option("--sequence", request.sequence, "which sequence of the dataset, e.g. 0007");
  command.add_option("--detections", request.detections,
                     "file or folder, relative to DATASET or the current folder");
  command.add_option("--odometry", request.odometry, "poses, likewise");
}

}  // namespace sslcd::apps
