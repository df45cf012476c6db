// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/adapt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "sslcd/config/config.h"
#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Each value by its key, e.g. "ba.correlation".
std::map<std::string, std::string> ValuesOf(Options options) {
  std::istringstream yaml(
      DumpConfig([&](FieldVisitor& visitor) { DescribeFields(visitor, options); }, false));
  std::map<std::string, std::string> values;
  std::vector<std::string> sections;
  for (std::string line; std::getline(yaml, line);) {
    const std::size_t indent = line.find_first_not_of(' '), colon = line.find(':');
    sections.resize(indent / 2);
    std::string key;
    for (const std::string& section : sections) key += section + ".";
    sections.push_back(line.substr(indent, colon - indent));
    if (colon + 1 < line.size()) values[key + sections.back()] = line.substr(colon + 2);
  }
  return values;
}

/// Keys whose values differ.
std::vector<std::string> Changed(const Options& before, const Options& after) {
  const auto a = ValuesOf(before), b = ValuesOf(after);
  std::vector<std::string> keys;
  for (const auto& [key, value] : a)
    if (b.at(key) != value) keys.push_back(key);
  return keys;
}

TEST(AdaptTo, NothingFromImagesChangesNothing) {
  Options options;
  EXPECT_THAT(AdaptTo({}, options), IsEmpty());
  EXPECT_THAT(Changed(Options(), options), IsEmpty());
}

TEST(AdaptTo, LiftedCuboidsBringTheirNoise) {
  ImageSource source;
  source.lifted_boxes = true;
  Options options;
  EXPECT_THAT(AdaptTo(source, options), ElementsAre("noise", "ba.correlation"));
  EXPECT_EQ(options.noise.yaw_per_m, LiftNoise().yaw_per_m);
  EXPECT_EQ(options.ba.correlation, 4);
  EXPECT_GT(options.ba.odometry.scale_prior, 0) << "the odometry is another sensor's";
}

TEST(AdaptTo, OdometryIsAsGoodAsItsImagesAreRectified) {
  ImageSource source;
  source.stereo_odometry = true;
  for (const std::optional<double> row_error : {std::optional<double>(), {1e-5}, {1e-3}}) {
    source.row_error_rad = row_error;
    Options options;
    EXPECT_THAT(AdaptTo(source, options), ElementsAre("ba.odometry", "loop.odometry"));
    const double walk = StereoOdometryNoise(row_error).rotation_walk;
    EXPECT_EQ(options.ba.odometry.rotation_walk, walk);
    EXPECT_EQ(options.loop.odometry.rotation_walk, walk);
    EXPECT_GT(options.ba.odometry.scale_prior, 0) << "the detections are another sensor's";
  }
}

TEST(AdaptTo, NoScaleIsEstimatedWhereAllComesFromTheSameBaseline) {
  for (const bool lifted : {true, false}) {
    ImageSource source;
    source.stereo_odometry = true;
    source.lifted_boxes = lifted;
    source.has_detections = lifted;  // none: images of different passes are aligned
    Options options;
    AdaptTo(source, options);
    EXPECT_EQ(options.ba.odometry.scale_prior, 0);
    EXPECT_EQ(options.loop.odometry.scale_prior, 0);
  }
}

TEST(AdaptTo, AlignmentRange) {
  ImageSource source;
  source.alignment_range_m = 5.25;
  Options options;
  EXPECT_THAT(AdaptTo(source, options), ElementsAre("loop.views.ahead_m"));
  EXPECT_THAT(Changed(Options(), options), ElementsAre("loop.views.ahead_m"));
  EXPECT_EQ(options.loop.views.ahead_m, 5.25);
}

TEST(AdaptTo, NamesAllThatItChanges) {
  const ImageSource source{true, true, true, 1e-4, 6.};
  Options options;
  const std::vector<std::string> named = AdaptTo(source, options);
  const std::vector<std::string> changed = Changed(Options(), options);
  const auto covers = [](const std::string& key, const std::string& leaf) {
    return leaf == key || leaf.rfind(key + ".", 0) == 0;
  };
  for (const std::string& leaf : changed)
    EXPECT_TRUE(std::any_of(named.begin(), named.end(),
                            [&](const std::string& key) { return covers(key, leaf); }))
        << leaf << " was set and not named";
  for (const std::string& key : named)
    EXPECT_TRUE(std::any_of(changed.begin(), changed.end(),
                            [&](const std::string& leaf) { return covers(key, leaf); }))
        << key << " was named and not set";
}

TEST(AdaptTo, TakesTheHostsModels) {
  ImageModels models;
  models.lifted_correlation = 3;
  models.shared_scale_prior = 0.01;
  Options options;
  AdaptTo({true, true, true, {}, {}}, options, models);
  EXPECT_EQ(options.ba.correlation, 3);
  EXPECT_EQ(options.loop.odometry.scale_prior, 0.01);
}

}  // namespace
}  // namespace sslcd
