// SPDX-License-Identifier: BSD-3-Clause
#include "store/read_history.h"

#include <map>

#include "change/explain.h"
#include "store/frame_bytes.h"
#include "store/journal.h"
#include "store/result_tables.h"
#include "store/site.h"

namespace sslcd {
namespace {

std::map<int, Pose> PosesOf(const MapResults& results) {
  std::map<int, Pose> poses;
  for (const SessionPath& path : results.paths)
    for (std::size_t i = 0; i < path.frames.size(); ++i)
      poses[path.frames[i]] = path.trajectory.poses[i];
  return poses;
}

// MapPart::joined_with by the first frame of each part.
std::map<int, int> MapsOf(const MapResults& results) {
  std::map<int, int> maps;
  for (const MapPart& part : results.parts) maps[part.first_frame] = part.joined_with;
  return maps;
}

}  // namespace

MapHistory ReadHistory(Database& database) {
  const MapInfo info = ReadInfo(database);
  const MapResults results = ReadResults(database);
  const std::map<int, Pose> poses = PosesOf(results);
  const std::map<int, int> maps = MapsOf(results);
  Sightings sightings({GravityFrame::FromUp(info.up_axis), info.labels, results.noise_scale,
                       static_cast<int>(info.sessions.size()), results.objects});
  ReadInputs(database, info.sessions, [&](const StoredInput& input) {
    if (input.kind != InputKind::kFrame) return;
    Frame frame = FrameIn(input, database.path());
    for (std::size_t s = 0; s < info.sessions.size(); ++s) {
      if (info.sessions[s].id != input.session) continue;
      const int number = NumberInMap(frame.index, info.sessions[s], database.path());
      const auto pose = poses.find(number);
      const auto map = maps.upper_bound(number);
      if (pose == poses.end() || map == maps.begin()) continue;  // stored after the results
      sightings.AddFrame({number, static_cast<int>(s), std::prev(map)->second, frame.stamp,
                          pose->second, std::move(frame.detections)});
    }
  });
  return Explain(sightings);
}

}  // namespace sslcd
