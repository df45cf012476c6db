// SPDX-License-Identifier: BSD-3-Clause
#include "report_images.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "console.h"
#include "datasets/dataset_images.h"
#include "formats/files.h"
#include "image_loader.h"
#include "report/loop_crops.h"
#include "sslcd/core/error.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd::apps {
namespace {

constexpr double kMargin = .15;              // around a box, of its sides
constexpr int kLongestSidePx = 112;          // of a crop in the page
constexpr int kQuality = 80;                 // of a JPEG file, of 100
constexpr std::size_t kMostBytes = 2 << 20;  // of all crops

const FileRecord* LeftImages(const RunView& run) {
  if (!run.record) return nullptr;
  for (const FileRecord& input : run.record->inputs)
    if (input.role == "left images") return &input;
  return nullptr;
}

bool HasChanged(const FileRecord& images) {
  try {
    const FileRecord now = RecordFile(images.name, false);
    return now.bytes != images.bytes || now.files != images.files;
  } catch (const Error&) {
    return true;
  }
}

// Empty: the box is outside of the image.
std::string CropJpeg(const cv::Mat& image, const Box2d& box) {
  const double dx = kMargin * (box.right - box.left), dy = kMargin * (box.bottom - box.top);
  const double left = std::max(0., box.left - dx), top = std::max(0., box.top - dy);
  const double right = std::min<double>(image.cols, box.right + dx);
  const double bottom = std::min<double>(image.rows, box.bottom + dy);
  if (!(right - left >= 2 && bottom - top >= 2)) return "";
  cv::Mat crop =
      image(cv::Rect(cv::Point(int(left), int(top)), cv::Point(int(right), int(bottom))));
  const double scale = double(kLongestSidePx) / std::max(crop.cols, crop.rows);
  if (scale < 1) cv::resize(crop.clone(), crop, {}, scale, scale, cv::INTER_AREA);
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".jpg", crop, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality})) return "";
  return {bytes.begin(), bytes.end()};
}

using Key = std::pair<int, int>;  // frame and object
using Crops = std::map<Key, std::string>;

Key KeyOf(const Sight& sight) { return {sight.frame, sight.object}; }

Crops CropsOf(const std::vector<SeenPair>& pairs, const std::string& folder, const RunView& run) {
  const ImageFolder images = ListImages(folder);
  const ImageOfFrame image_of(images, run.trajectory.size());
  std::map<int, std::vector<Sight>> by_frame;
  for (const SeenPair& pair : pairs)
    for (const Sight& sight : {pair.query, pair.match}) by_frame[sight.frame].push_back(sight);
  Crops crops;
  for (const auto& [frame, sights] : by_frame) {
    const auto* entry = image_of(frame, run.trajectory.stamps[static_cast<std::size_t>(frame)]);
    const std::string path = images.PathOf(entry);
    const Image image = path.empty() ? Image() : LoadImage(path);
    if (image.pixels.empty()) continue;
    for (const Sight& sight : sights)
      if (crops.count(KeyOf(sight)) == 0)
        crops[KeyOf(sight)] = CropJpeg(MatOf(image.view()), sight.box);
  }
  return crops;
}

}  // namespace

void AddLoopImages(RunView& run) {
  const FileRecord* images = LeftImages(run);
  const std::size_t accepted = AcceptedLoops(run).size();
  if (images == nullptr || accepted == 0) return;
  if (!run.record->camera) {
    run.crops_note = "No image crops: the run had no calibration.";
    return;
  }
  if (HasChanged(*images)) {
    run.crops_note = "No image crops: " + images->name + " is not there, or has changed.";
    return;
  }
  const std::vector<SeenPair> pairs = SeenPairs(run, *run.record->camera);
  const Crops crops = CropsOf(pairs, images->name, run);
  std::set<std::size_t> loops;
  std::set<Key> shown;  // a page holds each image once, however many pairs it is in
  std::size_t bytes = 0;
  for (const SeenPair& pair : pairs) {
    const auto query = crops.find(KeyOf(pair.query)), match = crops.find(KeyOf(pair.match));
    if (query == crops.end() || match == crops.end()) continue;
    if (query->second.empty() || match->second.empty()) continue;
    for (const auto& crop : {query, match})
      if (shown.insert(crop->first).second) bytes += crop->second.size();
    if (bytes > kMostBytes) break;
    run.crops.push_back({pair.loop, pair.pair, query->second, match->second});
    loops.insert(pair.loop);
  }
  if (loops.size() < accepted)
    run.crops_note = "Image crops are shown for " + std::to_string(loops.size()) + " of " +
                     std::to_string(accepted) + " loops.";
}

}  // namespace sslcd::apps
