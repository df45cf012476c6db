// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_glb.h"

#include <cmath>

#include "run_export/gltf.h"

namespace sslcd {
namespace {

using Json = GltfBuilder::Json;

template <class Values>
Json RoundedList(const Values& values, double steps_per_unit) {
  Json list = Json::array();
  for (const double value : values)
    list.push_back(std::round(value * steps_per_unit) / steps_per_unit + 0.);
  return list;
}

class RunGlbMaker {
 public:
  explicit RunGlbMaker(const RunScene& scene)
      : scene_(scene),
        R_file_world_(PageAxes(scene.gravity)),
        origin_(scene.T_world_first.translation()) {}

  std::string Make() {
    const int root = file_.AddNode({{"name", scene_.name}});
    Json children = Json::array();
    if (!scene_.objects.empty()) children.push_back(AddObjects());
    for (const RunScene::Path& path : scene_.paths) {
      std::vector<Vec3> points;
      for (const Vec3& point : path.points) points.push_back(InFile(point));
      const int mesh =
          file_.AddPath(std::move(points), file_.AddLineMaterial(path.name, path.colour));
      children.push_back(file_.AddNode({{"name", path.name}, {"mesh", mesh}}));
    }
    if (!scene_.loops.empty()) children.push_back(AddLoops());
    file_.nodes()[root]["children"] = std::move(children);
    file_.nodes()[root]["extras"]["T_world_file"] = Back();
    return file_.Bytes();
  }

 private:
  Vec3 InFile(const Vec3& p) const { return R_file_world_ * (p - origin_); }

  Json Back() const {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row)
      rows.push_back(
          {R_file_world_(0, row), R_file_world_(1, row), R_file_world_(2, row), origin_[row]});
    rows.push_back({0, 0, 0, 1});
    return rows;
  }

  // A node of all objects, with one for each label, which has its objects.
  int AddObjects() {
    Json groups = Json::array(), members = Json::array();
    std::string label;
    int mesh = 0;
    const auto close_group = [&] {
      if (members.empty()) return;
      groups.push_back(file_.AddNode({{"name", label}, {"children", std::move(members)}}));
      members = Json::array();
    };
    for (const RunScene::Object& each : scene_.objects) {  // sorted by label
      if (members.empty() || each.object.label != label) {
        close_group();
        label = each.object.label;
        mesh = file_.AddSolid(each.round ? UnitCylinder() : UnitBox(),
                              file_.AddMaterial(label, each.colour));
      }
      members.push_back(AddObject(each, mesh));
    }
    close_group();
    return file_.AddNode({{"name", "objects"}, {"children", std::move(groups)}});
  }

  int AddObject(const RunScene::Object& each, int mesh) {
    const MapObject& object = each.object;
    const Eigen::Matrix3d R = R_file_world_ * object.T_world_object.so3().matrix();
    const Eigen::Vector4d rotation = Eigen::Quaterniond(R).normalized().coeffs();  // x y z w
    Json node;
    node["name"] = each.name;
    node["mesh"] = mesh;
    node["translation"] = RoundedList(InFile(object.T_world_object.translation()), 1e4);
    node["rotation"] = RoundedList(rotation, 1e8);
    node["scale"] = Json::array({object.dims.x(), object.dims.y(), object.dims.z()});
    node["extras"] = {{"landmark", object.id.value},
                      {"label", object.label},
                      {"sightings", object.observations.size()}};
    return file_.AddNode(std::move(node));
  }

  int AddLoops() {
    std::vector<Vec3> points;
    std::vector<Colour> colours;
    Json names = Json::array();
    for (const RunScene::Loop& loop : scene_.loops) {
      points.insert(points.end(), {InFile(loop.match), InFile(loop.query)});
      colours.push_back(loop.colour);
      names.push_back(loop.name);
    }
    const int mesh =
        file_.AddLines(points, colours, file_.AddLineMaterial("loops", {255, 255, 255}));
    return file_.AddNode({{"name", "loops"}, {"mesh", mesh}, {"extras", {{"names", names}}}});
  }

  const RunScene& scene_;
  Eigen::Matrix3d R_file_world_;
  Vec3 origin_;
  GltfBuilder file_;
};

}  // namespace

std::string RunGlb(const RunScene& scene) { return RunGlbMaker(scene).Make(); }

}  // namespace sslcd
