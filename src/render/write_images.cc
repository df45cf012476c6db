// SPDX-License-Identifier: BSD-3-Clause
#include "render/write_images.h"

#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "core/for_each.h"
#include "formats/atomic_file.h"
#include "sslcd/core/error.h"

namespace sslcd::render {
namespace {

/// Level 1: higher levels hardly reduce photographs, which are mostly noise. Run lengths suit
/// photographs; the default strategy suits the large even areas of depth and identities.
void WritePng(const std::filesystem::path& folder, int frame, const cv::Mat& image) {
  const int strategy =
      image.depth() == CV_8U ? cv::IMWRITE_PNG_STRATEGY_RLE : cv::IMWRITE_PNG_STRATEGY_DEFAULT;
  char name[16];
  std::snprintf(name, sizeof name, "%06d.png", frame);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes,
               {cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_PNG_STRATEGY, strategy});
  WriteFileAtomically((folder / name).string(), std::string(bytes.begin(), bytes.end()),
                      Durability::kUnsynced);
}

cv::Mat DepthImage(const View& view) {
  cv::Mat image(view.height, view.width, CV_16U);
  std::transform(view.depth.begin(), view.depth.end(), image.ptr<std::uint16_t>(), [](float depth) {
    const double units = std::round(depth * kDepthUnitsPerMetre);
    return static_cast<std::uint16_t>(units < 65536 ? units : 0);
  });
  return image;
}

cv::Mat InstanceImage(const View& view) {
  cv::Mat image(view.height, view.width, CV_16U);
  std::transform(view.identity.begin(), view.identity.end(), image.ptr<std::uint16_t>(),
                 [](int identity) { return static_cast<std::uint16_t>(identity + 1); });
  return image;
}

/// Removes images of an earlier run, which show another world.
void RemoveImages(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ours =
        name.size() == 10 && name.find_first_not_of("0123456789") == 6 && name.substr(6) == ".png";
    if (ours) std::filesystem::remove(entry.path());
  }
}

void WriteFrame(const Renderer& renderer, const std::filesystem::path& folder, int frame,
                bool truth) {
  for (const auto& [side, number] : {std::pair(Side::kLeft, "2"), std::pair(Side::kRight, "3")}) {
    View view = renderer.Render(frame, side);
    WritePng(folder / (std::string("image_") + number), frame,
             {view.height, view.width, CV_8UC3, view.bgr.data()});
    if (!truth) continue;
    WritePng(folder / (std::string("depth_") + number), frame, DepthImage(view));
    WritePng(folder / (std::string("instance_") + number), frame, InstanceImage(view));
  }
}

}  // namespace

void WriteImages(const Renderer& renderer, const std::filesystem::path& folder,
                 const ImageOutput& output) {
  if (output.threads < 1)
    throw Error(ErrorKind::kUsage,
                "threads is " + std::to_string(output.threads) + ", must be 1 or more");
  if (output.truth && renderer.objects() > 65535)
    throw Error(ErrorKind::kUsage,
                "instance images have room for 65535 objects, the world has more");
  for (const char* name : {"image_2", "image_3", "depth_2", "depth_3", "instance_2", "instance_3"})
    RemoveImages(folder / name);
  for (const char* name : {"image_2", "image_3"}) MakeWritableFolder((folder / name).string());
  if (output.truth) {
    for (const char* name : {"depth_2", "depth_3", "instance_2", "instance_3"})
      MakeWritableFolder((folder / name).string());
  }
  ForEach(
      static_cast<std::size_t>(renderer.frames()), output.threads,
      [&](std::size_t frame) {
        WriteFrame(renderer, folder, static_cast<int>(frame), output.truth);
      },
      output.progress);
}

}  // namespace sslcd::render
