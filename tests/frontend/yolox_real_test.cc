// SPDX-License-Identifier: BSD-3-Clause
// YOLOX-nano on 20 real frames (KITTI odometry 02), and its boxes lifted: one car comes towards the
// camera, all others are farther than 45 m.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "../inference/test_models.h"
#include "formats/text_rows.h"
#include "sslcd/detectors/detector_2d.h"
#include "sslcd/frontend/recording.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/perception/opencv_image.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

constexpr int kFrames = 20;
/// The oncoming car, by hand to about 3 px. It is nearer than 25 m from frame 7 on, and leaves the
/// image after frame 13; frame 14 shows its shadow.
const std::map<int, Box2d> kWholeDrive{
    {0, {481, 178, 513, 205}}, {1, {473, 178, 507, 206}},  {2, {466, 178, 504, 207}},
    {3, {457, 180, 498, 210}}, {4, {446, 180, 492, 212}},  {5, {432, 180, 484, 217}},
    {6, {415, 180, 474, 221}}, {7, {392, 181, 462, 228}},  {8, {364, 183, 447, 237}},
    {9, {323, 183, 427, 249}}, {10, {264, 184, 400, 264}}, {11, {169, 184, 359, 289}},
    {12, {2, 186, 302, 327}},  {13, {0, 188, 204, 374}}};
/// Where the other cars are in all frames: one ahead, two waiting in front of it.
const Box2d kElsewhere[] = {{572, 168, 614, 200}, {530, 170, 578, 194}};

bool IsInside(const Box2d& box, const Box2d& place) {
  return box.left >= place.left && box.top >= place.top && box.right <= place.right &&
         box.bottom <= place.bottom;
}

cv::Mat ReadFrame(const std::string& folder, int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "/%06d.png", frame);
  return cv::imread(folder + name);
}

Detector2d LoadYolox(const TempFolder& folder, const std::string& models) {
  std::string text = ReadFileBytes(std::string(SSLCD_MODEL_CONFIGS) + "/yolox.yaml");
  // the decoding is appended to this file
  text.replace(text.find("layout: yolox\n"), 13, "layout: yolo_v5");
  text.replace(text.find("yolox_nano.onnx"), 15, models + "/yolox_nano_384x1248.onnx");
  return Detector2d::Load(folder.Write("yolox.yaml", text));
}

/// The camera as the tools correct it (CheckRig).
StereoCamera CheckedCamera(const std::string& data) {
  DatasetRequest request;
  request.path = data;
  request.odometry_policy = request.detections_policy = PartPolicy::kIgnored;
  Dataset dataset = LoadDataset(request);
  const auto load = [](const std::string& path) {
    const cv::Mat image = cv::imread(path);
    return Image{{image.datastart, image.dataend}, image.cols, image.rows, 3};
  };
  InspectImages({true, false, "", false}, {}, StereoFilesOf(dataset.frames, load), dataset);
  return StereoCameraOf(dataset);
}

TEST(Yolox, FindsEveryCarNearerThan25mInventsNoneAndItsCuboidsMoveSmoothly) {
  SSLCD_RUNTIME();
  SSLCD_REAL_DATA(models, "onnx");
  SSLCD_REAL_DATA(data, "kitti-stereo-color");
  const TempFolder folder;
  const Detector2d detector = LoadYolox(folder, models);
  const StereoCamera camera = CheckedCamera(data);
  std::vector<Vec3> track;  // from frame 4 on
  for (int frame = 0; frame < kFrames; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const cv::Mat left = ReadFrame(data + "/image_2", frame);
    const auto known = kWholeDrive.find(frame);
    std::vector<ImageDetection> oncoming;
    bool ahead = false;
    for (const ImageDetection& found : detector.Detect(ViewOf(left))) {
      if (known != kWholeDrive.end() && Iou(found.box, known->second) >= 0.7) {
        oncoming.push_back(found);
        continue;
      }
      const Box2d& box = found.box;
      ahead = ahead || IsInside(box, kElsewhere[0]);
      EXPECT_TRUE(IsInside(box, kElsewhere[0]) || IsInside(box, kElsewhere[1]))
          << found.label << " " << found.score << " at " << box.left << " " << box.top << " "
          << box.right << " " << box.bottom;
    }
    EXPECT_TRUE(ahead);
    ASSERT_EQ(oncoming.size(), known == kWholeDrive.end() ? 0u : 1u);
    if (frame < 4 || frame > 12) continue;
    const cv::Mat right = ReadFrame(data + "/image_3", frame);
    const auto lifted = LiftBoxes({ViewOf(left), ViewOf(right)}, camera, oncoming, {});
    ASSERT_EQ(lifted[0].status, LiftStatus::kLifted) << ToString(lifted[0].status);
    track.push_back(lifted[0].detection.T_cam_object.translation());
  }
  for (std::size_t i = 1; i + 1 < track.size(); ++i) {
    const double second = (track[i + 1] - 2 * track[i] + track[i - 1]).norm();
    std::printf("frame %zu, %.0f m: second difference %.2f m\n", i + 4, track[i].z(), second);
    EXPECT_LT(second, 0.5);
  }
}

}  // namespace
}  // namespace sslcd
