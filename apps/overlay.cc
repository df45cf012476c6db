// SPDX-License-Identifier: BSD-3-Clause
#include "overlay.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "console.h"
#include "sslcd/core/error.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd::apps {
namespace {

// Corner k of a cuboid: bit 0 front, bit 1 left, bit 2 top.
void DrawCuboid(cv::Mat& image, const Detection& detection, const Camera& camera, const cv::Scalar& colour) {
  constexpr double kNear = 0.5;  // [m]
  cv::Point corners[8];
  for (int k = 0; k < 8; ++k) {
    const Vec3 half = 0.5 * detection.dims;
    const Vec3 corner((k & 1 ? 1 : -1) * half.x(), (k & 2 ? 1 : -1) * half.y(), (k & 4 ? 1 : -1) * half.z());
    const Vec3 p = detection.T_cam_object * corner + camera.offset;
    if (p.z() < kNear) return;
    corners[k] = {cvRound(camera.fx * p.x() / p.z() + camera.cx), cvRound(camera.fy * p.y() / p.z() + camera.cy)};
  }
  for (int k = 0; k < 8; ++k)
    for (const int bit : {1, 2, 4})
      if (!(k & bit)) cv::line(image, corners[k], corners[k | bit], colour, 1, cv::LINE_AA);
}

}  // namespace

void WriteOverlay(const std::string& path, const Frame& frame, const ImageView& left, const Camera& camera) {
  cv::Mat image;
  if (left.channels == 3)
    image = MatOf(left).clone();
  else
    cv::cvtColor(MatOf(left), image, cv::COLOR_GRAY2BGR);
  const cv::Scalar box_colour(0, 200, 255), cuboid_colour(80, 255, 80);
  for (const Detection& detection : frame.detections) {
    DrawCuboid(image, detection, camera, cuboid_colour);
    if (!detection.box) continue;
    const cv::Point top_left(cvRound(detection.box->left), cvRound(detection.box->top));
    cv::rectangle(image, top_left, {cvRound(detection.box->right), cvRound(detection.box->bottom)}, box_colour);
    cv::putText(image, detection.label + Number(" %.2f", detection.score), top_left + cv::Point(2, -3),
                cv::FONT_HERSHEY_SIMPLEX, 0.4, box_colour, 1, cv::LINE_AA);
  }
  bool written = false;
  try {
    written = cv::imwrite(path, image);
  } catch (const cv::Exception&) {
  }
  if (!written) throw Error(ErrorKind::kOutput, path + ": cannot be written; is the disk full?");
}

}  // namespace sslcd::apps
