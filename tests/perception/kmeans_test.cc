// SPDX-License-Identifier: BSD-3-Clause
#include "perception/kmeans.h"

#include <gtest/gtest.h>

#include <numeric>
#include <opencv2/core.hpp>
#include <random>

namespace sslcd {
namespace {

/// Gaussian-like blobs of different size and spread, overlapping a little.
Eigen::Matrix3Xf Blobs(int seed, int blobs, int points) {
  std::mt19937 engine(seed);
  const auto uniform = [&engine] { return static_cast<float>(engine()) / 4294967296.f; };
  Eigen::Matrix3Xf centres(3, blobs);
  for (float& value : centres.reshaped()) value = uniform();
  Eigen::Matrix3Xf result(3, points);
  for (int i = 0; i < points; ++i) {
    const int blob = static_cast<int>(uniform() * uniform() * static_cast<float>(blobs));
    for (int axis = 0; axis < 3; ++axis) {
      const float noise = uniform() + uniform() + uniform() + uniform() - 2.f;
      result(axis, i) = centres(axis, blob) + 0.1f * noise;
    }
  }
  return result;
}

double OpenCvCompactness(const Eigen::Matrix3Xf& points, int clusters, int iterations) {
  cv::Mat samples(static_cast<int>(points.cols()), 3, CV_32F);
  for (int i = 0; i < samples.rows; ++i) {
    for (int axis = 0; axis < 3; ++axis) samples.at<float>(i, axis) = points(axis, i);
  }
  cv::Mat labels, centres;
  cv::theRNG().state = 1;
  return cv::kmeans(samples, clusters, labels,
                    cv::TermCriteria(cv::TermCriteria::COUNT, iterations, 0), 1,
                    cv::KMEANS_PP_CENTERS, centres);
}

/// One attempt each; which of the two is better varies from set to set, so the mean over many sets
/// is compared.
TEST(KMeans, IsAsCompactAsOpenCvs) {
  constexpr int kTrials = 40;
  double ours = 0, theirs = 0;
  for (int seed = 0; seed < kTrials; ++seed) {
    const Eigen::Matrix3Xf points = Blobs(seed, 6, 1000);
    ours += KMeans(points, {6, 10, 1}).compactness;
    theirs += OpenCvCompactness(points, 6, 10);
  }
  EXPECT_LE(ours, 1.02 * theirs);
}

TEST(KMeans, FindsSeparateBlobsExactly) {
  Eigen::Matrix3Xf points(3, 6);
  points << 0, 0, 0, 9, 9, 9,  //
      0, 0, 0, 9, 9, 9,        //
      1, 2, 3, 1, 2, 3;
  const KMeansResult result = KMeans(points, {2, 10, 1});
  ASSERT_EQ(result.centres.cols(), 2);
  EXPECT_EQ(result.sizes, (std::vector<int>{3, 3}));
  EXPECT_FLOAT_EQ(result.centres(2, 0), 2);
  EXPECT_FLOAT_EQ(result.centres(2, 1), 2);
  EXPECT_FLOAT_EQ(std::abs(result.centres(0, 0) - result.centres(0, 1)), 9);
  EXPECT_NEAR(result.compactness, 4, 1e-6);
}

TEST(KMeans, SameSeedSameResult) {
  const Eigen::Matrix3Xf points = Blobs(3, 6, 500);
  const KMeansResult a = KMeans(points, {6, 10, 5}), b = KMeans(points, {6, 10, 5});
  EXPECT_EQ(a.centres, b.centres);
  EXPECT_EQ(a.sizes, b.sizes);
}

TEST(KMeans, EveryPointIsCountedOnce) {
  for (int clusters : {1, 2, 7, 50}) {
    const KMeansResult result = KMeans(Blobs(1, 4, 60), {clusters, 10, 1});
    EXPECT_EQ(std::accumulate(result.sizes.begin(), result.sizes.end(), 0), 60);
    EXPECT_EQ(static_cast<Eigen::Index>(result.sizes.size()), result.centres.cols());
    for (int size : result.sizes) EXPECT_GT(size, 0);
  }
}

TEST(KMeans, FewerDifferentPointsThanClusters) {
  EXPECT_EQ(KMeans(Eigen::Matrix3Xf(3, 0), {}).centres.cols(), 0);
  EXPECT_EQ(KMeans(Eigen::Matrix3Xf::Constant(3, 1, 2), {}).centres.cols(), 1);
  EXPECT_EQ(KMeans(Eigen::Matrix3Xf::Constant(3, 100, 2), {}).sizes, std::vector<int>{100});
  EXPECT_EQ(KMeans(Blobs(1, 2, 3), {6, 10, 1}).centres.cols(), 3);
  EXPECT_NEAR(KMeans(Blobs(1, 2, 3), {6, 10, 1}).compactness, 0, 1e-9);
}

}  // namespace
}  // namespace sslcd
