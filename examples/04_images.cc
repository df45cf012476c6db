// SPDX-License-Identifier: BSD-3-Clause
// Stereo images in, odometry and a map of cars out. The images are painted: four cars on a road.
#include <sslcd/frontend/adapt.h>
#include <sslcd/lifting/lift.h>
#include <sslcd/pipeline/mapper.h>
#include <sslcd/visual_odometry/odometry.h>
#include <cmath>
#include <cstdio>

constexpr double kCars[][2] = {{-3, 14}, {3.2, 18}, {-3.1, 26}, {3, 31}};  // x, z of their rears

// What a camera at (x, 0, z), 1.65 m above the road, sees, in squares of random grey.
sslcd::Image Paint(double x, double z) {
  sslcd::Image image{{}, 640, 240, 1};
  for (int pixel = 0; pixel < 640 * 240; ++pixel) {
    const double right = (pixel % 640 - 320) / 350., down = (pixel / 640 - 120) / 350.;
    double depth = std::min(60 - z, down > 0 ? 1.65 / down : 60);
    for (const auto& [car_x, car_z] : kCars)
      if (std::abs(x + right * (car_z - z) - car_x) < 0.9 && down * (car_z - z) > 0.15)
        depth = std::min(depth, car_z - z);
    unsigned grey = 0;
    for (const double m : {x + right * depth, down * depth, z + depth})
      grey = (grey + static_cast<unsigned>(std::lround(m / 0.15))) * 2654435761u + (grey >> 15);
    image.pixels.push_back(static_cast<unsigned char>(grey >> 24));
  }
  return image;
}

int main() {
  const sslcd::StereoCamera camera{{350, 350, 320, 120, {0, 0, 0}, 640, 240}, 0.5};
  // snippet: images
  sslcd::ImageSource source;
  source.lifted_boxes = source.stereo_odometry = true;  // neither is a host's
  sslcd::Options options;
  sslcd::AdaptTo(source, options);
  sslcd::MapperContext context{{}, {}, camera.left};  // up is the camera's -y
  context.labels.Set("Car", {sslcd::Symmetry::kPi});  // lifting does not tell front from back
  sslcd::Mapper mapper(options, context);
  sslcd::StereoOdometry odometry(camera, {});

  for (sslcd::Frame frame; frame.index < 20; ++frame.index) {
    frame.stamp = 0.1 * frame.index;
    const double z = 3 * frame.stamp;  // 3 m/s
    const sslcd::Image left = Paint(0, z), right = Paint(camera.baseline_m, z);
    std::vector<sslcd::ImageDetection> boxes;  // of your detector
    for (const auto& [x, car_z] : kCars) {
      const auto u = [&](double at) { return 320 + 350 * at / (car_z - z); };
      boxes.push_back({"Car", 0.9, {u(x - 0.9), u(0.15) - 200, u(x + 0.9), u(1.65) - 200}});
    }
    // snippet: frame
    const sslcd::StereoView images{left.view(), right.view()};
    frame.T_odom_cam = odometry.AddFrame(images).T_odom_cam;
    frame.detections.clear();
    for (const sslcd::LiftedBox& box : sslcd::LiftBoxes(images, camera, boxes, {}))
      if (box.status == sslcd::LiftStatus::kLifted) frame.detections.push_back(box.detection);
    mapper.AddFrame(frame);
  }
  const double moved = mapper.CameraTrajectory().poses.back().translation().z();
  std::printf("%zu cars, moved %.2f m\n", mapper.Objects().size(), moved);
}
