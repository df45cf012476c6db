// SPDX-License-Identifier: BSD-3-Clause
#include "io/dataset_images.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <vector>

#include "io/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr int kMostFrames = 1'000'000;  // by their images: the digits of a name

using Size = std::array<int, 2>;              // width, height [px]
constexpr Size kKittiTracking = {1242, 375};  // a few sequences are some pixels off

std::string Text(const Size& size) { return std::to_string(size[0]) + "x" + std::to_string(size[1]); }

/// From the header of a PNG or JPEG file; 0 when it is none.
Size SizeOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto byte = [&file] { return std::max(file.get(), 0); };
  const auto number = [&](int bytes) {
    unsigned value = 0;
    while (bytes-- > 0) value = value << 8 | static_cast<unsigned>(byte());
    return static_cast<int>(value);
  };
  const int first = number(2);
  if (first == 0x8950) {  // PNG: its first chunk begins with the size
    file.seekg(16);
    const int width = number(4), height = number(4);
    return file ? Size{width, height} : Size{};
  }
  if (first != 0xFFD8) return {};
  while (file) {  // JPEG: segments, of which the one that begins the frame has it
    int marker = byte();
    while (marker == 0xFF) marker = byte();
    const int length = number(2);
    const bool frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame) {
      byte();  // bits
      const int height = number(2), width = number(2);
      return file ? Size{width, height} : Size{};
    }
    if (length < 2) break;
    file.seekg(length - 2, std::ios::cur);
  }
  return {};
}

/// What most of the first few images have, since one of them may be broken; 0: none says.
Size SizeOfImages(const std::vector<Frame>& frames) {
  constexpr int kFew = 5;
  std::map<Size, int> votes;
  int asked = 0;
  for (const Frame& frame : frames) {
    if (frame.image_left.empty()) continue;
    const Size size = SizeOf(frame.image_left);
    if (size[0] <= 0 || size[1] <= 0) continue;
    ++votes[size];
    if (++asked == kFew) break;
  }
  Size best{};
  for (const auto& [size, count] : votes)
    if (best[0] == 0 || count > votes[best]) best = size;
  return best;
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

int ImagesAfter(const DatasetLayout& layout, std::size_t frames) {
  int count = 0;
  while (!ImageOf(layout.images, layout.image_digits, static_cast<int>(frames) + count).empty()) ++count;
  return count;
}

void AddImages(const DatasetLayout& layout, const SequenceInfo& info, Dataset& dataset) {
  for (Frame& frame : dataset.frames) {
    frame.image_left = ImageOf(layout.images, layout.image_digits, frame.index);
    frame.image_right = ImageOf(layout.images_right, layout.image_digits, frame.index);
  }
  const Size given = {info.image_width, info.image_height};
  Size size = SizeOfImages(dataset.frames);
  if (given[0] > 0 && size[0] > 0 && given != size)
    throw Error(ErrorKind::kBadInput, {layout.sequence_yaml},
                "image_size_px is " + Text(given) + ", but the images in " + layout.images + " are " + Text(size) +
                    ": take it out if calib.txt is theirs");
  if (size[0] == 0) size = given;
  if (size[0] == 0 && layout.format == DatasetFormat::kKittiTracking) size = kKittiTracking;
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
