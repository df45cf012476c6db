// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/sigmoid.h"
#include "detectors/decode_3d.h"
#include "formats/npy.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// Divisors of the regression values in training: centre and size of the boxes, image of the centre.
constexpr double kCentreUnit = 0.1, kSizeUnit = 0.2;
enum Regression {
  kDx,
  kDy,
  kDw,
  kDh,
  kCx,
  kCy,
  kZ,
  kSin,
  kCos,
  kWidth,
  kHeight,
  kLength,
  kRegressions
};
enum Prior { kPriorZ, kPriorSin, kPriorCos, kPriorWidth, kPriorHeight, kPriorLength, kPriorCount };

std::vector<std::array<double, 6>> ReadPriors(const std::string& path, std::size_t rows) {
  const NpyMatrix matrix = ReadNpy(path);
  if (matrix.rows != rows || matrix.columns != kPriorCount)
    throw Error(ErrorKind::kBadInput, {path},
                "is " + std::to_string(matrix.rows) + "x" + std::to_string(matrix.columns) +
                    ", the anchors need " + std::to_string(rows) +
                    "x6: save it with .reshape(-1, 6) (docs/models.md)");
  std::vector<std::array<double, 6>> priors(rows);
  for (std::size_t i = 0; i < rows; ++i)
    std::copy(matrix.Row(i), matrix.Row(i) + kPriorCount, priors[i].begin());
  return priors;
}

struct Anchor {
  double x, y, width, height;  // centre and size in the input [px]
};

/// Anchors of a cell. The scale runs fastest, as in the network's channels; in the statistics the
/// ratio runs fastest.
Anchor AnchorAt(const ModelAnchors& anchors, std::size_t column, std::size_t row,
                std::size_t index) {
  const double side = anchors.base_px * anchors.scales[index % anchors.scales.size()];
  const double root = std::sqrt(anchors.ratios[index / anchors.scales.size()]);
  return {(column + 0.5) * anchors.stride_px, (row + 0.5) * anchors.stride_px, side / root,
          side * root};
}

std::size_t PriorIndex(const ModelAnchors& anchors, std::size_t index) {
  return index % anchors.scales.size() * anchors.ratios.size() + index / anchors.scales.size();
}

/// Whether an object at the anchor's mean depth could be on the road ahead. Uses one focal length
/// for both axes, as in training.
bool IsPlausible(const Anchor& anchor, double mean_z, const ModelAnchors& anchors,
                 const Camera& camera) {
  if (!(mean_z > 0)) return false;
  const double x = (anchor.x - camera.cx) * mean_z / camera.fy,
               y = (anchor.y - camera.cy) * mean_z / camera.fy;
  return y > anchors.min_y_m && y < anchors.max_y_m && std::abs(x) < anchors.max_x_m;
}

ClassCuboid Decode(const Anchor& anchor, const float* v, const std::array<double, 6>& mean,
                   const std::array<double, 6>& std, bool points_forward) {
  const auto scaled = [&](Regression value, Prior prior) {
    return v[value] * std[prior] + mean[prior];
  };
  ClassCuboid cuboid;
  const double x = anchor.x + v[kDx] * kCentreUnit * anchor.width,
               y = anchor.y + v[kDy] * kCentreUnit * anchor.height;
  const double half_width = 0.5 * anchor.width * std::exp(v[kDw] * kSizeUnit);
  const double half_height = 0.5 * anchor.height * std::exp(v[kDh] * kSizeUnit);
  cuboid.found.box = {x - half_width, y - half_height, x + half_width, y + half_height};
  cuboid.centre_x = anchor.x + v[kCx] * kCentreUnit * anchor.width;
  cuboid.centre_y = anchor.y + v[kCy] * kCentreUnit * anchor.height;
  cuboid.depth_m = scaled(kZ, kPriorZ);
  // The network regresses twice the angle, which does not distinguish a car's front and back; the
  // axis score does.
  cuboid.alpha_rad = 0.5 * std::atan2(scaled(kSin, kPriorSin), scaled(kCos, kPriorCos)) +
                     (points_forward ? 0 : M_PI);
  cuboid.dims = {scaled(kLength, kPriorLength), scaled(kWidth, kPriorWidth),
                 scaled(kHeight, kPriorHeight)};
  return cuboid;
}

}  // namespace

std::map<int, AnchorPriors> LoadAnchorPriors(const ModelOutput& output) {
  const ModelAnchors& anchors = output.anchors;
  const std::size_t rows = anchors.scales.size() * anchors.ratios.size();
  std::map<int, AnchorPriors> priors;
  for (const auto& [number, label] : output.labels)
    priors[number] = {ReadPriors(anchors.mean_files.at(number), rows),
                      ReadPriors(anchors.std_files.at(number), rows)};
  return priors;
}

std::vector<ClassCuboid> DecodeAnchors(const std::vector<Tensor>& outputs,
                                       const ModelOutput& output,
                                       const std::map<int, AnchorPriors>& priors,
                                       const Camera& camera, int width, int height) {
  const ModelAnchors& anchors = output.anchors;
  const auto columns = static_cast<std::size_t>(std::ceil(width / anchors.stride_px));
  const auto rows = static_cast<std::size_t>(std::ceil(height / anchors.stride_px));
  const std::size_t per_cell = anchors.scales.size() * anchors.ratios.size();
  const float* logits = outputs[0].values.data();
  const float* regression = outputs[1].values.data();
  std::vector<ClassCuboid> cuboids;
  for (std::size_t i = 0; i < rows * columns * per_cell;
       ++i, logits += output.class_count + 1, regression += kRegressions) {
    const int best =
        static_cast<int>(std::max_element(logits, logits + output.class_count) - logits);
    const double score = Sigmoid(logits[best]);
    const auto prior = priors.find(best);
    if (!(score >= output.min_score) || prior == priors.end()) continue;
    const std::size_t cell = i / per_cell, index = i % per_cell;
    const Anchor anchor = AnchorAt(anchors, cell % columns, cell / columns, index);
    const auto& mean = prior->second.mean[PriorIndex(anchors, index)];
    if (!IsPlausible(anchor, mean[kPriorZ], anchors, camera)) continue;
    ClassCuboid cuboid =
        Decode(anchor, regression, mean, prior->second.std[PriorIndex(anchors, index)],
               Sigmoid(logits[output.class_count]) >= 0.5);
    cuboid.found.class_number = best;
    cuboid.found.score = score;
    cuboids.push_back(cuboid);
  }
  return cuboids;
}

}  // namespace sslcd
