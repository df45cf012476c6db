// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/perception/filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

Detection Car(int row) {
  Detection car;
  car.row = row;
  car.label = "Car";
  car.score = 0.9;
  car.T_cam_object = Pose::Trans(1, 1, 20);
  car.dims = Vec3(4, 1.7, 1.5);
  return car;
}

TEST(FilterDetections, AnObjectLongerThanTheLargestIsDropped) {
  DetectionFilterOptions options;
  for (const double largest_m : {3.9, 4.1}) {
    options.max_size_m = largest_m;
    std::vector<Detection> detections = {Car(0)};
    EXPECT_EQ(FilterDetections(detections, options).kept, largest_m > 4) << largest_m;
  }
}

TEST(FilterDetections, CountsEachReasonAndKeepsTheOrder) {
  std::vector<Detection> detections;
  for (int row = 0; row < 14; ++row) detections.push_back(Car(row));
  detections[1].score = 0.49;
  detections[2].T_cam_object.translation().z() = 71;
  detections[3].dims.x() = 31;
  detections[4].dims.y() = 0.05;
  detections[5].dims.z() = std::nan("");
  detections[6].T_cam_object.translation().x() = std::numeric_limits<double>::infinity();
  detections[7].score = std::nan("");
  detections[9].score = 7;  // a logit
  detections[10].appearance[Cue::kEmbedding] = {1, std::nanf("")};
  detections[11].score = -0.1;
  detections[12].T_cam_object.data()[0] = -4.5e104;  // a quaternion of this length
  detections[13].T_cam_object.data()[3] = 0;

  const FilterReport report = FilterDetections(detections, {});

  EXPECT_EQ(report.kept, 2);
  EXPECT_EQ(report.low_score, 1);
  EXPECT_EQ(report.too_far, 1);
  EXPECT_EQ(report.wrong_size, 2);
  EXPECT_EQ(report.invalid, 8);
  EXPECT_EQ(report.kept + report.dropped(), 14);
  ASSERT_EQ(detections.size(), 2u);
  EXPECT_EQ(detections[0].row, 0);
  EXPECT_EQ(detections[1].row, 8);
}

TEST(FilterDetections, LimitsAreInclusive) {
  std::vector<Detection> detections = {Car(0)};
  detections[0].score = 0.5;
  detections[0].T_cam_object = Pose::Trans(0, 0, 70);
  detections[0].dims = Vec3(30, 0.1, 30);
  EXPECT_EQ(FilterDetections(detections, {}).kept, 1);
}

TEST(FilterDetections, CountsOnlyTheFirstReason) {
  std::vector<Detection> detections = {Car(0)};
  detections[0].score = 0;
  detections[0].dims = Vec3(100, 100, 100);
  const FilterReport report = FilterDetections(detections, {});
  EXPECT_EQ(report.low_score, 1);
  EXPECT_EQ(report.dropped(), 1);
}

TEST(FilterDetections, OfTooManyTheBestAreKeptInTheirOrder) {
  DetectionFilterOptions options;
  options.max_count = 3;
  std::vector<Detection> detections;
  for (int row = 0; row < 6; ++row) detections.push_back(Car(row));
  detections[1].score = 0.95;
  detections[4].score = 0.4;  // counts as a low score, not as one too many
  detections[5].score = 0.99;
  const FilterReport report = FilterDetections(detections, options);
  EXPECT_EQ(report.kept, 3);
  EXPECT_EQ(report.too_many, 2);
  EXPECT_EQ(report.low_score, 1);
  std::vector<int> rows;
  for (const Detection& detection : detections) rows.push_back(detection.row);
  EXPECT_THAT(rows, testing::ElementsAre(0, 1, 5));
}

TEST(FilterDetections, NothingInNothingOut) {
  std::vector<Detection> detections;
  const FilterReport report = FilterDetections(detections, {});
  EXPECT_EQ(report.kept + report.dropped(), 0);
}

TEST(FilterReport, Adds) {
  FilterReport sum;
  sum += FilterReport{1, 2, 3, 4, 5, 6};
  sum += FilterReport{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(sum.kept, 2);
  EXPECT_EQ(sum.dropped(), 40);
}

}  // namespace
}  // namespace sslcd
