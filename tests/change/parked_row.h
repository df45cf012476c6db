// SPDX-License-Identifier: BSD-3-Clause
// Sessions that drive along a row of objects, some of which come and go.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "change/explain.h"

namespace sslcd {

struct RowObject {
  std::string label;
  double x = 0, z = 0;  ///< to the right of the path, and along it [m]
  /// what stands there in each session; 0: nothing, others: how it looks
  std::vector<int> there;
  Vec3 dims{4, 1.8, 1.5};
};

struct ParkedRow {
  std::vector<RowObject> objects;
  int sessions = 2;
  std::vector<double> length_m = {100, 100, 100, 100, 100};  ///< of each session's path
  std::vector<int> map = {0, 0, 0, 0, 0};                    ///< of each session
  bool own_landmarks = false;  ///< of each session, half a metre apart

  MapHistory History() const {
    HistoryWorld world;
    world.sessions = sessions;
    world.labels.Set("Pole", {Symmetry::kFull});
    std::vector<HistoryFrame> frames;
    for (int s = 0; s < sessions; ++s) Drive(s, world, frames);
    Sightings sightings(world);
    for (const HistoryFrame& frame : frames) sightings.AddFrame(frame);
    return Explain(sightings);
  }

 private:
  // Detects nine objects of ten within 30 m and 45 degrees, those in front hide nothing.
  void Drive(int session, HistoryWorld& world, std::vector<HistoryFrame>& frames) const {
    const GravityFrame gravity;
    if (session == 0 || own_landmarks)
      for (std::size_t i = 0; i < objects.size(); ++i) {
        MapObject landmark;
        landmark.id.value = static_cast<int>(world.objects.size()) + 1;
        landmark.label = objects[i].label;
        landmark.state = LandmarkState::kConfirmed;
        landmark.T_world_object =
            Pose(gravity.Upright(0.3), Vec3(objects[i].x, 0, objects[i].z + 0.5 * session));
        landmark.dims = objects[i].dims;
        world.objects.push_back(landmark);
      }
    std::mt19937 random(session);
    for (double z = 0; z < length_m[session]; z += 1) {
      HistoryFrame frame;
      frame.number = static_cast<int>(frames.size());
      frame.session = session;
      frame.map = map[session];
      frame.stamp = 0.2 * z;
      frame.T_world_cam = Pose(lie::SO3<double>(), Vec3(0, 0, z));
      for (std::size_t i = 0; i < objects.size(); ++i) {
        const double ahead = objects[i].z - z;
        const bool lucky = random() % 10 > 0;
        if (objects[i].there[session] == 0 || !lucky || IsHidden(session, i, z) ||
            ahead < std::abs(objects[i].x) || std::hypot(ahead, objects[i].x) > 30)
          continue;
        Detection detection;
        detection.row = static_cast<int>(i);
        detection.label = objects[i].label;
        detection.dims = objects[i].dims;
        detection.T_cam_object =
            Pose(gravity.Upright(0.3), Vec3(objects[i].x, 0, objects[i].z - z));
        const double look = 1.5 * objects[i].there[session];
        detection.appearance[Cue::kEmbedding] = {static_cast<float>(std::cos(look)),
                                                 static_cast<float>(std::sin(look))};
        frame.detections.push_back(detection);
        const std::size_t first = own_landmarks ? session * objects.size() : 0;
        world.objects[first + i].observations.push_back({frame.number, detection.row});
      }
      frames.push_back(frame);
    }
  }

  bool IsHidden(int session, std::size_t i, double z) const {
    const auto silhouette = [&](const RowObject& object) {
      return SilhouetteOf(Pose(GravityFrame().Upright(0.3), Vec3(object.x, 0, object.z - z)),
                          object.dims);
    };
    std::vector<Silhouette> others;
    for (const RowObject& other : objects)
      if (other.there[session] > 0 && other.z > z) others.push_back(silhouette(other));
    return VisibleFraction(silhouette(objects[i]), others) < 0.3;
  }
};

// Cars and poles in turns along the path, all there in all sessions.
inline ParkedRow StandingRow(int sessions) {
  ParkedRow row;
  row.sessions = sessions;
  for (int i = 0; i < 12; ++i)
    row.objects.push_back(i % 3 > 0 ? RowObject{"Car", i % 2 ? 5. : -5., 10 + 8. * i,
                                                std::vector<int>(sessions, i + 1)}
                                    : RowObject{"Pole",
                                                i % 2 ? 4. : -4.,
                                                10 + 8. * i,
                                                std::vector<int>(sessions, 1),
                                                {0.4, 0.4, 4}});
  return row;
}

}  // namespace sslcd
