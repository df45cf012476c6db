// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/silhouette.h"
#include "perception/projection.h"
#include "sim/check_fields.h"
#include "sim/random.h"
#include "sim/streams.h"

namespace sslcd::sim {
namespace {

/// Unit normals for [radial, lateral, vertical, yaw, length, width, height].
using Draw = std::array<double, 7>;

Draw DrawNormals(Random& random) {
  Draw draw;
  for (double& value : draw) value = random.Normal();
  return draw;
}

/// An object in view and the share of it inside the image.
struct Sighting {
  const WorldObject* object = nullptr;
  Pose T_cam_object;
  Box2d box;
  Silhouette silhouette;
  double in_image = 0;
};

std::vector<Sighting> InView(const World& world, int frame) {
  const Pose T_cam_world = world.truth.poses[frame].inverse();
  Camera endless = world.camera;
  endless.width = endless.height = 0;
  std::vector<Sighting> sightings;
  for (const WorldObject& object : world.objects) {
    if (!object.IsThereAt(frame)) continue;
    const Pose T_cam_object = T_cam_world * object.PoseAt(frame);
    constexpr double kInFront = 0.5;  // [m] set by hand
    const double reach = 0.5 * object.dims.norm();
    if (T_cam_object.translation().z() < reach + kInFront) continue;  // beside or behind the camera
    const auto box = ProjectCuboid(T_cam_object, object.dims, world.camera);
    const auto whole = ProjectCuboid(T_cam_object, object.dims, endless);
    if (!box || !whole) continue;
    sightings.push_back({&object, T_cam_object, *box, SilhouetteOf(T_cam_object, object.dims),
                         box->Area() / whole->Area()});
  }
  return sightings;
}

class Detector {
 public:
  Detector(const World& world, const DetectorNoise& noise, std::uint64_t seed)
      : world_(world), noise_(noise), random_(seed, kDetectorStream) {
    constant_.reserve(world.objects.size());
    for (std::size_t i = 0; i < world.objects.size(); ++i)
      constant_.push_back(DrawNormals(random_));
  }

  void Detect(int frame, SimulatedDetections& result) {
    // Scores: mean at range 0, its decrease up to the largest range, standard deviation and limits;
    // range of those of false detections. Set by hand.
    constexpr double kNearScore = 0.95, kDecrease = 0.25, kSigma = 0.04;
    constexpr double kMinScore = 0.05, kMaxScore = 0.999, kFalseLow = 0.3, kFalseHigh = 0.7;
    result.frames.emplace_back();
    const std::vector<Sighting> sightings = InView(world_, frame);
    std::vector<Silhouette> silhouettes;
    silhouettes.reserve(sightings.size());
    for (const Sighting& sighting : sightings) silhouettes.push_back(sighting.silhouette);

    for (const Sighting& sighting : sightings) {
      const double range = sighting.silhouette.range;
      if (range > noise_.max_range_m || sighting.in_image < noise_.min_visible) continue;
      const double visible = VisibleFraction(sighting.silhouette, silhouettes);
      if (visible < noise_.min_visible) continue;
      const double far = range / noise_.max_range_m;
      const double miss_range =
          noise_.miss_rate_near + far * (noise_.miss_rate_far - noise_.miss_rate_near);
      const double miss_hidden = (1 - visible) * noise_.miss_rate_hidden;
      if (random_.Chance(1 - (1 - miss_range) * (1 - miss_hidden))) continue;
      const double score =
          std::clamp(random_.Normal(kNearScore - kDecrease * far, kSigma), kMinScore, kMaxScore);
      Push(Measure(sighting), score, sighting.object->id, result);
    }
    const int false_positives = random_.Poisson(noise_.false_positives);
    for (int i = 0; i < false_positives; ++i) {
      Detection detection = Imagine();
      if (detection.box)
        Push(std::move(detection), random_.Uniform(kFalseLow, kFalseHigh), -1, result);
    }
  }

 private:
  static void Push(Detection detection, double score, int identity, SimulatedDetections& result) {
    detection.row = static_cast<int>(result.identity.size());
    detection.score = score;
    result.frames.back().push_back(std::move(detection));
    result.identity.push_back(identity);
  }

  Detection Measure(const Sighting& sighting) {
    const WorldObject& object = *sighting.object;
    const Vec3 position = sighting.T_cam_object.translation();
    const DetectionSigmas sigmas =
        SigmasAt(position.norm(), noise_.sigmas, NoiseScale::Uniform(noise_.scale));
    Draw error = DrawNormals(random_);
    for (std::size_t i = 0; i < error.size(); ++i) {
      error[i] = std::sqrt(noise_.constant_fraction) * constant_[object.id][i] +
                 std::sqrt(1 - noise_.constant_fraction) * error[i];
    }

    Detection detection;
    detection.label = Mistaken(object.label);
    const Vec3 offset(sigmas.radial * error[0], sigmas.lateral * error[1],
                      sigmas.vertical * error[2]);
    double yaw = upright_.YawOf(sighting.T_cam_object.so3()) + sigmas.yaw * error[3];
    if (random_.Chance(noise_.flip_rate)) yaw += M_PI;
    if (world_.labels[object.label].symmetry == Symmetry::kFull) yaw = random_.Uniform(-M_PI, M_PI);
    detection.T_cam_object =
        Pose(upright_.Upright(WrapAngle(yaw)), position + RayFrame(position).transpose() * offset);
    constexpr double kMinSize = 0.2;  // measured over true size; set by hand
    const double size_sigma = noise_.sigmas.size_relative * noise_.scale;
    for (int i = 0; i < 3; ++i)
      detection.dims[i] = object.dims[i] * std::max(kMinSize, 1 + size_sigma * error[4 + i]);
    detection.box = Blur(sighting.box);
    return detection;
  }

  /// Confuses cars with vans, and poles with trees.
  std::string Mistaken(const std::string& label) {
    if (noise_.wrong_label == 0 || !random_.Chance(noise_.wrong_label)) return label;
    constexpr std::pair<const char*, const char*> kMistakes[] = {
        {"Car", "Van"}, {"Van", "Car"}, {"Truck", "Van"}, {"Pole", "Tree"}, {"Tree", "Pole"}};
    for (const auto& [truth, mistake] : kMistakes) {
      if (label == truth && world_.labels.entries().count(mistake) > 0) return mistake;
    }
    return label;
  }

  std::optional<Box2d> Blur(Box2d box) {
    for (double* side : {&box.left, &box.top, &box.right, &box.bottom})
      *side += random_.Normal(0, noise_.box_sigma_px);
    box = {std::max(box.left, 0.), std::max(box.top, 0.),
           std::min<double>(box.right, world_.camera.width),
           std::min<double>(box.bottom, world_.camera.height)};
    return box.Area() > 0 ? std::optional(box) : std::nullopt;
  }

  /// A false detection of a car on the ground, at a random place in the image.
  Detection Imagine() {
    // Smallest range, height of a car's centre with its scatter. Set by hand, as the sizes. [m]
    constexpr double kMinRange = 8, kCentreHeight = 0.75, kHeightSigma = 0.2;
    const double half_view = std::atan(0.5 * world_.camera.width / world_.camera.fx);
    const double range = random_.Uniform(kMinRange, std::max(kMinRange + 1, noise_.max_range_m));
    const double bearing = random_.Uniform(-half_view, half_view);
    const double yaw = random_.Uniform(-M_PI, M_PI);
    const double down = random_.Normal(world_.camera_height_m - kCentreHeight, kHeightSigma);
    Detection detection;
    detection.label = "Car";
    detection.dims = {random_.Uniform(3, 5), random_.Uniform(1.4, 2), random_.Uniform(1.3, 1.9)};
    detection.T_cam_object = Pose(upright_.Upright(yaw),
                                  Vec3(range * std::sin(bearing), down, range * std::cos(bearing)));
    detection.box = ProjectCuboid(detection.T_cam_object, detection.dims, world_.camera);
    return detection;
  }

  const World& world_;
  const DetectorNoise& noise_;
  Random random_;
  GravityFrame upright_;        ///< of the camera, which is level
  std::vector<Draw> constant_;  ///< of each object
};

}  // namespace

Trajectory SimulateOdometry(const Trajectory& truth, const OdometryNoise& noise,
                            std::uint64_t seed) {
  CheckFields(noise);
  Random random(seed, kOdometryStream), slow(seed, kWanderStream);
  double heading_wander = slow.Normal(), scale_wander = slow.Normal();
  Trajectory odometry{truth.stamps, {}};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i == 0) {
      odometry.poses.emplace_back();
      continue;
    }
    Pose step = truth.poses[i - 1].inverse() * truth.poses[i];
    const double length = step.translation().norm();
    const double spread = std::sqrt(length);
    const auto walk = [&](double sigma) { return spread * random.Normal(0, sigma); };
    Pose::Tangent error;
    for (int axis : {0, 1, 2}) error[axis] = walk(noise.position_m_per_sqrt_m);
    error[3] = walk(noise.tilt_rad_per_sqrt_m);
    error[4] = walk(noise.heading_rad_per_sqrt_m);  // y is the vertical
    error[5] = walk(noise.tilt_rad_per_sqrt_m);

    const double kept = std::exp(-length / noise.wander_m), fresh = std::sqrt(1 - kept * kept);
    heading_wander = kept * heading_wander + fresh * slow.Normal();
    scale_wander = kept * scale_wander + fresh * slow.Normal();
    error[4] += noise.wander_rad_per_m * heading_wander * length;
    step.translation() *= 1 + noise.scale_error + noise.wander_scale * scale_wander;
    odometry.poses.push_back(odometry.poses.back() * step * Pose::Exp(error));
  }
  return odometry;
}

SimulatedDetections SimulateDetections(const World& world, const DetectorNoise& noise,
                                       std::uint64_t seed) {
  CheckFields(noise);
  Detector detector(world, noise, seed);
  SimulatedDetections result;
  for (std::size_t frame = 0; frame < world.truth.size(); ++frame)
    detector.Detect(static_cast<int>(frame), result);
  return result;
}

std::vector<Frame> MakeFrames(const Trajectory& odometry, const SimulatedDetections& detections) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < std::min(odometry.size(), detections.frames.size()); ++i) {
    frames.push_back(
        {static_cast<int>(i), odometry.stamps[i], odometry.poses[i], detections.frames[i], "", ""});
  }
  return frames;
}

void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise) {
  visitor.Real("scale_error", noise.scale_error, -0.5, 1,
               "odometry steps are too long by this fraction");
  visitor.Real("heading_rad_per_sqrt_m", noise.heading_rad_per_sqrt_m, 0, 1,
               "random walk of the odometry's heading");
  visitor.Real("tilt_rad_per_sqrt_m", noise.tilt_rad_per_sqrt_m, 0, 1,
               "random walk of its roll and pitch");
  visitor.Real("position_m_per_sqrt_m", noise.position_m_per_sqrt_m, 0, 10,
               "random walk of its position");
  visitor.Real("wander_rad_per_m", noise.wander_rad_per_m, 0, 1,
               "slowly varying drift of its heading");
  visitor.Real("wander_scale", noise.wander_scale, 0, 1, "slowly varying error of its scale");
  visitor.Real("wander_m", noise.wander_m, 0.1, 1e6, "after so much path these are something else");
}

void DescribeFields(FieldVisitor& visitor, DetectorNoise& noise) {
  visitor.Nested("sigmas", noise.sigmas,
                 "standard deviations of a detection as a function of range");
  visitor.Real("size_relative", noise.sigmas.size_relative, 1e-4, 1,
               "standard deviation of each dimension, share of that dimension");
  visitor.Real("scale", noise.scale, 0, 100, "factor on all standard deviations of the detections");
  visitor.Real("constant_fraction", noise.constant_fraction, 0, 1,
               "share of the variance that is constant per object");
  visitor.Real("flip_rate", noise.flip_rate, 0, 1, "front and back mistaken");
  visitor.Real("box_sigma_px", noise.box_sigma_px, 0, 100,
               "standard deviation of each side of the 2D boxes");
  visitor.Real("max_range_m", noise.max_range_m, 1, 1e4, "nothing is detected beyond");
  visitor.Real("miss_rate_near", noise.miss_rate_near, 0, 1,
               "chance to miss a visible object at range 0");
  visitor.Real("miss_rate_far", noise.miss_rate_far, 0, 1,
               "chance to miss a visible object at the maximal range");
  visitor.Real("miss_rate_hidden", noise.miss_rate_hidden, 0, 1,
               "chance to miss an object all but hidden");
  visitor.Real("min_visible", noise.min_visible, 0, 1,
               "objects of which less is visible are not detected");
  visitor.Real("wrong_label", noise.wrong_label, 0, 1,
               "chance that a car is called a van, a pole a tree, ...");
  visitor.Real("false_positives", noise.false_positives, 0, 100, "mean number per frame");
}

}  // namespace sslcd::sim
