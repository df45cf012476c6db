// SPDX-License-Identifier: BSD-3-Clause
#include "io/dataset_images.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include "io/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr int kMostFrames = 1'000'000;                                 // by their images: the digits of a name
constexpr int kKittiTrackingWidth = 1242, kKittiTrackingHeight = 375;  // [px]; a few sequences are some pixels off

/// Width and height from a PNG's header; 0 when it is none.
std::array<int, 2> PngSize(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  unsigned char head[24] = {};
  if (!file.read(reinterpret_cast<char*>(head), sizeof(head)) || head[1] != 'P' || head[2] != 'N' || head[3] != 'G')
    return {};
  const auto size_at = [&head](int i) { return head[i] << 24 | head[i + 1] << 16 | head[i + 2] << 8 | head[i + 3]; };
  return {size_at(16), size_at(20)};
}

/// The image of a frame; empty: there is none.
std::string ImageOf(const std::string& folder, int digits, int frame) {
  if (folder.empty()) return "";
  std::string number = std::to_string(frame);
  number.insert(0, std::max<std::size_t>(number.size(), digits) - number.size(), '0');
  for (const char* ending : {".png", ".jpg"})
    if (IsFile(folder + "/" + number + ending)) return folder + "/" + number + ending;
  return "";
}

}  // namespace

int FramesOfImages(const std::string& folder) {
  int count = 0;
  for (const char* ending : {".png", ".jpg"}) {
    const std::vector<NumberedFile> images = NumberedFiles(folder, ending);
    if (images.empty()) continue;
    const auto& [number, path] = images.back();
    if (number >= kMostFrames)
      throw Error(ErrorKind::kBadInput, {path}, "is no frame's number; they count from 000000");
    count = std::max(count, number + 1);
  }
  return count;
}

void AddImages(const DatasetLayout& layout, const SequenceInfo& info, Dataset& dataset) {
  std::array<int, 2> size = {info.image_width, info.image_height};
  if (layout.format == DatasetFormat::kKittiTracking) size = {kKittiTrackingWidth, kKittiTrackingHeight};
  for (Frame& frame : dataset.frames) {
    frame.image_left = ImageOf(layout.images, layout.image_digits, frame.index);
    frame.image_right = ImageOf(layout.images_right, layout.image_digits, frame.index);
    if (frame.index > 0 || frame.image_left.empty()) continue;
    if (const auto in_file = PngSize(frame.image_left); in_file[0] > 0) size = in_file;
  }
  if (layout.odometry.empty()) {  // a stamp is no frame
    const auto last = std::find_if(dataset.frames.rbegin(), dataset.frames.rend(),
                                   [](const Frame& f) { return !f.image_left.empty() || !f.image_right.empty(); });
    const auto frames = static_cast<std::size_t>(dataset.frames.rend() - last);
    if (frames > 0 && frames < dataset.frames.size()) {
      dataset.warnings.push_back(layout.times + ": " + std::to_string(dataset.frames.size()) +
                                 " stamps, but images of " + std::to_string(frames) +
                                 " frames only; the others are left out");
      dataset.frames.resize(frames);
    }
  }
  for (std::optional<Camera>* camera : {&dataset.camera, &dataset.camera_right}) {
    if (*camera && (*camera)->width == 0) (*camera)->width = size[0], (*camera)->height = size[1];
  }
}

}  // namespace sslcd
