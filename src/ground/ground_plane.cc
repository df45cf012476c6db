// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/ground/ground_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <utility>

#include "core/median.h"
#include "ground/ground_search.h"
#include "stereo/grey.h"

namespace sslcd {
namespace {

/// q = up / height; the disparity of a pixel on the ground is row . q.
struct Sample {
  Vec3 row;
  double disparity;
  int u, v;
};

constexpr double kGate = 3;  // standard deviations; set by hand
// Standard deviation of the disparity of a ground pixel [px]: semi-global matching pulls
// disparities to whole pixels, by a third of a pixel on slopes (docs/notes, "Cuboids from stereo
// images").
constexpr double kDisparitySigma = 0.5;
constexpr std::size_t kSamples = 20000;  // largest number of pixels, to bound the time
constexpr int kTrials = 200;   // of RANSAC, with three pixels each; most pixels are ground
constexpr unsigned kSeed = 1;  // of RANSAC

bool Covers(const std::vector<Box2d>& boxes, double u, double v) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box2d& box) {
    return u >= box.left && u <= box.right && v >= box.top && v <= box.bottom;
  });
}

/// Data of a pixel below the horizon.
std::vector<Sample> GroundSamples(const GreyPair& grey, const StereoCamera& camera,
                                  const std::vector<Box2d>& objects, const GroundOptions& options) {
  const Camera& left = camera.left;
  const double width = grey.left.cols, height = grey.left.rows;
  const double horizon = left.cy + options.tilt_sigma_rad * left.fy;
  if (!(horizon < height - 1)) return {};
  const double bf = camera.baseline_m * left.fx;
  const double nearest = options.height_m * left.fy / (height - left.cy);
  constexpr double kWidthPx = 640;  // coarse pixels suffice: there are many; set by hand
  constexpr double kMargin = 1.3;   // on the disparity of the nearest ground; set by hand
  const double scale = std::min(1., kWidthPx / width);
  const DisparityPatch patch =
      MatchInside(grey, {0, horizon, width, height}, kMargin * bf / nearest, scale, scale);
  if (patch.values.empty()) return {};
  std::vector<Sample> samples;
  for (int y = 0; y < patch.values.rows; ++y) {
    for (int x = 0; x < patch.values.cols; ++x) {
      const double disparity = patch.values.at<float>(y, x);
      if (!(disparity > 0)) continue;
      const int u = static_cast<int>(patch.x0 + patch.step_x * x),
                v = static_cast<int>(patch.y0 + patch.step_y * y);
      if (Covers(objects, u, v)) continue;
      samples.push_back(
          {-bf * Vec3((u - left.cx) / left.fx, (v - left.cy) / left.fy, 1), disparity, u, v});
    }
  }
  const std::size_t every = 1 + samples.size() / kSamples;
  for (std::size_t i = 0; every * i < samples.size(); ++i) samples[i] = samples[every * i];
  samples.resize((samples.size() + every - 1) / every);
  return samples;
}

/// Whether the plane is within the gate of the prior.
bool IsPlausible(const Vec3& q, const GroundOptions& options) {
  const double height = 1 / q.norm();
  const Vec3 up = q * height;
  return std::abs(height - options.height_m) <= kGate * options.height_sigma_m &&
         std::hypot(up.x(), up.z()) <= kGate * options.tilt_sigma_rad && up.y() < 0;
}

bool IsOn(const Vec3& q, const Sample& sample) {
  return std::abs(sample.row.dot(q) - sample.disparity) < kGate * kDisparitySigma;
}

Vec3 BestOfTrials(const std::vector<Sample>& samples, const Vec3& prior,
                  const GroundOptions& options) {
  std::mt19937 random(kSeed);
  constexpr std::size_t kEvery = 10;  // every tenth sample is counted; set by hand
  const auto support = [&](const Vec3& q) {
    int count = 0;
    for (std::size_t i = 0; i < samples.size(); i += kEvery) count += IsOn(q, samples[i]);
    return count;
  };
  Vec3 best = prior;
  int most = support(prior);
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Matrix3d rows;
    Vec3 disparities;
    for (int i = 0; i < 3; ++i) {
      const Sample& sample = samples[random() % samples.size()];
      rows.row(i) = sample.row;
      disparities[i] = sample.disparity;
    }
    const Vec3 q = rows.partialPivLu().solve(disparities);
    if (!q.allFinite() || !IsPlausible(q, options)) continue;
    const int count = support(q);
    if (count <= most) continue;
    most = count;
    best = q;
  }
  return best;
}

/// Information and right-hand side of the prior. Roll and pitch change `up` by their sine; a change
/// dh of the height changes q by dh / height^2.
struct Equations {
  Eigen::Matrix3d information;
  Vec3 right;
  explicit Equations(const GroundOptions& options) {
    const double tilt = options.tilt_sigma_rad / options.height_m;
    const double stretch = options.height_sigma_m / (options.height_m * options.height_m);
    const Vec3 diagonal = Vec3(tilt, stretch, tilt).array().square().inverse();
    information = diagonal.asDiagonal();
    right = diagonal.cwiseProduct(Vec3(0, -1, 0) / options.height_m);
  }
  void Add(const Vec3& row, double value, double weight) {
    information += weight * row * row.transpose();
    right += weight * value * row;
  }
  Vec3 Solution() const { return information.ldlt().solve(right); }
};

Vec3 LeastSquares(const std::vector<Sample>& samples, Vec3 q, const GroundOptions& options) {
  constexpr int kRounds = 3;  // set by hand
  for (int round = 0; round < kRounds; ++round) {
    Equations equations(options);
    for (const Sample& sample : samples) {
      if (IsOn(q, sample))
        equations.Add(sample.row, sample.disparity, 1 / (kDisparitySigma * kDisparitySigma));
    }
    q = equations.Solution();
  }
  return q;
}

/// Subtracts the mean brightness, which may differ between the cameras. Uses only pixels of the
/// same row, since all pixels of a ground row have one disparity.
cv::Mat Detail(const cv::Mat& grey) {
  // Gaussian against noise, and width of the neighbourhood of the mean. Set by hand. [px]
  constexpr int kKernel = 5, kMeanWidth = 21;
  constexpr double kSigma = 1;
  cv::Mat image, fine, coarse;
  grey.convertTo(image, CV_32F);
  cv::GaussianBlur(image, fine, {kKernel, kKernel}, kSigma);
  cv::blur(image, coarse, {kMeanWidth, 1});
  return fine - coarse;
}

/// A ground pixel in both images: the difference of the grey levels and its derivative by the
/// disparity.
struct Difference {
  Vec3 row;
  double disparity, error, slope;
};

/// Refines the plane on the images by least squares of their difference (Lucas and Kanade 1981,
/// with the three unknowns of a plane), because semi-global matching is biased by a third of a
/// pixel on the ground. Far ground has little texture, but objects on it have much. The weights of
/// Geman and McClure and the square of the disparity keep their edges from tilting the plane; far
/// ground still counts if no near ground has texture.
Vec3 Align(const GreyPair& grey, const std::vector<Sample>& samples, Vec3 q,
           const GroundOptions& options) {
  constexpr double kLeastNoise = 1;    // grey levels are whole numbers
  constexpr int kRounds = 12;          // at most; set by hand
  constexpr double kConverged = 1e-5;  // relative change of the plane; set by hand
  const int top = samples.front().v;   // rows above are not used; samples are sorted by rows
  const cv::Mat left = Detail(grey.left.rowRange(top, grey.left.rows));
  const cv::Mat right = Detail(grey.right.rowRange(top, grey.right.rows));
  std::vector<Sample> ground;
  double nearest = 0;
  for (const Sample& sample : samples) {
    if (!IsOn(q, sample)) continue;
    ground.push_back(sample);
    nearest = std::max(nearest, sample.row.dot(q));
  }
  if (!(nearest > 0)) return q;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Difference> differences;
    std::vector<double> errors;
    for (const Sample& sample : ground) {
      const double disparity = sample.row.dot(q),
                   at = sample.u - disparity - grey.disparity_at_infinity;
      if (!(at >= 1 && at < right.cols - 3)) continue;
      const int x = static_cast<int>(at);
      const float part = static_cast<float>(at - x);
      const float* row = right.ptr<float>(sample.v - top) + x;
      const double there = (1 - part) * row[0] + part * row[1];
      const double slope = 0.5 * ((1 - part) * (row[1] - row[-1]) + part * (row[2] - row[0]));
      // To first order right(u - d) decreases by `slope` per pixel of d.
      const double error = there - left.at<float>(sample.v - top, sample.u);
      differences.push_back({sample.row, disparity, error, slope});
      errors.push_back(std::abs(error));
    }
    if (errors.empty()) break;
    const double noise = std::max(kLeastNoise, Median(std::move(errors)));
    Equations equations(options);
    for (const auto& [row, disparity, error, slope] : differences) {
      const double inlier = noise * noise / (noise * noise + error * error),
                   near = disparity / nearest;
      const double weight = std::pow(near * inlier * slope / noise, 2);
      if (weight > 0) equations.Add(row, disparity + error / slope, weight);
    }
    const Vec3 next = equations.Solution();
    const double change = (next - q).norm() / q.norm();
    q = next;
    if (change < kConverged) break;
  }
  return q;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, GroundOptions& options) {
  visitor.Everyday("far off: objects stand too near or too far")
      .Real("height_m", options.height_m, 0.05, 20, "height of the camera above the ground");
  visitor.Real("height_sigma_m", options.height_sigma_m, 1e-3, 10,
               "standard deviation of the given height of the camera");
  visitor.Real("tilt_sigma_rad", options.tilt_sigma_rad, 1e-4, 0.5,
               "standard deviation of the camera's roll and pitch against the ground");
}

GroundPlane EstimateGround(const GreyPair& grey, const StereoCamera& camera,
                           const std::vector<Box2d>& objects, const GroundOptions& options) {
  constexpr std::size_t kFewest = 100;  // samples; set by hand
  const std::vector<Sample> samples = GroundSamples(grey, camera, objects, options);
  Vec3 q = Vec3(0, -1, 0) / options.height_m;
  GroundPlane plane;
  if (samples.size() >= kFewest) {
    // Most pixels fit a plane that is not the ground, so there is no evidence.
    const Vec3 found = LeastSquares(samples, BestOfTrials(samples, q, options), options);
    if (IsPlausible(found, options)) {
      const Vec3 aligned = Align(grey, samples, found, options);
      q = IsPlausible(aligned, options) ? aligned : found;
      const auto on = [&](const Sample& sample) { return IsOn(q, sample); };
      plane.support = static_cast<double>(std::count_if(samples.begin(), samples.end(), on)) /
                      static_cast<double>(samples.size());
    }
  }
  plane.height_m = 1 / q.norm();
  plane.up = q * plane.height_m;
  return plane;
}

GroundPlane EstimateGround(const StereoView& images, const StereoCamera& camera,
                           const std::vector<Box2d>& objects, const GroundOptions& options) {
  return EstimateGround(GreyOf(images, camera), camera, objects, options);
}

std::optional<double> FindGroundHeight(const StereoView& images, const StereoCamera& camera,
                                       const std::vector<Box2d>& objects,
                                       const GroundOptions& options) {
  const GreyPair grey = GreyOf(images, camera);
  GroundPlane best;
  // Heights to try, relative to the given one, and their standard deviation, so that neighbouring
  // searches overlap. Set by hand.
  constexpr double kFactors[] = {0.25, 0.4, 0.63, 1., 1.6, 2.5, 4.};
  constexpr double kSigmaShare = 0.15;
  for (const double factor : kFactors) {
    GroundOptions there = options;
    there.height_m = factor * options.height_m;
    there.height_sigma_m = kSigmaShare * there.height_m;
    const GroundPlane plane = EstimateGround(grey, camera, objects, there);
    if (plane.support > best.support) best = plane;
  }
  if (best.support < kGroundSupport) return std::nullopt;
  return best.height_m;
}

}  // namespace sslcd
