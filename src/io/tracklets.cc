// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/io/tracklets.h"

#include <cmath>

#include "io/xml.h"
#include "sslcd/core/error.h"
#include "sslcd/io/text_rows.h"

namespace sslcd {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  std::vector<Tracklet> Read() const {
    const XmlElement document = ReadXml(path_);
    const XmlElement* root = document.Find("boost_serialization");
    if (root == nullptr)
      throw Error(ErrorKind::kBadInput, {path_, 1},
                  "not a KITTI tracklet file: no <boost_serialization>");
    std::vector<Tracklet> tracklets;
    for (const XmlElement& item : Child(*root, "tracklets").children) {
      if (item.name == "item") tracklets.push_back(ReadTracklet(item));
    }
    return tracklets;
  }

 private:
  [[noreturn]] void Fail(const XmlElement& at, const std::string& message) const {
    throw Error(ErrorKind::kBadInput, {path_, at.line}, message);
  }

  const XmlElement& Child(const XmlElement& parent, const char* name) const {
    const XmlElement* child = parent.Find(name);
    if (child == nullptr) Fail(parent, "<" + parent.name + "> has no <" + name + ">");
    return *child;
  }

  double Number(const XmlElement& parent, const char* name) const {
    const XmlElement& child = Child(parent, name);
    const std::optional<double> value = ParseNumber(child.text);
    if (!value || !std::isfinite(*value))
      Fail(child, "<" + child.name + ">: expected a number, found '" + child.text + "'");
    return *value;
  }

  Tracklet ReadTracklet(const XmlElement& item) const {
    Tracklet tracklet;
    tracklet.label = Child(item, "objectType").text;
    tracklet.dims = Vec3(Number(item, "l"), Number(item, "w"), Number(item, "h"));
    if (!(tracklet.dims.minCoeff() > 0)) Fail(item, "the tracklet's sizes must be positive");
    const double first_frame = Number(item, "first_frame");
    if (!(first_frame >= 0 && first_frame < 1e9))
      Fail(item, "the first frame is not a frame number");
    tracklet.first_frame = static_cast<int>(first_frame);
    for (const XmlElement& pose : Child(item, "poses").children) {
      if (pose.name != "item") continue;
      const Vec3 bottom(Number(pose, "tx"), Number(pose, "ty"), Number(pose, "tz"));
      tracklet.T_velo_object.emplace_back(lie::SO3<double>::RotZ(Number(pose, "rz")),
                                          bottom + Vec3(0, 0, tracklet.dims.z() / 2));
    }
    return tracklet;
  }

  std::string path_;
};

}  // namespace

std::vector<Tracklet> ReadTracklets(const std::string& path) { return Reader(path).Read(); }

std::map<int, std::vector<Detection>> TrackletDetections(const std::vector<Tracklet>& tracklets,
                                                         const Pose& T_cam_velo) {
  std::map<int, std::vector<Detection>> by_frame;
  for (const Tracklet& tracklet : tracklets) {
    int frame = tracklet.first_frame;
    for (const Pose& T_velo_object : tracklet.T_velo_object) {
      Detection detection;
      detection.label = tracklet.label;
      detection.dims = tracklet.dims;
      detection.T_cam_object = T_cam_velo * T_velo_object;
      by_frame[frame++].push_back(detection);
    }
  }
  int row = 0;
  for (auto& [frame, detections] : by_frame) {
    for (Detection& detection : detections) detection.row = row++;
  }
  return by_frame;
}

}  // namespace sslcd
