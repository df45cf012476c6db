// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/tracklets.h"

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::string Trim(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

class TrackletFile {
 public:
  explicit TrackletFile(const std::string& path) : path_(path), bytes_(ReadFileBytes(path)) {
    // pugixml neither expands DTD entities nor recurses, so nested entities cannot exhaust memory.
    const pugi::xml_parse_result result = document_.load_buffer(
        bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result && result.status != pugi::status_no_document_element)
      FailAt(result.offset, ProblemAt(result));
  }

  std::vector<Tracklet> Read() const {
    const pugi::xml_node root = document_.child("boost_serialization");
    if (!root) FailAt(0, "not a KITTI tracklet file: no <boost_serialization>");
    std::vector<Tracklet> tracklets;
    for (const pugi::xml_node& item : Child(root, "tracklets").children("item"))
      tracklets.push_back(ReadTracklet(item));
    return tracklets;
  }

 private:
  /// Describes the error at the place where pugixml stopped.
  std::string ProblemAt(const pugi::xml_parse_result& result) const {
    const auto at = static_cast<std::size_t>(result.offset);
    const std::string description = result.description();
    if (at + 1 >= bytes_.size()) return "the file is truncated: " + description;
    const std::size_t tag = std::min(bytes_.rfind('<', at), at);
    const std::size_t end = std::min(bytes_.find_first_of(">\n", at), tag + 40);
    return "not XML: " + description + " at '" + bytes_.substr(tag, end + 1 - tag) + "'";
  }

  [[noreturn]] void FailAt(std::ptrdiff_t offset, const std::string& message) const {
    const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + offset, '\n');
    throw Error(ErrorKind::kBadInput, {path_, static_cast<int>(line)}, message);
  }

  [[noreturn]] void Fail(const pugi::xml_node& at, const std::string& message) const {
    FailAt(at.offset_debug(), message);
  }

  pugi::xml_node Child(const pugi::xml_node& parent, const std::string& name) const {
    const pugi::xml_node child = parent.child(name.c_str());
    if (!child) Fail(parent, "<" + std::string(parent.name()) + "> has no <" + name + ">");
    return child;
  }

  double Number(const pugi::xml_node& parent, const std::string& name) const {
    const pugi::xml_node child = Child(parent, name);
    const std::string text = Trim(child.child_value());
    const std::optional<double> value = ParseNumber(text);
    if (!value || !std::isfinite(*value))
      Fail(child, "<" + name + ">: expected a number, found '" + text + "'");
    return *value;
  }

  Tracklet ReadTracklet(const pugi::xml_node& item) const {
    Tracklet tracklet;
    tracklet.label = Trim(Child(item, "objectType").child_value());
    tracklet.dims = Vec3(Number(item, "l"), Number(item, "w"), Number(item, "h"));
    if (!(tracklet.dims.minCoeff() > 0)) Fail(item, "the tracklet's sizes must be positive");
    const double first_frame = Number(item, "first_frame");
    if (!(first_frame >= 0 && first_frame < 1e9))
      Fail(item, "the first frame is not a frame number");
    tracklet.first_frame = static_cast<int>(first_frame);
    for (const pugi::xml_node& pose : Child(item, "poses").children("item")) {
      const Vec3 bottom(Number(pose, "tx"), Number(pose, "ty"), Number(pose, "tz"));
      tracklet.T_velo_object.emplace_back(lie::SO3<double>::RotZ(Number(pose, "rz")),
                                          bottom + Vec3(0, 0, tracklet.dims.z() / 2));
    }
    return tracklet;
  }

  std::string path_, bytes_;
  pugi::xml_document document_;
};

}  // namespace

std::vector<Tracklet> ReadTracklets(const std::string& path) { return TrackletFile(path).Read(); }

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
