// SPDX-License-Identifier: BSD-3-Clause
#include "closing/reference_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "closing/local_map_errors.h"
#include "closing/pass_layout.h"
#include "core/sigmoid.h"
#include "loop/appearance_likelihood.h"
#include "loop/decision.h"
#include "loop/drift.h"
#include "loop/pose_search.h"
#include "loop/pose_tracks.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// Nothing leads from the map to the drive.
PosePrior NoPrior() { return {0, 0, true}; }

class ReferenceFinder : public LoopFinder {
 public:
  ReferenceFinder(const LoopOptions& options, const ReferenceMap& map,
                  std::function<void(const Localisation&)> report)
      : options_(options),
        index_(map.objects, options.match.max_pair_m, options.match.reach_m),
        tracks_(options.tracks),
        report_(std::move(report)) {
    for (std::size_t i = 0; i < map.label_names.size(); ++i)
      numbers_.insert({map.label_names[i], static_cast<int>(i)});
  }

  std::unique_ptr<LoopFinder> Clone() const override {
    return std::make_unique<ReferenceFinder>(*this);
  }

  std::optional<FoundLoop> Find(const FinderInput& input) override {
    report_(Answer(input));
    return std::nullopt;
  }

  void MoveLocalMap(const YawShift& change) override { tracks_.Move(change); }
  void Reset() override { tracks_.Forget(); }

 private:
  Localisation Answer(const FinderInput& input) {
    const FrameStore& frames = input.state.frames;
    PassLayout local =
        PassLayouts(input.passes, input.state)
            .Recent(input.window.end_m - input.window.local_m, options_.layout.min_sightings);
    for (LayoutObject& object : local.objects)
      object.label = NumberOf(input.state.map.at({object.id}).label);
    Localisation answer;
    answer.frame = frames.back().frame;
    answer.travelled_m = frames.back().travelled;
    answer.objects_in_view = static_cast<int>(local.objects.size());
    const int few = options_.match.search.min_matches;
    if (answer.objects_in_view < few) {
      answer.reason = std::to_string(answer.objects_in_view) +
                      " objects are too few: " + std::to_string(few) + " have to agree";
      return answer;
    }
    const LayoutLikelihood likelihood(local.objects, index_, options_.match.likelihood);
    const PoseSearchOptions& search = options_.match.search;
    tracks_.Update(likelihood, SearchPoses(likelihood, search), search, input.window.end_m,
                   std::numeric_limits<double>::infinity(),
                   [](const YawShift&, const LayoutFit&) { return NoPrior(); });
    if (tracks_.tracks().empty())
      answer.reason = "no pose brings " + std::to_string(few) + " objects together";
    else
      Decide(input, local, tracks_.tracks()[0], answer);
    return answer;
  }

  // Labels that the map does not have get numbers of their own.
  int NumberOf(const std::string& label) {
    return numbers_.insert({label, static_cast<int>(numbers_.size())}).first->second;
  }

  DriftResult Align(const FinderInput& input, const PassLayout& local, const LayoutFit& fit,
                    const OdometryModel& odometry) const {
    constexpr double kYawSigma = 0.2;  // between two headings of one object; set by hand [rad]
    const GravityFrame& gravity = input.state.gravity();
    const int query = input.state.frames.size() - 1;
    std::vector<DriftPair> pairs;
    for (const auto& [i, j] : fit.matches) {
      const LayoutObject& old = index_.objects()[j];
      const Vec3 position(old.position.x(), old.position.y(), old.altitude);
      DriftPair& pair = pairs.emplace_back();
      pair.T_world_local = ToPose(local.places[i], gravity);
      pair.T_world_global =
          ToPose({gravity.Basis() * position, std::isnan(old.yaw) ? 0 : old.yaw}, gravity);
      pair.symmetry = std::isnan(old.yaw) ? Symmetry::kFull : local.objects[i].symmetry;
      pair.sigma_horizontal_m = pair.sigma_vertical_m = std::hypot(
          fit.sigma, OdometrySigma(input.state.frames, query, local.seen_m[i], odometry));
      pair.sigma_yaw_rad = kYawSigma;
    }
    return SolveDrift(pairs, gravity, options_.drift);
  }

  void Decide(const FinderInput& input, const PassLayout& local, const PoseTrack& best,
              Localisation& answer) const {
    const FrameRecord& camera = input.state.frames.back();
    const OdometryModel odometry{options_.odometry, input.odometry};
    const DriftResult drift = Align(input, local, best.fit, odometry);
    if (!drift.usable) {
      answer.decision = LoopDecision::kAmbiguous;
      answer.reason = drift.reason;
      return;
    }
    answer.T_map_cam = drift.T_global_local * camera.T_world_cam;
    answer.T_map_odom = answer.T_map_cam * camera.T_input_cam.inverse();
    TrackEvidence evidence;
    evidence.evidence = best.evidence;
    evidence.margin = tracks_.Margin(0);
    evidence.second_margin = tracks_.Margin(1);
    evidence.own_evidence = EvidenceOnTrack(best.fit.evidence, index_.pose_volume());
    evidence.joins = true;
    evidence.lead = tracks_.Lead();
    const Vec3 up = camera.T_world_cam.so3().inverse() * input.state.gravity().up;
    Pose::Matrix6 covariance = CovarianceOfCamera(input, local, best.fit, drift, odometry, up);
    answer.covariance = covariance;
    evidence.heading_sigma_rad = std::sqrt(up.dot(covariance.bottomRightCorner<3, 3>() * up));
    for (const auto& [i, j] : best.fit.matches) {
      const LayoutObject& old = index_.objects()[j];
      evidence.appearance +=
          AppearanceGain(local.objects[i], old, options_.match.likelihood.appearance);
      answer.pairs.push_back({{local.objects[i].id}, {old.id}});
    }
    static_cast<LoopVerdict&>(answer) = DecideTrack(evidence, options_.acceptance).loop;
    answer.probability = Sigmoid(answer.score);
    if (answer.decision == LoopDecision::kAccepted)
      answer.reason = std::to_string(answer.pairs.size()) + " objects agree";
  }

  // As LoopMeter's.
  Pose::Matrix6 CovarianceOfCamera(const FinderInput& input, const PassLayout& local,
                                   const LayoutFit& fit, const DriftResult& drift,
                                   const OdometryModel& odometry, const Vec3& up) const {
    const FrameStore& frames = input.state.frames;
    const Pose::Matrix6 to_camera = frames.back().T_world_cam.inverse().Adj();
    Pose::Matrix6 covariance = to_camera * Pose::Matrix6(drift.covariance) * to_camera.transpose();
    covariance.diagonal().head<3>().array() += options_.sigma_m * options_.sigma_m;
    covariance.diagonal().tail<3>().array() += options_.sigma_rad * options_.sigma_rad;
    double first_m = std::numeric_limits<double>::infinity(), last_m = -first_m;
    for (const auto& match : fit.matches) {
      first_m = std::min(first_m, local.seen_m[match.first]);
      last_m = std::max(last_m, local.seen_m[match.first]);
    }
    covariance += OdometryBeyond(frames, frames.size() - 1, first_m, last_m, up, odometry);
    return covariance;
  }

  LoopOptions options_;
  LayoutIndex index_;
  PoseTracks tracks_;
  std::map<std::string, int> numbers_;  // of labels
  std::function<void(const Localisation&)> report_;
};

}  // namespace

std::unique_ptr<LoopFinder> MakeReferenceFinder(const LoopOptions& options, const ReferenceMap& map,
                                                std::function<void(const Localisation&)> report) {
  return std::make_unique<ReferenceFinder>(options, map, std::move(report));
}

void CheckReferenceMap(const ReferenceMap& map) {
  const auto fail = [](const std::string& problem) {
    throw Error(ErrorKind::kBadInput, "the map to localise in " + problem);
  };
  if (map.objects.empty()) fail("has no objects; map a drive first");
  if (!(map.scale > 0) || !std::isfinite(map.scale)) fail("has no scale above 0");
  std::set<int> ids;
  for (const LayoutObject& object : map.objects) {
    const std::string name = "object " + std::to_string(object.id);
    if (!ids.insert(object.id).second)
      fail("has two objects with the id " + std::to_string(object.id));
    if (object.label < 0 || object.label >= static_cast<int>(map.label_names.size()))
      fail("has no name for the label of " + name);
    if (!object.position.allFinite() || !std::isfinite(object.altitude))
      fail("has no finite position of " + name);
  }
}

}  // namespace sslcd
