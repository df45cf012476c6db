// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "refine/fuse.h"

namespace sslcd {

/// A camera drives past one place twice, 300 m of path between the visits: frames 0..9 and
/// 300..309, a metre a frame.
struct TwoVisits {
  WholeMapOptions options;
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  ObjectMap& map = state.map;
  FrameStore& frames = state.frames;

  TwoVisits() {
    for (const int first : {0, 300}) {
      for (int i = 0; i < 10; ++i) {
        FrameRecord record;
        record.frame = first + i;
        record.stamp = record.frame;
        record.T_odom_cam = Pose::Trans(0, 0, record.frame);
        record.T_world_cam = Pose::Trans(0, 0, i);
        frames.Append(record);
      }
    }
  }

  /// Seen by `count` frames from frame number `first` on, without error.
  LandmarkId Add(const Vec3& position, int first, int count, const std::string& label = "Tree",
                 double yaw = 0) {
    MapLandmark landmark;
    landmark.label = label;
    landmark.symmetry = label == "Tree" ? Symmetry::kFull : Symmetry::kNone;
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose = {position, yaw};
    landmark.dims = label == "Tree" ? Vec3(0.5, 0.5, 3) : Vec3(4, 1.8, 1.5);
    const LandmarkId id{next_id++};
    for (int f = 0; f < frames.size(); ++f) {
      const FrameRecord& record = frames[f];
      if (record.frame < first || record.frame >= first + count) continue;
      const Pose T_cam_object = record.T_world_cam.inverse() * ToPose(landmark.pose, map.gravity());
      landmark.sightings.push_back(
          {record.frame, record.stamp, 0, 1., T_cam_object, landmark.dims});
      std::vector<LandmarkId> matched = record.matched;
      matched.push_back(id);
      frames.SetMatched(f, matched);
    }
    EXPECT_EQ(map.Insert(landmark).value, id.value);
    return id;
  }
  bool Gone(LandmarkId id) const { return map.landmarks().count(id.value) == 0; }

  int next_id = 1;
};

}  // namespace sslcd
