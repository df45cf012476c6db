// SPDX-License-Identifier: BSD-3-Clause
#include "store/reference_map.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "association/gallery.h"
#include "store/appearance.h"

namespace sslcd {
namespace {

// The confirmed landmarks, in the order of the map.
class Landmarks {
 public:
  Landmarks(const MapResults& results, const GravityFrame& gravity) : gravity_(gravity) {
    for (const SessionPath& path : results.paths)
      for (std::size_t i = 0; i < path.frames.size(); ++i)
        cameras_[path.frames[i]] = path.trajectory.poses[i].translation();
  }

  LayoutObject Of(const MapObject& object, Symmetry symmetry) const {
    LayoutObject of;
    of.id = object.id.value;
    of.symmetry = symmetry;
    const Vec3 centre = object.T_world_object.translation();
    of.position = gravity_.Basis().transpose() * centre;
    of.altitude = std::exchange(of.position.z(), HeightOverCamera(object, centre));
    of.yaw = symmetry == Symmetry::kFull ? std::numeric_limits<double>::quiet_NaN()
                                         : gravity_.YawOf(object.T_world_object.so3());
    of.dims = object.dims;
    return of;
  }

 private:
  // Over the nearest camera that saw it: drift of heights and slopes cancel.
  double HeightOverCamera(const MapObject& object, const Vec3& centre) const {
    Vec3 nearest = Vec3::Constant(std::numeric_limits<double>::infinity());
    for (const Observation& seen : object.observations)
      if (const auto camera = cameras_.find(seen.frame); camera != cameras_.end())
        if ((camera->second - centre).norm() < (nearest - centre).norm()) nearest = camera->second;
    return gravity_.up.dot(centre - nearest);
  }

  const GravityFrame& gravity_;
  std::map<int, Vec3> cameras_;  // by frame
};

}  // namespace

ReferenceMap ReferenceOf(Database& database, const MapInfo& info, const MapResults& results) {
  ReferenceMap map;
  map.gravity = GravityFrame::FromUp(info.up_axis);
  map.labels = info.labels;
  map.scale = results.scale;
  const Landmarks landmarks(results, map.gravity);
  std::map<std::string, int> numbers;
  std::map<int, std::size_t> index;  // of a landmark
  for (const MapObject& object : results.objects) {
    if (object.state != LandmarkState::kConfirmed) continue;
    const auto [label, fresh] =
        numbers.insert({object.label, static_cast<int>(map.label_names.size())});
    if (fresh) map.label_names.push_back(object.label);
    index[object.id.value] = map.objects.size();
    map.objects.push_back(landmarks.Of(object, info.labels[object.label].symmetry));
    map.objects.back().label = label->second;
  }
  std::vector<PerCue<Gallery>> looks(map.objects.size());
  ForEachSighting(database, results.objects, info.sessions,
                  [&](int landmark, const Detection& seen) {
                    const Vec3 camera = seen.T_cam_object.inverse().translation();
                    for (const CueRow& row : kCueRows)
                      looks[index.at(landmark)][row.cue].Add(seen.appearance[row.cue],
                                                             std::atan2(camera.y(), camera.x()));
                  });
  for (std::size_t i = 0; i < looks.size(); ++i)
    for (const CueRow& row : kCueRows)
      map.objects[i].appearance[row.cue] = looks[i][row.cue].Views();
  return map;
}

}  // namespace sslcd
