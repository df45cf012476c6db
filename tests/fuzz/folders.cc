// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/run_folder.h"
#include "input_file.h"
#include "sslcd/datasets/dataset.h"
#include "targets.h"

namespace sslcd::fuzz {

Targets Folders() {
  return {
      {"dataset",
       [](const std::string& text) {
         DatasetRequest request;
         request.path = FolderWith(text);
         request.odometry_policy = request.detections_policy = PartPolicy::kIfThere;
         LoadDataset(request);
       }},
      {"run_folder", [](const std::string& text) { CheckRunFolder(FolderWith(text)); }},
  };
}

}  // namespace sslcd::fuzz
