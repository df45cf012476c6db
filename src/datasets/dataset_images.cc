// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/dataset_images.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "datasets/image_size.h"
#include "formats/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

constexpr int kMostMissing = 10'000;  // frames without an image; more are wrong numbers

std::string Text(const ImageSize& size) {
  return std::to_string(size[0]) + "x" + std::to_string(size[1]);
}

/// The most frequent size of the first few images, since one may be broken; 0: no image gives it.
ImageSize SizeOfImages(const std::vector<Frame>& frames) {
  constexpr int kFew = 5;
  std::map<ImageSize, int> votes;
  int asked = 0;
  for (const Frame& frame : frames) {
    if (frame.image_left.empty()) continue;
    const ImageSize size = ReadImageSize(frame.image_left);
    if (size[0] <= 0 || size[1] <= 0) continue;
    ++votes[size];
    if (++asked == kFew) break;
  }
  ImageSize best{};
  for (const auto& [size, count] : votes)
    if (best[0] == 0 || count > votes[best]) best = size;
  return best;
}

}  // namespace

ImageFinder NumberedImages(int digits) {
  return [digits](const std::string& folder, int frame) {
    std::string number = std::to_string(frame);
    number.insert(0, std::max<std::size_t>(number.size(), digits) - number.size(), '0');
    for (const char* ending : {".png", ".jpg"}) {
      const std::string image = IfFile(fs::path(folder) / (number + ending));
      if (!image.empty()) return image;
    }
    return std::string();
  };
}

int FramesOfImages(const std::string& folder) {
  NumberedFile last{-1, ""};
  long long images = 0;
  for (const char* ending : {".png", ".jpg"}) {
    const std::vector<NumberedFile> files = NumberedFiles(folder, ending);
    images += static_cast<long long>(files.size());
    if (!files.empty() && files.back().number > last.number) last = files.back();
  }
  if (last.number + 1LL - images > kMostMissing)
    throw Error(ErrorKind::kBadInput, {last.path},
                "is not a frame number, as the last of " + std::to_string(images) +
                    " images: frames count from 000000");
  return last.number + 1;
}

int ImagesAfter(const DatasetLayout& layout, std::size_t frames) {
  int count = 0;
  if (layout.images.empty()) return 0;
  while (!layout.find_image(layout.images, static_cast<int>(frames) + count).empty()) ++count;
  return count;
}

void AddImages(const DatasetLayout& layout, const SequenceInfo& info, Dataset& dataset) {
  for (Frame& frame : dataset.frames) {
    if (!layout.images.empty()) frame.image_left = layout.find_image(layout.images, frame.index);
    if (!layout.images_right.empty())
      frame.image_right = layout.find_image(layout.images_right, frame.index);
  }
  const ImageSize given = {info.image_width, info.image_height};
  ImageSize size = SizeOfImages(dataset.frames);
  if (given[0] > 0 && size[0] > 0 && given != size)
    throw Error(ErrorKind::kBadInput, {layout.sequence_yaml},
                "image_size_px is " + Text(given) + ", but the images in " + layout.images +
                    " are " + Text(size) + ": remove it if calib.txt belongs to the images");
  if (size[0] == 0) size = given;
  if (size[0] == 0) size = layout.image_size;
  if (layout.odometry.empty()) {  // stamps without an image are not frames
    const auto last = std::find_if(
        dataset.frames.rbegin(), dataset.frames.rend(),
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
    if (!*camera || (*camera)->width != 0) continue;
    (*camera)->width = size[0];
    (*camera)->height = size[1];
  }
}

}  // namespace sslcd
