// SPDX-License-Identifier: BSD-3-Clause
#include "sim/appearance.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/check_fields.h"
#include "sim/streams.h"
#include "sslcd/perception/colour.h"

namespace sslcd::sim {
namespace {

using Vector = Eigen::VectorXd;

/// Draws an isotropic vector of unit length on average.
Vector RandomVector(Random& random, int dimension) {
  Vector vector(dimension);
  for (double& value : vector) value = random.Normal();
  return vector / std::sqrt(dimension);
}

/// The parts that are common to all sightings of one object.
struct Identity {
  Vector constant, forward, left;
  double side = 0;  ///< share of the part that rotates with the viewing direction
};

class Painter {
 public:
  Painter(const World& world, const AppearanceNoise& noise, std::uint64_t seed)
      : world_(world),
        noise_(noise),
        random_(seed, kAppearanceStream),
        common_(NewVector().normalized()) {
    for (std::size_t i = 0; i < world.objects.size(); ++i) identities_.push_back(NewIdentity());
  }

  void Embed(int frame, int identity, Detection& detection) {
    // Cosine of two sightings from directions a apart: same_side - side + side cos(a).
    const double blur = Blur(detection);
    const Identity nobody = identity < 0 ? NewIdentity() : Identity();
    const Identity& who = identity < 0 ? nobody : identities_[identity];
    const double direction = identity < 0 ? 0 : ViewedFrom(frame, world_.objects[identity]);
    const Vector clear =
        std::sqrt(noise_.other_object) * common_ +
        std::sqrt(noise_.same_side - noise_.other_object - who.side) * who.constant +
        std::sqrt(who.side) * (std::cos(direction) * who.forward + std::sin(direction) * who.left);
    // `clear` has a squared length of same_side; the rest is noise.
    const Vector vector =
        (std::sqrt((1 - blur) / noise_.same_side) * clear + std::sqrt(blur) * NewVector())
            .normalized();
    detection.appearance[Cue::kEmbedding].assign(vector.begin(), vector.end());
  }

  void Colour(const Vec3& paint, Detection& detection) {
    const double light = std::exp(random_.Normal(0, noise_.light));
    const auto lit = [&](const Vec3& rgb) -> Vec3 {
      return (light * rgb).cwiseMin(1.).cwiseMax(0.);
    };
    struct Part {
      Vec3 rgb;
      double share;
    };
    // Colours (red, green, blue in 0 to 1) and shares of the box. Set by hand.
    const Part parts[] = {
        {lit(paint), random_.Uniform(0.3, 0.45)},               // in the light
        {lit(0.55 * paint), random_.Uniform(0.15, 0.3)},        // in the shade
        {Vec3(0.16, 0.18, 0.2), random_.Uniform(0.1, 0.25)},    // windows
        {Vec3(0.07, 0.07, 0.07), random_.Uniform(0.05, 0.12)},  // tyres
        {lit({0.42, 0.41, 0.4}), random_.Uniform(0.05, 0.2)}};  // the ground behind
    double total = 0;
    for (const Part& part : parts) total += part.share;
    ColourSignature signature;
    for (const Part& part : parts)
      signature.push_back(
          {ConeColour(part.rgb.x(), part.rgb.y(), part.rgb.z()), part.share / total});
    detection.appearance[Cue::kColour] = ColourVector(signature, ColourOptions());
  }

  Random& random() { return random_; }

 private:
  Vector NewVector() { return RandomVector(random_, noise_.dimension); }
  Identity NewIdentity() {
    Identity identity;
    identity.constant = NewVector();
    identity.forward = NewVector();
    identity.left = NewVector();
    const double spread = random_.Uniform(1 - noise_.side_spread, 1 + noise_.side_spread);
    identity.side = std::min(0.5 * (noise_.same_side - noise_.opposite_side) * spread,
                             noise_.same_side - noise_.other_object);
    return identity;
  }

  /// Share of noise in one sighting. It grows with range and varies between images.
  double Blur(const Detection& detection) {
    // Range of a usual detection [m], growth per usual range, and limits. Set by hand.
    constexpr double kUsualRange = 18, kGrowth = 0.4, kMaxFar = 2, kMaxBlur = 0.95;
    const double far = std::min(detection.T_cam_object.translation().norm() / kUsualRange, kMaxFar);
    const double uneven = random_.Uniform(1 - noise_.unevenness, 1 + noise_.unevenness);
    return std::min((1 - noise_.same_side) * uneven * (1 + kGrowth * (far - 1)), kMaxBlur);
  }

  /// Bearing of the camera in the object's frame; 0 if all sides look the same. [rad]
  double ViewedFrom(int frame, const WorldObject& object) const {
    if (world_.labels[object.label].symmetry == Symmetry::kFull) return 0;
    const Vec3 camera = object.PoseAt(frame).inverse() * world_.truth.poses[frame].translation();
    return std::atan2(camera.y(), camera.x());
  }

  const World& world_;
  const AppearanceNoise& noise_;
  Random random_;
  Vector common_;
  std::vector<Identity> identities_;
};

void CheckCosines(const AppearanceNoise& noise) {
  if (noise.same_side >= noise.opposite_side &&
      noise.same_side + noise.opposite_side >= 2 * noise.other_object)
    return;
  throw Error(ErrorKind::kUsage,
              "no embeddings have such cosines: same_side must be at least opposite_side, and "
              "their mean at least "
              "other_object");
}

}  // namespace

void AddAppearance(const World& world, const AppearanceNoise& noise, std::uint64_t seed,
                   SimulatedDetections& detections) {
  CheckFields(noise);
  CheckCosines(noise);
  Painter painter(world, noise, seed);
  for (std::size_t frame = 0; frame < detections.frames.size(); ++frame) {
    for (Detection& detection : detections.frames[frame]) {
      const int identity = detections.identity[detection.row];
      painter.Embed(static_cast<int>(frame), identity, detection);
      painter.Colour(identity < 0 ? DrawPaint(painter.random()) : world.objects[identity].paint,
                     detection);
    }
  }
}

Vec3 DrawPaint(Random& random) {
  struct Paint {
    double share;
    Vec3 rgb;
  };
  // Shares of colours on the road, and their scatter. Set by hand.
  constexpr double kScatter = 0.08, kDarkest = 0.02;
  static const Paint kPaints[] = {
      {0.22, {0.92, 0.92, 0.9}},  {0.13, {0.4, 0.41, 0.42}},   // white, grey
      {0.15, {0.06, 0.06, 0.07}}, {0.13, {0.7, 0.71, 0.72}},   // black, silver
      {0.14, {0.1, 0.2, 0.5}},    {0.11, {0.6, 0.08, 0.08}},   // blue, red
      {0.05, {0.12, 0.3, 0.16}},  {0.04, {0.45, 0.36, 0.26}},  // green, brown
      {0.03, {0.85, 0.65, 0.1}}};                              // yellow
  double left = random.Uniform();
  const Paint* paint = kPaints;
  while (left >= paint->share && paint + 1 != std::end(kPaints)) left -= (paint++)->share;
  Vec3 rgb;
  for (int i = 0; i < 3; ++i)
    rgb[i] = std::clamp(paint->rgb[i] * (1 + random.Normal(0, kScatter)), kDarkest, 1.);
  return rgb;
}

void DescribeFields(FieldVisitor& visitor, AppearanceNoise& noise) {
  visitor.Integer("dimension", noise.dimension, 2, 4096,
                  "length of the embeddings; fewer: cosines scatter more");
  visitor.Real("same_side", noise.same_side, 0.01, 1,
               "mean cosine of an object's embeddings from the same side");
  visitor.Real("opposite_side", noise.opposite_side, 0, 1, "... from opposite sides");
  visitor.Real("other_object", noise.other_object, 0, 1, "... of different objects");
  visitor.Real("side_spread", noise.side_spread, 0, 1,
               "how much more the sides of some objects differ than of others");
  visitor.Real("unevenness", noise.unevenness, 0, 1, "how much better some images are than others");
  visitor.Real("light", noise.light, 0, 2, "standard deviation of an image's log brightness");
}

}  // namespace sslcd::sim
