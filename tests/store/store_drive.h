// SPDX-License-Identifier: BSD-3-Clause
// Short drives for the tests of maps in files, and a map made of them.
#pragma once

#include <string>
#include <vector>

#include "../support/temp_folder.h"
#include "formats/g2o.h"
#include "formats/loops_csv.h"
#include "formats/map_json.h"
#include "sim/sensor.h"
#include "sim/world.h"
#include "sslcd/formats/poses.h"
#include "sslcd/store/map_session.h"

namespace sslcd {

struct StoreDrive {
  sim::World world;
  std::vector<Frame> frames;

  explicit StoreDrive(sim::World w, std::uint64_t seed) : world(std::move(w)) {
    frames = sim::MakeFrames(sim::SimulateOdometry(world.truth, {}, seed),
                             sim::SimulateDetections(world, {}, seed));
    frames[1].step = StepUncertainty{false, 0.01, 0.001};
    for (Frame& frame : frames)
      for (Detection& detection : frame.detections)
        detection.appearance[Cue::kEmbedding] = {0.6f, 0.8f};
  }
  MapperContext Context() const { return {world.gravity, world.labels, world.camera}; }
};

inline StoreDrive ShortStreet(int frames = 60, std::uint64_t seed = 1) {
  sim::StreetOptions options;
  options.frames = frames;
  return StoreDrive(sim::MakeStreet(seed, options), seed);
}

// What a run would write of a mapper's results, so that one comparison holds all bytes.
inline std::string TextOf(const Mapper& mapper) {
  return TumText(mapper.CameraTrajectory()) + MapJson({mapper.gravity().up, mapper.Objects()}) +
         G2oText(mapper.Graph()) + LoopsCsv(WithoutEarly(mapper.LoopClosures()));
}
inline std::string TextOf(const MapResults& results, const Vec3& up) {
  std::string text;
  for (const SessionPath& path : results.paths) text += TumText(path.trajectory);
  return text + MapJson({up, results.objects}) + G2oText(results.graph) + LoopsCsv(results.loops);
}

inline MapSession BeginSession(const std::string& path, const std::string& name,
                               const StoreDrive& drive) {
  return MapSession::Begin(path, {name, "a drive", "a command", "a test"}, drive.Context(), {});
}

// Adds the frames that are not stored yet, refines and ends.
inline void Finish(const StoreDrive& drive, MapSession& session) {
  for (const Frame& frame : drive.frames)
    if (!session.IsStored(frame)) session.AddFrame(frame);
  session.Refine();
  session.End();
}

// A map of one session that has ended.
inline std::string MakeMap(const TempFolder& folder, const StoreDrive& drive) {
  const std::string path = folder.In("site.db");
  MapSession session = BeginSession(path, "one", drive);
  Finish(drive, session);
  return path;
}

}  // namespace sslcd
