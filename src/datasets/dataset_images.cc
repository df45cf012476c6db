// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/dataset_images.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "datasets/image_size.h"
#include "datasets/stamps.h"
#include "formats/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

constexpr double kPairTolerance = 0.005;  // [s] between the stamps of a left and a right image
constexpr int kMostMissing = 10'000;      // frames without an image; more are wrong numbers

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

ImageOfFrame::ImageOfFrame(const ImageFolder& left, std::size_t frames)
    : left_(left),
      in_order_(left.images.size() == frames),
      half_step_(0.5 * MedianStep(left.Keys())) {}

const ImageFolder::Entry* ImageOfFrame::operator()(int frame, double stamp) const {
  if (!left_.by_stamp) return left_.Find(frame, 0);
  return in_order_ ? &left_.images[static_cast<std::size_t>(frame)] : left_.Find(stamp, half_step_);
}

std::vector<double> StampsOfImages(const ImageFolder& left, double frame_step_s) {
  if (left.by_stamp) return left.Keys();
  if (left.images.empty()) return {};
  const ImageFolder::Entry& last = left.images.back();
  const double frames = last.key + 1, images = static_cast<double>(left.images.size());
  if (frames - images > kMostMissing)
    throw Error(ErrorKind::kBadInput, {left.PathOf(&last)},
                "is not a frame number, as the last of " + std::to_string(left.images.size()) +
                    " images: frames count from 000000");
  std::vector<double> stamps;
  for (int i = 0; i < frames; ++i) stamps.push_back(frame_step_s * i);
  return stamps;
}

std::vector<double> StampsOfPoses(const ImageFolder& left, std::size_t poses,
                                  const std::string& odometry) {
  if (left.images.size() != poses)
    throw Error(ErrorKind::kBadInput, {odometry},
                "has " + std::to_string(poses) + " poses without stamps, but " + left.path +
                    " has " + std::to_string(left.images.size()) +
                    " images named by stamps: give one pose per image, or stamps (TUM rows)");
  return left.Keys();
}

int ImagesAfter(const ImageFolder& left, std::size_t frames, double last_stamp) {
  const std::vector<double> keys = left.Keys();
  if (left.by_stamp) {
    const double end = last_stamp + 0.5 * MedianStep(keys);
    return left.images.size() == frames
               ? 0
               : static_cast<int>(keys.end() - std::upper_bound(keys.begin(), keys.end(), end));
  }
  int count = 0;
  while (left.Find(static_cast<double>(frames) + count, 0)) ++count;
  return count;
}

void AddImages(const DatasetLayout& layout, const SequenceImages& images, const SequenceInfo& info,
               std::size_t frames_in_file, Dataset& dataset) {
  const ImageOfFrame image_of(images.left, frames_in_file);
  for (Frame& frame : dataset.frames) {
    const ImageFolder::Entry* left = image_of(frame.index, frame.stamp);
    frame.image_left = images.left.PathOf(left);
    if (images.right.by_stamp == images.left.by_stamp && (left || !images.left.by_stamp))
      frame.image_right =
          images.right.PathOf(images.left.by_stamp ? images.right.Find(left->key, kPairTolerance)
                                                   : images.right.Find(frame.index, 0));
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
