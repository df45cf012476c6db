// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_model.h"

#include "render/noise.h"
#include "render/tree_and_pole.h"

namespace sslcd::render {
namespace {

Mesh GroundMesh() {
  constexpr float kFar = 900;
  Mesh mesh;
  AddQuad(mesh, {-kFar, -kFar, 0}, {kFar, -kFar, 0}, {kFar, kFar, 0}, {-kFar, kFar, 0}, 0);
  ComputeNormals(mesh);
  return mesh;
}

}  // namespace

SceneModel::SceneModel(const sim::HalvWorld& scene, std::uint32_t seed)
    : world_(scene.world),
      T_scene_world_(SceneFromWorld(world_)),
      used_(FindUsedArea(world_)),
      town_(MakeTown(used_, Hash(seed, 1))),
      ground_(scene, used_, Hash(seed, 2)) {
  AddObjects(Hash(seed, 3));
  AddSurroundings(Hash(seed, 4));
  AddWheelStops(scene.spaces, Hash(seed, 5));
}

void SceneModel::AddObjects(std::uint32_t seed) {
  shapes_.resize(world_.objects.size());
  for (const sim::WorldObject& object : world_.objects) {
    SceneObject scene_object{{static_cast<int>(meshes_.size()), Pose()},
                             Kind::kVehicle,
                             object.id,
                             Hash(seed, static_cast<std::uint32_t>(object.id))};
    const Vec3f dims = object.dims.cast<float>();
    if (IsVehicle(object)) {
      shapes_[object.id] = MakeCarShape(object, scene_object.seed);
      meshes_.push_back(MakeCarMesh(shapes_[object.id]));
    } else if (object.label == "Tree") {
      scene_object.kind = Kind::kTree;
      meshes_.push_back(MakeTreeMesh(dims, scene_object.seed));
    } else {
      scene_object.kind = Kind::kPole;
      meshes_.push_back(MakePoleMesh(dims));
    }
    objects_.push_back(scene_object);
  }
}

void SceneModel::AddSurroundings(std::uint32_t seed) {
  const auto add = [&](const Mesh& mesh) {
    meshes_.push_back(mesh);
    return static_cast<int>(meshes_.size()) - 1;
  };
  surroundings_.push_back({{add(GroundMesh()), Pose()}, Kind::kGround, -1, seed});
  if (!town_.buildings.empty())
    surroundings_.push_back({{add(MakeTownMesh(town_)), Pose()}, Kind::kTown, -1, seed});
  constexpr std::uint32_t kKinds = 5;
  const int first = static_cast<int>(meshes_.size());
  for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
    const float height = Mix(4.5f, 9, Unit(Hash(seed, kind)));
    add(MakeTreeMesh({0.55f * height, 0.55f * height, height}, Hash(seed, kind + 10)));
  }
  std::uint32_t number = 0;
  for (const Vec2f& place : town_.trees) {
    const std::uint32_t tree = Hash(seed, ++number + 100);
    surroundings_.push_back({{first + static_cast<int>(tree % kKinds),
                              Pose(lie::SO3<double>(), Vec3(place.x(), place.y(), 0))},
                             Kind::kTree,
                             -1,
                             tree});
  }
}

void SceneModel::AddWheelStops(const std::vector<sim::ParkingSpace>& spaces, std::uint32_t seed) {
  constexpr double kSideBySide = 2.4;  // spaces along a kerb are narrower and have no stall lines
  Mesh mesh;
  AddBox(mesh, {-0.08f, -0.85f, 0}, {0.08f, 0.85f, 0.1f}, 0);
  ComputeNormals(mesh);
  meshes_.push_back(mesh);
  for (const sim::ParkingSpace& space : spaces) {
    if (space.width_m < kSideBySide) continue;
    const double ahead = 0.5 * space.length_m - 0.25;
    const Vec3 at(space.x + ahead * std::sin(space.heading),
                  space.z + ahead * std::cos(space.heading), 0);
    const Pose T_scene_stop(lie::SO3<double>::Exp(Vec3(0, 0, 0.5 * M_PI - space.heading)), at);
    const std::uint32_t own = Hash(seed, static_cast<std::uint32_t>(surroundings_.size()));
    surroundings_.push_back(
        {{static_cast<int>(meshes_.size()) - 1, T_scene_stop}, Kind::kWheelStop, -1, own});
  }
}

std::vector<SceneModel::SceneObject> SceneModel::ObjectsAt(int frame) const {
  std::vector<SceneObject> objects = surroundings_;
  for (const sim::WorldObject& object : world_.objects) {
    if (!object.IsThereAt(frame)) continue;
    SceneObject scene_object = objects_[object.id];
    const Pose T_object_mesh(lie::SO3<double>(), Vec3(0, 0, -0.5 * object.dims.z()));
    scene_object.instance.T_world_mesh = T_scene_world_ * object.PoseAt(frame) * T_object_mesh;
    objects.push_back(scene_object);
  }
  return objects;
}

Surface SceneModel::SurfaceOf(const SceneObject& scene_object, const SurfacePoint& point) const {
  static const Vec3f kLeaves(0.24f, 0.34f, 0.14f);
  const Vec3f paint = scene_object.identity < 0
                          ? kLeaves
                          : Vec3f(world_.objects[scene_object.identity].paint.cast<float>());
  switch (scene_object.kind) {
    case Kind::kGround: return ground_.At(point);
    case Kind::kTown: return TownSurface(town_, point);
    case Kind::kTree: return TreeSurface(paint, scene_object.seed, point);
    case Kind::kWheelStop: return WheelStopSurface(scene_object.seed, point);
    case Kind::kPole: return PoleSurface(paint, scene_object.seed, point);
    default: return CarSurface(shapes_[scene_object.identity], paint, point);
  }
}

}  // namespace sslcd::render
