// SPDX-License-Identifier: BSD-3-Clause
// A host program with images: two stereo pairs of a textured wall with boxes on it, and models that
// cannot be loaded.
//   consumer_vision MODEL_YAML    an installed description, whose model is not there
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/error.h"
#include "sslcd/detectors/detector_2d.h"
#include "sslcd/frontend/adapt.h"
#include "sslcd/frontend/image_frontend.h"
#include "sslcd/ground/ground_alignment.h"
#include "sslcd/pipeline/mapper.h"

namespace {

constexpr int kWidth = 320, kHeight = 240, kCell = 6;  // [px]

// A wall of squares of random grey, moved to the left by `disparity` pixels.
sslcd::Image Wall(int disparity) {
  sslcd::Image image{std::vector<unsigned char>(kWidth * kHeight), kWidth, kHeight, 1};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      unsigned cell = static_cast<unsigned>((x + disparity) / kCell + 101 * (y / kCell));
      cell = (cell ^ (cell >> 3)) * 2654435761u;
      image.pixels[static_cast<std::size_t>(y * kWidth + x)] =
          static_cast<unsigned char>(cell >> 24);
    }
  }
  return image;
}

bool FramesFromImages() {
  sslcd::ImageSequence sequence;
  sequence.camera.left = {200, 200, kWidth / 2., kHeight / 2., {0, 0, 0}, kWidth, kHeight};
  sequence.camera.baseline_m = 0.5;
  sequence.odometry = true;
  sequence.boxes.emplace();
  for (int i = 0; i < 2; ++i) {
    sslcd::Frame frame;
    frame.index = i;
    frame.image_left = "left";
    frame.image_right = "right";
    sequence.frames.push_back(frame);
    (*sequence.boxes)[i] = {{"Car", 0.9, {100, 80, 180, 160}}, {"Sofa", 0.9, {100, 80, 180, 160}}};
  }
  // 10 m away
  const auto load = [](const std::string& path) { return Wall(path == "left" ? 0 : 10); };
  sslcd::ImageFrontend frontend(std::move(sequence), {}, {}, {load}, /*threads=*/2);
  double moved_m = -1;
  while (const std::optional<sslcd::Frame> frame = frontend.Next())
    moved_m = frame->T_odom_cam.translation().norm();
  const sslcd::FrontendReport report = frontend.Finish();
  for (const auto& [status, count] : report.lift)
    std::printf("%d boxes: %s\n", count, sslcd::ToString(status));
  std::printf("%d frames, %d lost, moved %.4f m\n", report.frames, report.lost, moved_m);
  return report.frames == 2 && report.lost == 0 && moved_m >= 0 && moved_m < 0.01 &&
         report.lift.at(sslcd::LiftStatus::kUnknownLabel) == 2;
}

// True if `load` throws an Error that has `text` in it.
template <typename Load>
bool Refuses(const char* text, const Load& load) {
  try {
    load();
  } catch (const sslcd::Error& error) {
    std::printf("%s\n", error.what());
    return std::string(error.what()).find(text) != std::string::npos;
  }
  return false;
}

// For cuboids from images with poses of VINS-Fusion.
sslcd::Mapper MakeMapper(const sslcd::StereoCamera& camera, double camera_height_m) {
  sslcd::ImageSource source;
  source.lifted_boxes = true;      // the cuboids of Detect()
  source.stereo_odometry = false;  // true: poses of sslcd::StereoOdometry, not of VINS
  source.alignment_range_m =
      sslcd::AlignmentRange(camera.left, camera.left.height, camera_height_m);
  sslcd::Options options = sslcd::DefaultOptions(sslcd::Mode::kRobust);
  sslcd::AdaptTo(source, options);
  sslcd::MapperContext context;
  context.gravity = sslcd::GravityFrame::FromUp({0, 0, 1});
  context.camera = camera.left;
  context.labels.Set("Car", {sslcd::Symmetry::kPi});
  return sslcd::Mapper(options, context);
}

bool MapsAFrame() {
  sslcd::StereoCamera camera;
  camera.left = {200, 200, kWidth / 2., kHeight / 2., {0, 0, 0}, kWidth, kHeight};
  camera.baseline_m = 0.5;
  sslcd::Mapper mapper = MakeMapper(camera, 1.5);
  mapper.AddFrame({});
  return mapper.Objects().empty();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string description = argv[1];
  const bool refuses = Refuses("model", [&] { sslcd::Detector2d::Load(description); }) &&
                       Refuses("missing.yaml", [] { sslcd::Detector2d::Load("missing.yaml"); });
  return refuses && FramesFromImages() && MapsAFrame() ? 0 : 1;
}
