// SPDX-License-Identifier: BSD-3-Clause
// What has changed between the sessions of a map.
//
//   change_bench halv CASE LAYOUT CHURN FIRST_SEED LAST_SEED
//   change_bench still DATA SESSIONS
//
// `halv`: HALV-sim, three sessions of a site: out, the way back, out again, each with noise of its
// own. Before the second and the third the share CHURN of the vehicles in the parking spaces is
// replaced by others, in the same space or in a free one. Prints a CSV row for each seed and each
// step from a session to the next. An object counts if it was in view in both sessions: an exact
// detector would see it, or would see it if it stood there, in at least 5 frames of each. Columns:
// departures and arrivals by the simulator that count; those that were found; and places that were
// called one, although the object there has not changed, is there twice, or is none at all.
//
// `still`: cuts a drive on which nothing changes into sessions of equal length. Prints the places
// in view of two successive sessions and the changes that were called.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "change/explain.h"
#include "sim/halv.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

constexpr double kCalled = 0.5;  // probability from which a change is called one

// A map of several sessions.
class Drives {
 public:
  explicit Drives(const MapperContext& context)
      : context_(context), mapper_(DefaultOptions(Mode::kRobust), context) {}

  void Give(const std::vector<Frame>& frames) {
    if (!frames_.empty()) mapper_.StartSequence();
    for (Frame frame : frames) {
      frame.index = static_cast<int>(frames_.size());
      mapper_.AddFrame(frame);
      frames_.push_back(std::move(frame));
      session_.push_back(sessions_);
    }
    ++sessions_;
  }

  void Finish() {
    mapper_.Refine();
    objects_ = mapper_.Objects();
  }

  bool AreJoined() const {
    const std::vector<MapPart> parts = mapper_.Parts();
    return std::all_of(parts.begin(), parts.end(),
                       [](const MapPart& part) { return part.joined_with == 0; });
  }

  MapHistory History() const {
    Sightings sightings(
        {context_.gravity, context_.labels, mapper_.noise_scale(), sessions_, objects_});
    const std::vector<MapPart> parts = mapper_.Parts();
    const std::vector<Pose> poses = mapper_.CameraTrajectory().poses;
    std::size_t part = 0;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      while (part + 1 < parts.size() && parts[part + 1].first_frame <= static_cast<int>(f)) ++part;
      sightings.AddFrame({static_cast<int>(f), session_[f], parts[part].joined_with,
                          frames_[f].stamp, poses[f], frames_[f].detections});
    }
    return Explain(sightings);
  }

  // Frame and row of the sightings of a place in a session.
  std::vector<Observation> SeenAt(const PlaceHistory& place, int session) const {
    std::vector<Observation> seen;
    for (const MapObject& object : objects_) {
      if (std::find(place.landmarks.begin(), place.landmarks.end(), object.id) ==
          place.landmarks.end())
        continue;
      for (const Observation& one : object.observations)
        if (session_[one.frame] == session) seen.push_back(one);
    }
    return seen;
  }

 private:
  MapperContext context_;
  Mapper mapper_;
  std::vector<Frame> frames_;
  std::vector<int> session_;
  std::vector<MapObject> objects_;
  int sessions_ = 0;
};

bool InView(const PlaceHistory& place, int from) {
  return place.sessions[from].InView() && place.sessions[from + 1].InView();
}

struct Score {
  int truth = 0, found = 0, wrong = 0;
};

class Site {
 public:
  static constexpr int kSessions = 3;

  Site(std::uint64_t seed, sim::HalvScene scene) : scene_(scene) {
    const double churn = std::exchange(scene.churn, 0);
    sim::HalvWorld halv = sim::MakeHalvWorld(seed, scene);
    scene.churn = churn;
    frames_ = static_cast<int>(halv.world.truth.size());
    for (int s = 1; s < kSessions; ++s)
      sim::ReplaceVehicles(scene, seed + 1000 * s, s * frames_, halv);
    world_ = halv.world;
    drives_.emplace(MapperContext{world_.gravity, world_.labels, world_.camera});
    for (int s = 0; s < kSessions; ++s) Record(s, seed);
    drives_->Finish();
  }

  const Drives& drives() const { return *drives_; }

  // Of departures and arrivals.
  std::pair<Score, Score> Judge(const MapHistory& history, int from) {
    std::pair<Score, Score> score;
    for (const sim::WorldObject& object : world_.objects) {
      const bool before = IsThere(object, from), after = IsThere(object, from + 1);
      if (!object.driving() && before != after && Counts(object, from))
        ++(before ? score.first : score.second).truth;
    }
    std::set<int> found;
    const auto judge = [&](int id, Score& of) {
      if (id >= 0 && !Counts(world_.objects[id], from)) return;
      const bool changed =
          id >= 0 && !world_.objects[id].driving() &&
          IsThere(world_.objects[id], from) != IsThere(world_.objects[id], from + 1);
      ++(changed && found.insert(id).second ? of.found : of.wrong);
    };
    for (std::size_t i = 0; i < history.places().size(); ++i) {
      const PlaceHistory& place = history.places()[i];
      if (!InView(place, from)) continue;
      const PlaceOutcome outcome = history.Between(static_cast<int>(i), from, from + 1);
      if (outcome.Departure() >= kCalled) judge(IdAt(place, from), score.first);
      if (outcome.Arrival() >= kCalled) judge(IdAt(place, from + 1), score.second);
    }
    return score;
  }

 private:
  bool IsThere(const sim::WorldObject& object, int session) const {
    return object.IsThereAt(session * frames_);
  }

  // The world of a session; driving cars are there each time.
  sim::World WorldOf(int session) const {
    sim::World world = world_;
    const bool back = session % 2 == 1;
    for (sim::WorldObject& object : world.objects) {
      const bool there = object.driving() || IsThere(object, session);
      object.first_frame = there ? 0 : std::numeric_limits<int>::max();
      object.end_frame = std::numeric_limits<int>::max();
      if (back) std::reverse(object.T_world_object.begin(), object.T_world_object.end());
    }
    if (!back) return world;
    std::reverse(world.truth.poses.begin(), world.truth.poses.end());
    for (Pose& pose : world.truth.poses) pose = pose * Pose::RotY(M_PI);
    return world;
  }

  // Objects look the same in each session; all other noise is new.
  void Record(int session, std::uint64_t seed) {
    const sim::World world = WorldOf(session);
    const std::uint64_t own = seed + 1000 * session;
    const sim::HalvDrift drift;
    const Trajectory odometry =
        sim::SimulateOdometryWithAte(world.truth, drift.shape, sim::HalvAte(scene_.case_number),
                                     drift.ate_spread, own)
            .odometry;
    sim::SimulatedDetections detections = sim::SimulateDetections(world, sim::HalvDetector(), own);
    sim::AddAppearance(world, {}, seed, detections);
    drives_->Give(sim::MakeFrames(odometry, detections));
    for (const std::vector<Detection>& frame : detections.frames) {
      identity_.emplace_back();
      for (const Detection& one : frame) identity_.back()[one.row] = detections.identity[one.row];
    }
  }

  bool Counts(const sim::WorldObject& object, int from) {
    constexpr int kFrames = 5;
    return FramesInView(object, from) >= kFrames && FramesInView(object, from + 1) >= kFrames;
  }

  // The frames of a session in which an exact detector sees an object, or would see it there.
  int FramesInView(const sim::WorldObject& object, int session) {
    const auto [known, is_new] = in_view_.try_emplace({object.id, session});
    if (!is_new) return known->second;
    constexpr double kOverlap = 2;  // vehicles that are nearer than this are in its place [m]
    constexpr int kNever = std::numeric_limits<int>::max();
    sim::DetectorNoise exact = sim::HalvDetector();
    exact.miss_rate_near = exact.miss_rate_far = exact.miss_rate_hidden = 0;
    exact.false_positives = 0;
    sim::World world = WorldOf(session);
    const Vec3& place = object.T_world_object[0].translation();
    for (sim::WorldObject& other : world.objects) {
      const double apart = (other.T_world_object[0].translation() - place).norm();
      if (other.id == object.id)
        other.first_frame = 0;
      else if (other.driving() || apart < kOverlap)
        other.first_frame = kNever;
    }
    const Trajectory path = std::exchange(world.truth, {});
    for (std::size_t i = 0; i < path.size(); ++i) {
      if ((path.poses[i].translation() - place).norm() > exact.max_range_m) continue;
      world.truth.stamps.push_back(path.stamps[i]);
      world.truth.poses.push_back(path.poses[i]);
    }
    const std::vector<int> seen = sim::SimulateDetections(world, exact, 1).identity;
    return known->second = static_cast<int>(std::count(seen.begin(), seen.end(), object.id));
  }

  // The object that a session has seen at a place most often; -1: none, a false detection.
  int IdAt(const PlaceHistory& place, int session) const {
    std::map<int, int> votes;
    for (const Observation& seen : drives_->SeenAt(place, session))
      ++votes[identity_[seen.frame].at(seen.detection_row)];
    const auto most =
        std::max_element(votes.begin(), votes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == votes.end() ? -1 : most->first;
  }

  sim::HalvScene scene_;
  sim::World world_;
  int frames_ = 0;  // of a session; session s is at frame s * frames_ of `world_`
  std::optional<Drives> drives_;
  std::vector<std::map<int, int>> identity_;    // of each frame, by row
  std::map<std::pair<int, int>, int> in_view_;  // by object and session
};

void RunHalv(const sim::HalvScene& scene, int first, int last) {
  std::printf(
      "case,layout,churn,seed,step,joined,departures,departures found,wrong departures,"
      "arrivals,arrivals found,wrong arrivals\n");
  for (int seed = first; seed <= last; ++seed) {
    Site site(static_cast<std::uint64_t>(seed), scene);
    const MapHistory history = site.drives().History();
    for (int from = 0; from + 1 < Site::kSessions; ++from) {
      const auto [departures, arrivals] = site.Judge(history, from);
      std::printf("%d,%s,%g,%d,%d,%d,%d,%d,%d,%d,%d,%d\n", scene.case_number, scene.layout.c_str(),
                  scene.churn, seed, from + 1, site.drives().AreJoined(), departures.truth,
                  departures.found, departures.wrong, arrivals.truth, arrivals.found,
                  arrivals.wrong);
      std::fflush(stdout);
    }
  }
}

void RunStill(const std::string& path, int sessions) {
  DatasetRequest request;
  request.path = path;
  const Dataset data = LoadDataset(request);
  MapperContext context;
  context.gravity = GravityFrame::FromUp(data.up_axis);
  context.labels = data.labels;
  context.camera = data.camera;
  Drives drives(context);
  const std::size_t all = data.frames.size();
  for (int s = 0; s < sessions; ++s)
    drives.Give({data.frames.begin() + static_cast<std::ptrdiff_t>(all * s / sessions),
                 data.frames.begin() + static_cast<std::ptrdiff_t>(all * (s + 1) / sessions)});
  drives.Finish();
  const MapHistory history = drives.History();
  int in_view = 0, departures = 0, arrivals = 0;
  for (std::size_t i = 0; i < history.places().size(); ++i) {
    for (int from = 0; from + 1 < sessions; ++from) {
      if (!InView(history.places()[i], from)) continue;
      const PlaceOutcome outcome = history.Between(static_cast<int>(i), from, from + 1);
      ++in_view;
      departures += outcome.Departure() >= kCalled ? 1 : 0;
      arrivals += outcome.Arrival() >= kCalled ? 1 : 0;
    }
  }
  std::printf("sessions,joined,places,in view twice,departures,arrivals\n%d,%d,%zu,%d,%d,%d\n",
              sessions, drives.AreJoined(), history.places().size(), in_view, departures, arrivals);
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  const bool halv = argc == 7 && !std::strcmp(argv[1], "halv");
  const bool still = argc == 4 && !std::strcmp(argv[1], "still");
  if (!halv && !still) {
    std::fprintf(stderr,
                 "usage: change_bench halv CASE LAYOUT CHURN FIRST_SEED LAST_SEED\n"
                 "       change_bench still DATA SESSIONS\n");
    return 2;
  }
  try {
    if (still) {
      sslcd::RunStill(argv[2], std::atoi(argv[3]));
      return 0;
    }
    sslcd::sim::HalvScene scene;
    scene.case_number = std::atoi(argv[2]);
    scene.layout = argv[3];
    scene.churn = std::atof(argv[4]);
    sslcd::RunHalv(scene, std::atoi(argv[5]), std::atoi(argv[6]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
