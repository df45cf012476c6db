// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/perception/colour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "perception/kmeans.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// K-means stops after this number of rounds. Set by hand: assignments hardly change after ten.
constexpr int kKMeansRounds = 10;
constexpr std::uint64_t kKMeansSeed = 1;  // any number; fixed for repeatable runs

void CheckColourImage(const ImageView& image) {
  CheckImage(image, "colour image");
  if (image.channels != 3)
    throw Error(ErrorKind::kBadInput, "colour image: it has " + std::to_string(image.channels) +
                                          " channel(s), the colour signature needs 3 (B G R); "
                                          "leave the images out or give colour ones");
}

/// Whole pixels [first, last) of the central part of an interval.
struct PixelRange {
  int first = 0, last = 0;
  int size() const { return last - first; }
};

PixelRange CentralPixels(double low, double high, double share, int image_size) {
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * share * (high - low);
  if (!(half > 0) || !std::isfinite(half)) return {};
  const double size = image_size;
  return {static_cast<int>(std::floor(std::clamp(middle - half, 0., size))),
          static_cast<int>(std::ceil(std::clamp(middle + half, 0., size)))};
}

Eigen::Matrix3Xf SamplePixels(const ImageView& image, const Box2d& box,
                              const ColourOptions& options) {
  const PixelRange columns = CentralPixels(box.left, box.right, options.box_share, image.width);
  const PixelRange rows = CentralPixels(box.top, box.bottom, options.box_share, image.height);
  if (columns.size() <= 0 || rows.size() <= 0) return {};

  const auto samples = [](int size, int step) { return (size + step - 1) / step; };
  int step = 1;
  while (static_cast<double>(samples(columns.size(), step)) * samples(rows.size(), step) >
         std::max(options.max_pixels, 1)) {
    ++step;
  }
  const auto to_colour = options.method == ColourOptions::Method::kPaper ? HsvColour : ConeColour;
  Eigen::Matrix3Xf colours(3, samples(columns.size(), step) * samples(rows.size(), step));
  Eigen::Index count = 0;
  for (int y = rows.first; y < rows.last; y += step) {
    const unsigned char* row = image.data + static_cast<std::size_t>(y) * image.stride;
    for (int x = columns.first; x < columns.last; x += step) {
      const unsigned char* bgr = row + 3 * static_cast<std::size_t>(x);
      colours.col(count++) = to_colour(bgr[2] / 255., bgr[1] / 255., bgr[0] / 255.).cast<float>();
    }
  }
  return colours;
}

/// Points spread over the cone of ConeColour: rings of about equal spacing on four levels.
const std::vector<Vec3>& Palette() {
  static const std::vector<Vec3> palette = [] {
    // All set by hand, in units of the cone's radius and height.
    constexpr double kLevels[] = {0.2, 0.45, 0.7, 0.95};
    constexpr int kRings = 3, kHuesPerRing = 5;
    constexpr double kSaturationMargin = 0.3;  // dark colours have little saturation
    std::vector<Vec3> points;
    for (double level : kLevels) {
      points.emplace_back(0, 0, level);
      for (int ring = 1; ring <= kRings; ++ring) {
        const double radius = ring / static_cast<double>(kRings);
        if (radius > level + kSaturationMargin) continue;
        const int hues = 1 + kHuesPerRing * ring;
        for (int i = 0; i < hues; ++i) {
          const double hue = 2 * M_PI * i / hues;
          points.emplace_back(radius * std::cos(hue), radius * std::sin(hue), level);
        }
      }
    }
    return points;
  }();
  return palette;
}

std::vector<float> SoftAssignment(const ColourSignature& signature, double softness) {
  const std::vector<Vec3>& palette = Palette();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(palette.size());
  for (const ColourCluster& cluster : signature) {
    Eigen::VectorXd distances(palette.size());
    for (std::size_t i = 0; i < palette.size(); ++i)
      distances[i] = (cluster.centre - palette[i]).squaredNorm();
    // Relative to the nearest entry, so that a small softness does not make all of them zero.
    const Eigen::VectorXd likeness =
        (-0.5 / (softness * softness) * (distances.array() - distances.minCoeff())).exp().matrix();
    sum += cluster.weight / likeness.sum() * likeness;
  }
  sum.normalize();
  const Eigen::VectorXf result = sum.cast<float>();
  return {result.data(), result.data() + result.size()};
}

}  // namespace

Vec3 ConeColour(double red, double green, double blue) {
  constexpr double kDark = 0.1;  // below this value chroma fades out; set by hand
  static const double kLogRange = std::log(1 + 1 / kDark);
  const double value = std::max({red, green, blue});
  const double chroma = value - std::min({red, green, blue});
  // The direction of the hue on the colour wheel without trigonometry.
  const double a = red - 0.5 * (green + blue);
  const double b = 0.5 * std::sqrt(3.) * (green - blue);
  const double length = std::hypot(a, b);
  const double scale = length > 0 ? chroma * (1 + kDark) / (value + kDark) / length : 0.;
  return {a * scale, b * scale, std::log(1 + value / kDark) / kLogRange};
}

Vec3 HsvColour(double red, double green, double blue) {
  const double value = std::max({red, green, blue});
  const double chroma = value - std::min({red, green, blue});
  double sextant = 0;
  if (chroma > 0) {
    if (value == red)
      sextant = (green - blue) / chroma;
    else if (value == green)
      sextant = 2 + (blue - red) / chroma;
    else
      sextant = 4 + (red - green) / chroma;
    if (sextant < 0) sextant += 6;
  }
  return {30 * sextant, value > 0 ? 255 * chroma / value : 0., 255 * value};
}

ColourSignature ExtractColour(const ImageView& image, const Box2d& box,
                              const ColourOptions& options) {
  CheckColourImage(image);
  const Eigen::Matrix3Xf pixels = SamplePixels(image, box, options);
  const KMeansResult clusters = KMeans(pixels, {options.clusters, kKMeansRounds, kKMeansSeed});
  ColourSignature signature;
  for (std::size_t i = 0; i < clusters.sizes.size(); ++i) {
    signature.push_back({clusters.centres.col(static_cast<Eigen::Index>(i)).cast<double>(),
                         clusters.sizes[i] / static_cast<double>(pixels.cols())});
  }
  std::stable_sort(
      signature.begin(), signature.end(),
      [](const ColourCluster& a, const ColourCluster& b) { return a.weight > b.weight; });
  return signature;
}

std::vector<float> ColourVector(const ColourSignature& signature, const ColourOptions& options) {
  if (signature.empty()) return {};
  if (options.method == ColourOptions::Method::kRobust)
    return SoftAssignment(signature, options.softness);
  std::vector<float> shares(std::max<std::size_t>(options.clusters, signature.size()), 0.f);
  for (std::size_t i = 0; i < signature.size(); ++i)
    shares[i] = static_cast<float>(signature[i].weight);
  return shares;
}

std::vector<float> ColourVector(const ImageView& image, const Box2d& box,
                                const ColourOptions& options) {
  return ColourVector(ExtractColour(image, box, options), options);
}

void DescribeFields(FieldVisitor& visitor, ColourOptions& options) {
  visitor.Enum("method", options.method, {"robust", "paper"},
               "robust: hue-safe colours on a palette that all objects share; paper: the shares of "
               "an object's own HSV colours");
  visitor.Real("box_share", options.box_share, 0.05, 1,
               "central part of the box whose pixels are used, share of each side");
}

}  // namespace sslcd
