// SPDX-License-Identifier: BSD-3-Clause
// Finds a drive in a map in a file, without any prior pose (sslcd::store).
//   08_relocalise SEQUENCE FILE    SEQUENCE as in docs/formats.md; FILE: see 07_map_file
#include <sslcd/sslcd.h>
#include <sslcd/store/map_store.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  sslcd::DatasetRequest request;
  request.path = argv[1];
  const sslcd::Dataset data = sslcd::LoadDataset(request);
  // snippet: relocalise
  const sslcd::MapStore store(argv[2]);
  sslcd::Localiser localiser(store.Reference(), sslcd::Options(), data.camera);
  for (const sslcd::Frame& frame : data.frames) {
    const std::optional<sslcd::Localisation> found = localiser.AddFrame(frame);
    if (!found) continue;  // an attempt every 5 m
    if (found->decision == sslcd::LoopDecision::kAccepted) {
      const Eigen::Vector3d at = found->T_map_cam.translation();
      std::printf("frame %d is at %.1f %.1f %.1f\n", found->frame, at.x(), at.y(), at.z());
      break;
    }
    std::printf("frame %d: %s\n", found->frame, found->reason.c_str());
  }
}
