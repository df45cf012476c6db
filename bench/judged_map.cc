// SPDX-License-Identifier: BSD-3-Clause
#include "judged_map.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>

#include "sslcd/store/map_session.h"
#include "sslcd/store/map_store.h"

namespace sslcd {

JudgedMap MapOf(const std::vector<Session>& sessions, const MapperContext& context) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("sslcd_bench." + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = folder / "map.db";
  std::vector<const Session*> by_id;
  for (const Session& session : sessions) {
    by_id.push_back(&session);
    MapSession adding =
        MapSession::Begin(path, {std::to_string(by_id.size())}, context, std::nullopt);
    for (const Frame& frame : session.frames) adding.AddFrame(frame);
    adding.Refine();
    adding.End();
  }
  JudgedMap map;
  const MapStore store(path);
  map.reference = store.Reference();
  for (const SessionPath& drive : store.Results().paths)
    for (std::size_t i = 0; i < drive.frames.size(); ++i) {
      const Session& session = *by_id[drive.session - 1];
      map.cameras.push_back({session.truth[i], drive.trajectory.poses[i], session.copy});
    }
  std::filesystem::remove_all(folder);
  return map;
}

int Shared(const JudgedMap& map, const Session& stretch) {
  constexpr double kNear = 60, kSame = 1;  // [m]
  const Eigen::Matrix3d to_layout = map.reference.gravity.Basis().transpose();
  std::map<int, int> seen;
  for (std::size_t i = 0; i < stretch.frames.size(); ++i) {
    const auto distance = [&](const MapCamera& camera) {
      return camera.copy ? std::numeric_limits<double>::infinity()
                         : (camera.truth.translation() - stretch.truth[i].translation()).norm();
    };
    const MapCamera& near = map.Nearest(distance);
    if (distance(near) > kNear) continue;
    const Pose T_map_cam = near.T_map_cam * near.truth.inverse() * stretch.truth[i];
    for (const Detection& detection : stretch.frames[i].detections) {
      const Vec3 at = to_layout * (T_map_cam * detection.T_cam_object.translation());
      for (const LayoutObject& object : map.reference.objects)
        if ((object.position - at).head<2>().norm() < kSame) ++seen[object.id];
    }
  }
  return static_cast<int>(
      std::count_if(seen.begin(), seen.end(), [](const auto& each) { return each.second > 1; }));
}

Session Cut(const Session& drive, std::size_t from, std::size_t to, int turn, const Vec3& up) {
  Session stretch;
  const Pose T_own_odom(lie::SO3<double>::Exp(Vec3((0.7 + turn) * up)), Vec3(turn, 0, 2));
  const Pose first(lie::SO3<double>(), drive.frames[from].T_odom_cam.translation());
  for (std::size_t i = from; i < to; ++i) {
    stretch.frames.push_back(drive.frames[i]);
    stretch.frames.back().T_odom_cam = T_own_odom * first.inverse() * drive.frames[i].T_odom_cam;
    stretch.truth.push_back(drive.truth[i]);
  }
  StartUpright(up, drive.frames.front().T_odom_cam, stretch);
  return stretch;
}

}  // namespace sslcd
