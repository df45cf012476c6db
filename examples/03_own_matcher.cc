// SPDX-License-Identifier: BSD-3-Clause
// A matcher of your own in place of sslcd's: here the nearest object of the same class within 4 m,
// which is enough where the odometry drifts by less than that.
//   03_own_matcher SEQUENCE    a folder as in docs/formats.md, e.g. tests/data/sim_rectangle
#include <sslcd/sslcd.h>

#include <cstdio>
#include <optional>
#include <set>
#include <vector>

// snippet: matcher
std::optional<sslcd::PlaceAnswer> MatchNearest(const sslcd::PlaceQuery& query) {
  sslcd::PlaceAnswer answer;
  std::set<int> taken;
  for (std::size_t i = 0; i < query.local.size(); ++i) {
    int best = -1;
    double best_m = 4;
    for (std::size_t j = 0; j < query.global.size(); ++j) {
      const double m = (query.local[i].position - query.global[j].position).head<2>().norm();
      if (m >= best_m || query.local[i].label != query.global[j].label) continue;
      best = static_cast<int>(j);
      best_m = m;
    }
    if (best < 0 || !taken.insert(best).second) continue;  // each object of the map once
    answer.matches.emplace_back(static_cast<int>(i), best);
  }
  if (answer.matches.size() < 5) return std::nullopt;
  answer.score = static_cast<double>(answer.matches.size());
  answer.accepted = 3 * answer.matches.size() > query.global.size();
  return answer;
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sslcd::DatasetRequest request;
  request.path = argv[1];
  const sslcd::Dataset data = sslcd::LoadDataset(request);
  sslcd::MapperContext context{sslcd::GravityFrame::FromUp(data.up_axis), data.labels, data.camera};
  context.place_matcher = MatchNearest;
  sslcd::Mapper mapper(sslcd::Options(), context);
  std::vector<sslcd::Pose> odometry;
  for (const sslcd::Frame& frame : data.frames) {
    mapper.AddFrame(frame);
    odometry.push_back(frame.T_odom_cam);
  }
  const auto ate = [&](const std::vector<sslcd::Pose>& poses) {
    return sslcd::ComputeAte(poses, data.groundtruth->poses).error.rmse;
  };
  std::printf("%d loops; ATE %.2f m, of the odometry %.2f m\n",
              mapper.SummariseLoopSearch().accepted, ate(mapper.CameraTrajectory().poses),
              ate(odometry));
}
