// SPDX-License-Identifier: BSD-3-Clause
// Several sessions on one map. A drive is cut into sessions of equal length, each of which has an
// odometry with an origin and a heading of its own, upright at its start. They are given in an
// order. Or HALV-sim: a session, and the same way back with other noise and 30 % of the cars
// replaced. With `copy`, a session of a copy of the site comes between: the same layout of cars
// that look different.
//
//   sessions_bench DATA GROUNDTRUTH ORDER...      an order: the sessions' numbers, e.g. 2413; 1:
//   whole sessions_bench halv|copy CASE LAYOUT FIRST_SEED LAST_SEED
//
// Prints a CSV row for each order, or each seed: frames in the largest map and their ATE after one
// SE(3) alignment [m], its horizontal and its vertical part, accepted loops, those between
// sessions, wrong ones (off by 5 m or 10 degrees), loops to a copy, and the path of the last
// session until its first loop to an earlier one [m; -1: none].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "recorded_sessions.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// A frame that the mapper has got.
struct Given {
  Pose truth;
  int session = 0;
  double path_m = 0;  // of its session
  bool copy = false;
};

struct Result {
  std::string name;
  int frames = 0, loops = 0, joining = 0, wrong = 0, to_copy = 0;
  double ate = 0, horizontal = 0, vertical = 0;
  double first_loop_m = -1;  // before the refinement
};

void PrintHeader() {
  std::printf(
      "run,frames,ATE m,horizontal m,vertical m,loops,joining,wrong,to copy,first loop m\n");
}

void Print(const Result& r) {
  std::printf("%s,%d,%.3f,%.3f,%.3f,%d,%d,%d,%d,%.0f\n", r.name.c_str(), r.frames, r.ate,
              r.horizontal, r.vertical, r.loops, r.joining, r.wrong, r.to_copy, r.first_loop_m);
  std::fflush(stdout);
}

class Drive {
 public:
  explicit Drive(const MapperContext& context)
      : up_(context.gravity.up), mapper_(DefaultOptions(Mode::kRobust), context) {}

  // Gives the frames of a session as if the robot had been switched on at its first one.
  void Give(const Session& session) {
    const int number = frames_.empty() ? 0 : frames_.back().session + 1;
    if (number > 0) mapper_.StartSequence();
    const Pose& first = session.frames.front().T_odom_cam;
    const auto turn = lie::SO3<double>::Exp(Vec3(2. * number * up_));
    const Pose T_own_odom(turn, Vec3(number, 0, 2) - turn * first.translation());
    double path_m = 0;
    for (std::size_t i = 0; i < session.frames.size(); ++i) {
      Frame frame = session.frames[i];
      if (i > 0)
        path_m += (frame.T_odom_cam.translation() - session.frames[i - 1].T_odom_cam.translation())
                      .norm();
      if (number > 0) frame.T_odom_cam = T_own_odom * frame.T_odom_cam;
      frame.index = static_cast<int>(frames_.size());
      frames_.push_back({session.truth[i], number, path_m, session.copy});
      mapper_.AddFrame(frame);
    }
  }

  // Refines and judges.
  Result Finish(const std::string& name) {
    Result result;
    result.name = name;
    Count(result);
    for (const LoopClosure& loop : mapper_.LoopClosures()) {
      const Given& newest = frames_[loop.newest_frame];
      if (!Joins(loop) || newest.session != frames_.back().session) continue;
      if (result.first_loop_m < 0 || newest.path_m < result.first_loop_m)
        result.first_loop_m = newest.path_m;
    }
    mapper_.Refine();
    const int wrong = std::exchange(result.wrong, 0), to_copy = std::exchange(result.to_copy, 0);
    Count(result);
    result.wrong = std::max(result.wrong, wrong);
    result.to_copy = std::max(result.to_copy, to_copy);
    JudgeLargest(result);
    return result;
  }

 private:
  bool Joins(const LoopClosure& loop) const {
    return loop.decision == LoopDecision::kAccepted &&
           frames_[loop.query_frame].session != frames_[loop.match_frame].session;
  }

  void Count(Result& result) const {
    result.loops = result.joining = 0;
    for (const LoopClosure& loop : mapper_.LoopClosures()) {
      if (loop.decision != LoopDecision::kAccepted) continue;
      const Given &query = frames_[loop.query_frame], &match = frames_[loop.match_frame];
      const Pose error = (match.truth.inverse() * query.truth).inverse() * loop.T_match_query;
      const bool off = error.translation().norm() > 5 || error.so3().Log().norm() > M_PI / 18;
      ++result.loops;
      result.joining += Joins(loop);
      result.to_copy += query.copy != match.copy;
      result.wrong += query.copy == match.copy && off;
    }
  }

  // The ATE of the map with the most frames.
  void JudgeLargest(Result& result) const {
    const std::vector<MapPart> parts = mapper_.Parts();
    const std::vector<Pose> poses = mapper_.CameraTrajectory().poses;
    std::vector<std::vector<std::size_t>> maps(parts.size());
    std::size_t part = 0;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      while (part + 1 < parts.size() && parts[part + 1].first_frame <= static_cast<int>(f)) ++part;
      maps[parts[part].joined_with].push_back(f);
    }
    const auto largest = std::max_element(
        maps.begin(), maps.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    std::vector<Pose> estimate, truth;
    for (const std::size_t f : *largest) {
      estimate.push_back(poses[f]);
      truth.push_back(frames_[f].truth);
    }
    const AteResult ate = ComputeAte(estimate, truth, Alignment::kSe3);
    double vertical = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      vertical +=
          std::pow(up_.dot(ate.S_ref_est * estimate[i].translation() - truth[i].translation()), 2) /
          static_cast<double>(truth.size());
    result.frames = static_cast<int>(truth.size());
    result.ate = ate.error.rmse;
    result.vertical = std::sqrt(vertical);
    result.horizontal = std::sqrt(std::max(0., ate.error.rmse * ate.error.rmse - vertical));
  }

  Vec3 up_;
  Mapper mapper_;
  std::vector<Given> frames_;
};

// `upright`: each session begins level, because the odometry's tilt has drifted by then.
std::vector<Session> Cut(const Dataset& data, int count, bool upright) {
  const Session drive = WithTruth(data);
  const std::vector<double> path_m = PathOf(drive);
  std::vector<Session> sessions(count);
  for (std::size_t i = 0; i < drive.frames.size(); ++i) {
    const int number = std::min(count - 1, static_cast<int>(count * path_m[i] / path_m.back()));
    sessions[number].frames.push_back(drive.frames[i]);
    sessions[number].truth.push_back(drive.truth[i]);
  }
  const Vec3 up = GravityFrame::FromUp(data.up_axis).up;
  if (upright)
    for (Session& session : sessions) StartUpright(up, data.frames.front().T_odom_cam, session);
  return sessions;
}

// Whether the cameras tilt against each other by more than a tenth of a degree somewhere.
bool Tilts(const Dataset& data) {
  const Vec3 up = GravityFrame::FromUp(data.up_axis).up;
  const Vec3 up_in_cam = data.frames.front().T_odom_cam.so3().inverse() * up;
  return std::any_of(data.frames.begin(), data.frames.end(), [&](const Frame& frame) {
    return (frame.T_odom_cam.so3() * up_in_cam - up).norm() > M_PI / 1800;
  });
}

void RunOrders(const DatasetRequest& request, const std::vector<std::string>& orders) {
  const Dataset data = LoadDataset(request);
  MapperContext context;
  context.gravity = GravityFrame::FromUp(data.up_axis);
  context.labels = data.labels;
  context.camera = data.camera;
  PrintHeader();
  for (const std::string& order : orders) {
    const std::vector<Session> sessions = Cut(data, static_cast<int>(order.size()), Tilts(data));
    Drive drive(context);
    for (const char number : order) drive.Give(sessions.at(number - '1'));
    Print(drive.Finish(order));
  }
}

void RunHalv(bool copy, int halv_case, const std::string& layout, int first, int last) {
  constexpr double kChurn = 0.3;
  PrintHeader();
  for (int number = first; number <= last; ++number) {
    const TwoVisits visits =
        RecordHalvTwice(halv_case, layout, static_cast<std::uint64_t>(number), kChurn);
    Drive drive({visits.gravity, visits.labels, visits.camera});
    drive.Give(visits.first);
    if (copy) drive.Give(visits.copy);
    drive.Give(visits.second);
    Print(
        drive.Finish(layout + " " + std::to_string(halv_case) + " seed " + std::to_string(number)));
  }
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  const bool halv = argc == 6 && (!std::strcmp(argv[1], "halv") || !std::strcmp(argv[1], "copy"));
  if (!halv && argc < 4) {
    std::fprintf(stderr,
                 "usage: sessions_bench DATA GROUNDTRUTH ORDER...\n"
                 "       sessions_bench halv|copy CASE LAYOUT FIRST_SEED LAST_SEED\n");
    return 2;
  }
  try {
    if (halv) {
      sslcd::RunHalv(argv[1][0] == 'c', std::atoi(argv[2]), argv[3], std::atoi(argv[4]),
                     std::atoi(argv[5]));
      return 0;
    }
    sslcd::DatasetRequest request;
    request.path = argv[1];
    request.groundtruth = argv[2];
    sslcd::RunOrders(request, {argv + 3, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
