// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/formats/detections.h"

#include <cmath>

#include "temp_folder.h"

namespace sslcd {
namespace {

/// A car of 4 x 2 x 1.5 m, its bottom at (1, 2, 10), facing away from the camera (rotation_y =
/// -pi/2).
const char kGeometry[] = "1.5 2 4 1 2 10 -1.5707963267948966";
const char kBox[] = "10 20 30 40";
const char kCsvGeometry[] = "1.5,2,4,1,2,10,-1.5707963267948966,0";

std::string Tracking(int frame, const std::string& label, const std::string& score,
                     const std::string& geometry = kGeometry, const std::string& box = kBox) {
  return std::to_string(frame) + " -1 " + label + " -1 -1 -10 " + box + " " + geometry + " " +
         score + "\n";
}
std::string Object(const std::string& label, const std::string& score) {
  return label + " -1 -1 -10 " + kBox + " " + kGeometry + " " + score + "\n";
}
std::string Csv(int frame, int type, const std::string& score) {
  return std::to_string(frame) + "," + std::to_string(type) + ",10,20,30,40," + score + "," +
         kCsvGeometry + "\n";
}

void ExpectCar(const Detection& car) {
  EXPECT_EQ(car.label, "Car");
  EXPECT_EQ(car.dims, Vec3(4, 2, 1.5));
  ASSERT_TRUE(car.box.has_value());
  EXPECT_EQ(car.box->right, 30);
  // Centre half a height above the bottom; nose along the camera's z, roof along -y, left side
  // along -x.
  EXPECT_LT((car.T_cam_object.translation() - Vec3(1, 1.25, 10)).norm(), 1e-12);
  EXPECT_LT((car.T_cam_object.so3() * Vec3(1, 0, 0) - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((car.T_cam_object.so3() * Vec3(0, 1, 0) - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((car.T_cam_object.so3() * Vec3(0, 0, 1) - Vec3(0, -1, 0)).norm(), 1e-12);
}

TEST(DetectionsReader, ReadsEveryLayoutAlike) {
  const TempFolder folder;
  const DetectionFile tracking =
      ReadDetections(folder.Write("tracking.txt", Tracking(3, "Car", "0.9")));
  const DetectionFile csv = ReadDetections(folder.Write("boxes.csv", Csv(3, 2, "0.9")));
  folder.Write("object/000003.txt", Object("Car", "0.9"));
  const DetectionFile object = ReadDetections(folder.path() + "/object");
  EXPECT_EQ(tracking.format, DetectionFormat::kKittiTracking);
  EXPECT_EQ(csv.format, DetectionFormat::kAb3dmotCsv);
  EXPECT_EQ(object.format, DetectionFormat::kKittiObject);
  for (const DetectionFile* file : {&tracking, &csv, &object}) {
    ASSERT_EQ(file->by_frame.size(), 1u);
    ASSERT_EQ(file->by_frame.at(3).size(), 1u);
    ExpectCar(file->by_frame.at(3)[0]);
    EXPECT_EQ(file->by_frame.at(3)[0].score, 0.9);
    EXPECT_EQ(file->by_frame.at(3)[0].row, 0);
    EXPECT_THAT(file->warnings, testing::IsEmpty());
  }
}

TEST(DetectionsReader, RowsCountEveryLineInFrameOrder) {
  const TempFolder folder;
  folder.Write("d/000010.txt", Object("Car", "1"));
  folder.Write("d/000002.txt",
               Object("Car", "1") + "\n" + Object("DontCare", "1") + Object("Van", "1"));
  folder.Write("d/000005.txt", "");
  folder.Write("d/readme.md", "not a label file");
  const DetectionFile file = ReadDetections(folder.path() + "/d");
  EXPECT_EQ(file.rows, 4);
  EXPECT_EQ(file.dont_care, 1);
  ASSERT_EQ(file.by_frame.at(2).size(), 2u);
  EXPECT_EQ(file.by_frame.at(2)[0].row, 0);
  EXPECT_EQ(file.by_frame.at(2)[1].row, 2);
  EXPECT_EQ(file.by_frame.at(10)[0].row, 3);
  EXPECT_EQ(file.by_frame.count(5), 0u);
}

TEST(DetectionsReader, FramesMayComeInAnyOrder) {
  const TempFolder folder;
  const DetectionFile file =
      ReadDetections(folder.Write("a.txt", Csv(7, 2, "1") + Csv(1, 1, "1") + Csv(7, 3, "1")));
  ASSERT_EQ(file.by_frame.begin()->first, 1);
  EXPECT_EQ(file.by_frame.at(1)[0].label, "Pedestrian");
  EXPECT_EQ(file.by_frame.at(1)[0].row, 1);
  EXPECT_EQ(file.by_frame.at(7)[0].row, 0);
  EXPECT_EQ(file.by_frame.at(7)[1].row, 2);
  EXPECT_EQ(file.by_frame.at(7)[1].label, "Cyclist");
}

TEST(DetectionsReader, ScoresAreProbabilitiesOrLogits) {
  const TempFolder folder;
  const auto read = [&](const std::string& text, ScoreKind kind) {
    return ReadDetections(folder.Write("a.txt", text), {kind}).by_frame.at(0);
  };
  const std::string mixed =
      Csv(0, 2, "0.5") + Csv(0, 2, "-2") + Csv(0, 2, "800") + Csv(0, 2, "-800");
  const auto logits = read(mixed, ScoreKind::kAuto);
  EXPECT_NEAR(logits[0].score, 1 / (1 + std::exp(-0.5)), 1e-15);
  EXPECT_NEAR(logits[1].score, 1 / (1 + std::exp(2.)), 1e-15);
  EXPECT_EQ(logits[2].score, 1);
  EXPECT_EQ(logits[3].score, 0);
  EXPECT_EQ(read(Csv(0, 2, "0.5"), ScoreKind::kAuto)[0].score, 0.5);
  EXPECT_EQ(read(Csv(0, 2, "0"), ScoreKind::kLogit)[0].score, 0.5);
  EXPECT_EQ(read(Tracking(0, "Car", ""), ScoreKind::kLogit)[0].score, 1);
  ExpectError([&] { read(mixed, ScoreKind::kProbability); },
              {"a.txt:2: score -2", "outside [0, 1]"});
}

TEST(DetectionsReader, DropsAndCountsUnusableRows) {
  const TempFolder folder;
  const std::string text = Tracking(0, "DontCare", "0.5", "-1 -1 -1 -1000 -1000 -1000 -10") +
                           Tracking(0, "Car", "0.5", "1.5 2 4 nan 2 10 0") +
                           Tracking(0, "Car", "0.5", "1.5 0 4 1 2 10 0") +
                           Tracking(0, "Car", "0.5", "1.5 2 -4 1 2 10 0") +
                           Tracking(0, "Car", "0.5", "1.5 2 inf 1 2 10 0") +
                           Tracking(0, "Car", "nan") + Tracking(0, "Car", "0.5");
  const DetectionFile file = ReadDetections(folder.Write("a.txt", text));
  EXPECT_EQ(file.rows, 7);
  EXPECT_EQ(file.dont_care, 1);
  EXPECT_EQ(file.dropped, 5);
  ASSERT_EQ(file.by_frame.at(0).size(), 1u);
  EXPECT_EQ(file.by_frame.at(0)[0].row, 6);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_THAT(file.warnings[0],
              testing::AllOf(testing::HasSubstr("a.txt:2"), testing::HasSubstr("dropped 5")));
}

TEST(DetectionsReader, BoxWithoutAreaIsNone) {
  const TempFolder folder;
  const DetectionFile file =
      ReadDetections(folder.Write("a.txt", Tracking(0, "Car", "1", kGeometry, "-1.00 -1 -1 -1")));
  EXPECT_FALSE(file.by_frame.at(0)[0].box.has_value());
}

TEST(DetectionsReader, RefusesMalformedRows) {
  const TempFolder folder;
  const std::string good = Csv(0, 2, "1");
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadDetections(folder.Write("a.txt", text)); }, parts);
  };
  refuse(good + good.substr(0, 30) + "\n", {"a.txt:2: found", "15"});
  refuse(good + Csv(0, 2, "1x"), {"a.txt:2: column 7", "'1x'"});
  refuse(good + Tracking(0, "Car", "1"), {"a.txt:2: found 18 columns without commas"});
  refuse(Tracking(0, "Car", "1") + Tracking(0, "Car", ""),
         {"a.txt:2: found 17 columns", "have 18"});
  refuse("1 2 3\n", {"a.txt:1: not a detection row: found 3 columns"});
  refuse("1,2,3\n", {"a.txt:1: not a detection row: found 3 columns with commas"});
  refuse(Csv(-1, 2, "1"), {"a.txt:1: negative frame number -1"});
  refuse("0.5" + good.substr(1), {"a.txt:1: column 1", "whole number"});
  refuse(Csv(0, 4, "1"), {"a.txt:1: class number 4", "1 Pedestrian 2 Car 3 Cyclist"});
  refuse(Tracking(0, "17", "1"), {"a.txt:1: expected a class name in column 3"});
  refuse(Object("Car", "1"), {"a.txt:1: ", "folder of %06d.txt"});
}

TEST(DetectionsReader, RefusesUnusableFolders) {
  const TempFolder folder;
  ExpectError([&] { ReadDetections(folder.path()); }, {"no files named by frame number"});
  folder.Write("a/0000.txt", Csv(0, 2, "1"));
  ExpectError([&] { ReadDetections(folder.path() + "/a"); },
              {"0000.txt:1", "frame numbers of their own"});
  folder.Write("b/000007.txt", Object("Car", "1"));
  folder.Write("b/7.txt", Object("Car", "1"));
  ExpectError([&] { ReadDetections(folder.path() + "/b"); }, {"is the same number as"});
  ExpectError([&] { ReadDetections(folder.path() + "/none"); }, {"No such file"});
}

TEST(DetectionsReader, EmptyFileIsNoDetections) {
  const TempFolder folder;
  const DetectionFile file = ReadDetections(folder.Write("a.txt", "\n\n"));
  EXPECT_EQ(file.format, DetectionFormat::kNone);
  EXPECT_EQ(file.rows, 0);
  EXPECT_TRUE(file.by_frame.empty());
}

TEST(DetectionsReader, OptionsAreDescribed) {
  DetectionReadOptions options;
  struct Visitor : FieldVisitor {
    std::vector<std::string> names;
    void Real(const char*, double&, double, double, const char*) override {}
    void Integer(const char*, int&, int, int, const char*) override {}
    void Flag(const char*, bool&, const char*) override {}
    void Text(const char*, std::string&, const char*) override {}
    void Section(const char*, const char*, const std::function<void(FieldVisitor&)>&) override {}
    void Choice(const char* key, int& value, const std::vector<const char*>& choices,
                const char*) override {
      EXPECT_STREQ(key, "score");
      value = 2;
      names.assign(choices.begin(), choices.end());
    }
  } visitor;
  DescribeFields(visitor, options);
  EXPECT_EQ(options.score, ScoreKind::kLogit);
  EXPECT_THAT(visitor.names, testing::ElementsAre("auto", "probability", "logit"));
}

}  // namespace
}  // namespace sslcd
