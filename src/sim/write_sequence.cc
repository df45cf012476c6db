// SPDX-License-Identifier: BSD-3-Clause
#include "sim/write_sequence.h"

#include <string>

#include "datasets/sequence_writer.h"
#include "formats/atomic_file.h"

namespace sslcd::sim {

void WriteSequence(const World& world, const Trajectory& odometry,
                   const SimulatedDetections& detections, const std::filesystem::path& folder,
                   bool overwrite) {
  const FileLock lock = PrepareSequenceFolder(folder, overwrite);
  SequenceFiles files;
  files.comment = "a synthetic world; axes of the first camera: x right, y down, z forward";
  files.camera = StereoCamera{world.camera, world.baseline_m};
  files.odometry = odometry;
  files.groundtruth = world.truth;
  files.detections = detections.frames;
  files.up_axis = world.gravity.up;
  files.labels = world.labels;
  WriteSequenceFiles(folder, files);
  std::string identities;
  for (const int id : detections.identity) identities += std::to_string(id) + "\n";
  WriteFileAtomically((folder / "landmark_ids.txt").string(), identities);
}

}  // namespace sslcd::sim
