// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/check_fields.h"
#include "sim/furnish.h"
#include "sim/halv.h"
#include "sim/halv_course.h"
#include "sim/layout_file.h"
#include "sim/slots.h"
#include "sim/streams.h"

namespace sslcd::sim {
namespace {

constexpr double kCameraHeight = 1.2;  // of a camera on a ground vehicle [m]

/// ZED 2 according to the paper's table of sensors: 1280x720, 110 x 70 degrees, baseline of 12 cm.
World EmptyWorld(double render_scale) {
  World world;
  const int width = static_cast<int>(std::lround(1280 * render_scale));
  const int height = static_cast<int>(std::lround(720 * render_scale));
  const auto focal = [](double pixels, double degrees) {
    return 0.5 * pixels / std::tan(0.5 * degrees * M_PI / 180);
  };
  world.camera = {focal(width, 110),
                  focal(height, 70),
                  0.5 * (width - 1),
                  0.5 * (height - 1),
                  Vec3(0, 0, 0),
                  width,
                  height};
  world.camera_height_m = kCameraHeight;
  world.baseline_m = 0.12;
  for (const char* label : {"Car", "Van", "Truck"}) world.labels.Set(label, {Symmetry::kNone});
  for (const char* label : {"Pole", "Tree"}) world.labels.Set(label, {Symmetry::kFull});
  return world;
}

struct Places {
  std::vector<Slot> vehicles, marks;
  double taken_fraction = 1;  ///< share of occupied places
  int left_out = 0;
};

Places PlacesOf(const HalvScene& scene, const HalvCourse& course) {
  if (scene.layout == "lot") {
    return {LotSlots(course.points), LotMarks(course.points), scene.taken_fraction, 0};
  }
  if (scene.layout == "street") {
    return {StreetSlots(course.path, course.points), StreetMarks(course.path, course.points),
            scene.taken_fraction, 0};
  }
  const LayoutFile file = ReadLayout(scene.layout);
  PlacedLayout placed = PlaceLayout(file.slots, course);
  return {std::move(placed.slots), {}, 1, file.doubles + placed.in_the_way};
}

WorldObject& Park(World& world, Random& random, const HalvScene& scene, Slot slot) {
  const double kind = random.Uniform();
  if (slot.label.empty()) {
    slot.label = kind < scene.truck_fraction                        ? "Truck"
                 : kind < scene.truck_fraction + scene.van_fraction ? "Van"
                                                                    : "Car";
  }
  // How much longer, wider and higher than cars vans and trucks are; share that parks the other way
  // round; how exactly drivers park. Set by hand. [m], [rad]
  const Vec3 van_extra(0.4, 0.2, 0.5), truck_extra(0.6, 0.35, 1.1);
  constexpr double kTurned = 0.3, kPlaceSigma = 0.12, kHeadingSigma = 0.03;
  const Vec3 car = CarDims(random);
  const Vec3 dims = slot.label == "Car"   ? car
                    : slot.label == "Van" ? Vec3(car + van_extra)
                                          : Vec3(car + truck_extra);
  const bool from_file = scene.layout != "lot" && scene.layout != "street";
  if (!from_file) {  // real cars do not park exactly
    if (random.Chance(kTurned)) slot.heading += M_PI;
    slot.x += random.Normal(0, kPlaceSigma);
    slot.z += random.Normal(0, kPlaceSigma);
    slot.heading += random.Normal(0, kHeadingSigma);
  }
  WorldObject& object = Add(world, slot.label, dims, {PoseOf(slot, CentreY(world, dims))});
  object.paint = DrawPaint(random);
  return object;
}

void AddMark(World& world, Random& random, const Slot& slot) {
  // Sizes of trees [m] and colours: set by hand.
  const bool tree = slot.label == "Tree";
  const double crown = random.Uniform(1.2, 2.2), height = random.Uniform(3.5, 6);
  const Vec3 dims = tree ? Vec3(crown, crown, height) : PoleDims(random);
  WorldObject& object = Add(world, slot.label, dims, {PoseOf(slot, CentreY(world, dims))});
  object.paint = tree ? Vec3(0.2, 0.33, 0.13) : Vec3(0.5, 0.5, 0.52);
}

/// Draws `count` distinct numbers below `size`, in random order.
std::vector<int> Draw(Random& random, int size, int count) {
  std::vector<int> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  for (int i = 0; i < count; ++i)
    std::swap(numbers[i], numbers[i + static_cast<int>(random.Uniform() * (size - i))]);
  numbers.resize(count);
  return numbers;
}

struct Parked {
  int id = 0;  ///< WorldObject::id
  Slot slot;
};

/// Replaces some vehicles from a frame on by others, at the same place or at a free one.
void Churn(const HalvScene& scene, std::uint64_t seed, int frame, const std::vector<Parked>& parked,
           std::vector<Slot> free, World& world) {
  Random random(seed, kChurnStream);
  const int count = static_cast<int>(std::lround(scene.churn * static_cast<double>(parked.size())));
  for (int number : Draw(random, static_cast<int>(parked.size()), count)) {
    world.objects[parked[number].id].end_frame = frame;
    Slot slot = parked[number].slot;
    if (!free.empty() && random.Chance(0.5)) {
      std::swap(free[static_cast<std::size_t>(random.Uniform() * static_cast<double>(free.size()))],
                free.back());
      slot = free.back();
      free.pop_back();
    }
    Park(world, random, scene, slot).first_frame = frame;
  }
}

void CheckCars(const std::vector<Slot>& parked, const HalvCourse& course) {
  constexpr int kEnough = 8;    // set by hand
  constexpr double kSeen = 15;  // largest distance from the path [m]; set by hand
  const auto beside = std::count_if(parked.begin(), parked.end(), [&](const Slot& slot) {
    return std::any_of(course.points.begin(), course.points.end(), [&](const Path::Point& point) {
      return std::hypot(slot.x - point.x, slot.z - point.z) < kSeen;
    });
  });
  if (beside >= kEnough) return;
  throw Error(ErrorKind::kUsage,
              "no cars: only " + std::to_string(beside) + " stand beside the path, at least " +
                  std::to_string(kEnough) +
                  " are needed; raise --taken-fraction or take another layout or a larger --size");
}

}  // namespace

HalvWorld MakeHalvWorld(std::uint64_t seed, const HalvScene& scene) {
  CheckFields(scene);
  for (const double degrees : {scene.viewpoint_low_deg, scene.viewpoint_high_deg})
    if (degrees < 0 && degrees != -1)
      throw Error(ErrorKind::kUsage,
                  "viewpoint_low_deg and viewpoint_high_deg are 0 to 180, or -1: the case's");
  const HalvCase& shape = HalvCaseOf(scene.case_number);
  const double low = scene.viewpoint_low_deg < 0 ? shape.viewpoint_low : scene.viewpoint_low_deg;
  const double high =
      scene.viewpoint_high_deg < 0 ? shape.viewpoint_high : scene.viewpoint_high_deg;
  if (low > high)
    throw Error(ErrorKind::kUsage,
                "viewpoint_low_deg is larger than viewpoint_high_deg: give both, low to high");
  const HalvCourse course = MakeHalvCourse(shape, low, high, scene.size, seed);
  Places places = PlacesOf(scene, course);

  Random random(seed, kWorldStream);
  std::vector<Slot> parked, free;
  for (const Slot& slot : places.vehicles)
    (random.Chance(places.taken_fraction) ? parked : free).push_back(slot);
  CheckCars(parked, course);

  HalvWorld result{EmptyWorld(scene.render_scale), 0, course.viewpoint_rad, places.left_out, {}};
  const bool street = scene.layout == "street";
  for (const Slot& slot : places.vehicles)
    result.spaces.push_back({slot.x, slot.z, slot.heading, street ? 5.8 : 5., street ? 2.2 : 2.6});
  World& world = result.world;
  const double step = scene.speed_mps / scene.keyframe_hz;
  result.return_frame = static_cast<int>(std::ceil(course.return_m / step));
  Drive(course.path, 1 + static_cast<int>(course.path.length() / step), scene.keyframe_hz,
        scene.speed_mps, world);
  for (const Slot& slot : parked) Park(world, random, scene, slot);
  if (scene.marks) {
    for (const Slot& slot : places.marks) AddMark(world, random, slot);
  }
  for (int i = 0; i < scene.driving_cars; ++i) {
    const double speed = scene.speed_mps * random.Uniform(1.5, 3);
    const bool oncoming = i % 2 == 1;
    const double start =
        oncoming ? 0.5 * course.return_m + speed * random.Uniform(5, 20) : 10 + 12 * i;
    AddDrivingCar(world, random, course.path, start, oncoming ? -2.5 : 0, oncoming ? -speed : speed)
        .paint = DrawPaint(random);
  }
  std::vector<Parked> vehicles;  // the first objects
  for (const Slot& slot : parked) vehicles.push_back({static_cast<int>(vehicles.size()), slot});
  Churn(scene, seed, result.return_frame, vehicles, free, world);
  return result;
}

void ReplaceVehicles(const HalvScene& scene, std::uint64_t seed, int frame, HalvWorld& world) {
  constexpr double kInSpace = 1.5;  // a vehicle parks nearer to the centre than this [m]
  std::vector<Parked> parked;
  std::vector<Slot> free;
  for (const ParkingSpace& space : world.spaces) {
    const Slot slot{space.x, space.z, space.heading, ""};
    const auto there = std::find_if(
        world.world.objects.begin(), world.world.objects.end(), [&](const WorldObject& object) {
          const Vec3& p = object.T_world_object[0].translation();
          return !object.driving() && object.IsThereAt(frame - 1) &&
                 world.world.labels[object.label].symmetry == Symmetry::kNone &&
                 std::hypot(p.x() - space.x, p.z() - space.z) < kInSpace;
        });
    if (there == world.world.objects.end())
      free.push_back(slot);
    else
      parked.push_back({there->id, slot});
  }
  Churn(scene, seed, frame, parked, free, world.world);
}

void DescribeFields(FieldVisitor& visitor, HalvScene& scene) {
  visitor.Integer("case", scene.case_number, 1, 4,
                  "1 rectangle, 2 straight out and back, 3 curve, 4 small loop");
  visitor.Text("layout", scene.layout, "lot, street, or a JSON file of parked cars");
  visitor.Real("viewpoint_low_deg", scene.viewpoint_low_deg, -1, 180,
               "smallest angle between the passes; -1: the case's");
  visitor.Real("viewpoint_high_deg", scene.viewpoint_high_deg, -1, 180,
               "largest angle between the passes; -1: the case's");
  visitor.Real("size", scene.size, 0.3, 6, "factor on the straight parts of the path");
  visitor.Real("speed_mps", scene.speed_mps, 0.1, 50, "speed of the camera");
  visitor.Real("keyframe_hz", scene.keyframe_hz, 0.1, 100, "keyframes per second");
  visitor.Real("taken_fraction", scene.taken_fraction, 0, 1,
               "fraction of the generated parking spaces that is taken");
  visitor.Real("van_fraction", scene.van_fraction, 0, 0.5,
               "share of vans among the parked vehicles");
  visitor.Real("truck_fraction", scene.truck_fraction, 0, 0.5, "share of trucks among them");
  visitor.Flag("marks", scene.marks, "poles and trees in generated layouts");
  visitor.Real("churn", scene.churn, 0, 1,
               "share of the parked vehicles that is replaced before the second pass");
  visitor.Integer("driving_cars", scene.driving_cars, 0, 100,
                  "cars that drive; every second one is oncoming");
  visitor.Real("render_scale", scene.render_scale, 0.05, 4, "size of the images; 1: 1280x720");
}

}  // namespace sslcd::sim
