// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "closing/pass_map.h"

namespace sslcd {

/// A camera drives 60 m through a grove, round a detour of 240 m, and through the grove again, in
/// the same or the opposite direction. On the detour the odometry drifts: `drift` turns and shifts
/// the second pass, and each tree is another landmark there. No noise. World axes are the first
/// camera's (y down).
struct TwoPasses {
  static constexpr int kFrames = 61;            ///< a metre apart, on each pass
  static constexpr int kSecond = kFrames + 47;  ///< index of the first frame of the second pass
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  PassMap passes{{}, 30.};
  Pose drift;
  std::vector<Pose> truth;                               ///< T_world_cam of each frame
  std::vector<std::pair<LandmarkId, LandmarkId>> trees;  ///< on the first and on the second pass

  explicit TwoPasses(const Pose& drift_of_second = {}, bool opposite = false, int count = 24)
      : TwoPasses(drift_of_second, opposite, Strewn(count)) {}

  /// Trees at these places; or other objects, which face along x on the first pass.
  TwoPasses(const Pose& drift_of_second, bool opposite, const std::vector<Vec3>& places,
            Symmetry symmetry = Symmetry::kFull)
      : drift(drift_of_second) {
    for (const Vec3& place : places)
      trees.push_back({AddTree(Pose(), place, symmetry), AddTree(drift, place, symmetry)});
    for (int i = 0; i < kFrames; ++i) AddFrame(Pose::Trans(0, 0, i), 0);
    for (int step = 1; step < 48; ++step)
      AddFrame(
          Pose::Trans(Detour(5. * step, opposite)) * Pose::RotY(opposite ? M_PI * step / 48. : 0.),
          step / 48.);
    for (int i = 0; i < kFrames; ++i)
      AddFrame(opposite ? Pose::Trans(0, 0, 60 - i) * Pose::RotY(M_PI) : Pose::Trans(0, 0, i), 1);
  }

  /// Places on both sides of the way.
  static std::vector<Vec3> Strewn(int count) {
    std::mt19937 random(5);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 100001) * 1e-5;
    };
    std::vector<Vec3> places;
    for (int i = 0; i < count; ++i)
      places.push_back({(i % 2 == 0 ? -1 : 1) * uniform(3, 9), 1, uniform(5, 55)});
    return places;
  }

  /// Path up to the last frame. [m]
  double end_m() const { return state.frames.back().travelled; }

  /// The true T_match_query of two frames.
  Pose TrueLoop(int match, int query) const { return truth[match].inverse() * truth[query]; }

 private:
  LandmarkId AddTree(const Pose& moved, const Vec3& place, Symmetry symmetry) {
    MapLandmark landmark;
    landmark.label = "Tree";
    landmark.symmetry = symmetry;
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose = ToUpright(moved * ToPose({place, 0}, state.gravity()), state.gravity());
    landmark.dims = Vec3(0.4, 0.4, 4);
    return state.map.Insert(landmark);
  }

  // From the end of the first pass to where the second one begins.
  static Vec3 Detour(double metres, bool opposite) {
    if (opposite) return {metres < 120 ? metres : 240 - metres, 0, 60};
    if (metres < 90) return {metres, 0, 60};
    return metres < 150 ? Vec3(90, 0, 150 - metres) : Vec3(240 - metres, 0, 0);
  }

  void AddFrame(const Pose& T_truth, double share_of_drift) {
    const bool second = share_of_drift == 1;
    FrameRecord record;
    record.frame = 10 * state.frames.size();  // numbers are not indices
    record.stamp = record.frame;
    record.T_odom_cam = record.T_world_cam = Pose::Exp(share_of_drift * drift.Log()) * T_truth;
    for (const auto& [early, late] : trees) {
      const LandmarkId id = second ? late : early;
      const Pose T_cam_object =
          record.T_world_cam.inverse() * ToPose(state.map.at(id).pose, state.gravity());
      const Vec3& p = T_cam_object.translation();
      if (p.z() < 1 || p.norm() > 15) continue;
      Detection detection;
      detection.T_cam_object = T_cam_object;
      detection.dims = Vec3(0.4, 0.4, 4);
      record.detections.push_back(detection);
      record.matched.push_back(id);
    }
    const std::vector<Detection> seen = record.detections;
    state.frames.Append(record);
    truth.push_back(T_truth);
    for (std::size_t k = 0; k < record.matched.size(); ++k) AddSighting(record, k);
    passes.AddFrame(state, seen);
  }

  void AddSighting(const FrameRecord& record, std::size_t k) {
    const LandmarkId id = record.matched[k];
    std::vector<Sighting> sightings = state.map.at(id).sightings;
    sightings.push_back({record.frame, record.stamp, 0, 1., record.detections[k].T_cam_object,
                         record.detections[k].dims});
    state.map.SetSightings(id, std::move(sightings));
  }
};

}  // namespace sslcd
