// SPDX-License-Identifier: BSD-3-Clause
#include "overlay.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "console.h"
#include "formats/atomic_file.h"
#include "formats/files.h"
#include "sslcd/core/error.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd::apps {
namespace {

void DrawLabel(cv::Mat& image, const std::string& text, const cv::Point& at, double scale,
               const cv::Scalar& colour) {
  for (const auto& [ink, width] : {std::pair(cv::Scalar(0, 0, 0), 3), std::pair(colour, 1)})
    cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, ink, width, cv::LINE_AA);
}

// Corner k of a cuboid: bit 0 front, bit 1 left, bit 2 top. A cross marks the front.
void DrawCuboid(cv::Mat& image, const Detection& detection, const Camera& camera,
                const cv::Scalar& colour) {
  constexpr double kNear = 0.5;  // [m]
  cv::Point corners[8];
  for (int k = 0; k < 8; ++k) {
    const Vec3 half = 0.5 * detection.dims;
    const Vec3 corner((k & 1 ? 1 : -1) * half.x(), (k & 2 ? 1 : -1) * half.y(),
                      (k & 4 ? 1 : -1) * half.z());
    const Vec3 p = detection.T_cam_object * corner + camera.offset;
    if (p.z() < kNear) return;
    corners[k] = {cvRound(camera.fx * p.x() / p.z() + camera.cx),
                  cvRound(camera.fy * p.y() / p.z() + camera.cy)};
  }
  for (int k = 0; k < 8; ++k)
    for (const int bit : {1, 2, 4})
      if (!(k & bit)) cv::line(image, corners[k], corners[k | bit], colour, 1, cv::LINE_AA);
  cv::line(image, corners[1], corners[7], colour, 1, cv::LINE_AA);
  cv::line(image, corners[3], corners[5], colour, 1, cv::LINE_AA);
}

std::string NameOf(int frame) {
  std::string number = std::to_string(frame);
  number.insert(0, 6 - std::min<std::size_t>(6, number.size()), '0');
  return number + ".jpg";
}

bool IsName(const std::string& name) {
  const std::size_t digits = name.find_first_not_of("0123456789");
  return digits >= 6 && digits != std::string::npos && name.substr(digits) == ".jpg";
}

}  // namespace

void Overlays::Write(const Frame& frame, const ImageView& left, const Camera& camera) {
  if (written_.empty()) {
    if (std::filesystem::is_symlink(folder_))
      throw Error(ErrorKind::kOutput, folder_.string() +
                                          ": is a link, and files there would be "
                                          "replaced; remove it");
    MakeWritableFolder(folder_.string());
  }
  const std::string path = (folder_ / *written_.insert(NameOf(frame.index)).first).string();
  cv::Mat image;
  if (left.channels == 3)
    image = MatOf(left).clone();
  else
    cv::cvtColor(MatOf(left), image, cv::COLOR_GRAY2BGR);
  const cv::Scalar box_colour(0, 200, 255), cuboid_colour(80, 255, 80);
  for (const Detection& detection : frame.detections) {
    DrawCuboid(image, detection, camera, cuboid_colour);
    if (!detection.box) continue;
    const double distance_m = detection.T_cam_object.translation().norm();
    const cv::Point top_left(cvRound(detection.box->left), cvRound(detection.box->top));
    cv::rectangle(image, top_left, {cvRound(detection.box->right), cvRound(detection.box->bottom)},
                  box_colour);
    DrawLabel(image,
              detection.label + Number(" %.2f", detection.score) + Number(" %.1f m", distance_m),
              top_left + cv::Point(2, -3), 0.4, box_colour);
  }
  DrawLabel(image, "frame " + std::to_string(frame.index), {6, 20}, 0.6, {255, 255, 255});
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes);
  WriteFileAtomically(path, {bytes.begin(), bytes.end()}, Durability::kUnsynced);
}

void Overlays::RemoveOthers() const {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> others;
  for (const std::string& name : FileNames(folder_.string()))
    if (IsName(name) && written_.count(name) == 0 && fs::is_regular_file(folder_ / name, error))
      others.push_back(folder_ / name);
  for (const fs::path& path : others) {
    fs::remove(path, error);
    if (error)
      throw Error(ErrorKind::kOutput, path.string() + ": cannot be removed: " + error.message());
  }
  // fails if other files remain, which is intended
  if (!others.empty()) fs::remove(folder_, error);
}

}  // namespace sslcd::apps
