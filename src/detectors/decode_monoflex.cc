// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "detectors/decode_3d.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// The C x H x W map of one image.
struct Maps {
  explicit Maps(const Tensor& tensor)
      : values(tensor.values.data()),
        rows(static_cast<int>(tensor.shape[2])),
        columns(static_cast<int>(tensor.shape[3])) {}
  double operator()(int channel, int y, int x) const {
    return values[(static_cast<std::size_t>(channel) * rows + y) * columns + x];
  }
  const float* values;
  int rows, columns;
};

/// Whether the value is not lower than its eight neighbours.
bool IsPeak(const Maps& heat, int channel, int y, int x) {
  const double value = heat(channel, y, x);
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, heat.rows - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, heat.columns - 1); ++u)
      if (heat(channel, v, u) > value) return false;
  return true;
}

/// 2 channels: sin, cos. 8 channels: two bins around -pi/2 and pi/2, each [no, yes, sin, cos] (as
/// RTM3D). 16 channels: four bins around 0, pi/2, pi and -pi/2, first [no, yes] of each, then [sin,
/// cos] of each (as MonoFlex). Takes the most probable bin.
double Alpha(const Maps& rotation, int channels, int y, int x) {
  struct Bin {
    double centre;
    int yes, sin;  // channels
  };
  if (channels == 2) return std::atan2(rotation(0, y, x), rotation(1, y, x));
  static constexpr std::array<Bin, 2> kTwo = {{{-M_PI / 2, 1, 2}, {M_PI / 2, 5, 6}}};
  static constexpr std::array<Bin, 4> kFour = {
      {{0, 1, 8}, {M_PI / 2, 3, 10}, {M_PI, 5, 12}, {-M_PI / 2, 7, 14}}};
  const Bin* bins = channels == 8 ? kTwo.data() : kFour.data();
  const auto sureness = [&](const Bin& bin) {
    return rotation(bin.yes, y, x) - rotation(bin.yes - 1, y, x);
  };
  const Bin& best = *std::max_element(bins, bins + channels / 4, [&](const Bin& a, const Bin& b) {
    return sureness(a) < sureness(b);
  });
  return best.centre + std::atan2(rotation(best.sin, y, x), rotation(best.sin + 1, y, x));
}

void CheckMaps(const std::vector<Tensor>& outputs) {
  for (const Tensor& map : outputs)
    if (map.shape[2] != outputs[0].shape[2] || map.shape[3] != outputs[0].shape[3])
      throw Error(ErrorKind::kBadInput, "monoflex: one map is " + ToString(map.shape) +
                                            ", the heat map " + ToString(outputs[0].shape) +
                                            ": they need the same height and width");
  const std::int64_t channels = outputs[4].shape[1];
  if (channels != 2 && channels != 8 && channels != 16)
    throw Error(ErrorKind::kBadInput, "monoflex: the rotation map is " +
                                          ToString(outputs[4].shape) +
                                          ", the layout expects 1x2x?x?, 1x8x?x? or 1x16x?x?");
}

}  // namespace

std::vector<ClassCuboid> DecodeMonoFlex(const std::vector<Tensor>& outputs,
                                        const ModelOutput& output, int width) {
  CheckMaps(outputs);
  const Maps heat(outputs[0]), offset(outputs[1]), depth(outputs[2]), size(outputs[3]),
      rotation(outputs[4]);
  const int rotations = static_cast<int>(outputs[4].shape[1]);
  const double cell_px = static_cast<double>(width) / heat.columns;
  std::vector<ClassCuboid> cuboids;
  for (const auto& [number, label] : output.labels) {
    for (int y = 0; y < heat.rows; ++y) {
      for (int x = 0; x < heat.columns; ++x) {
        const double score = heat(number, y, x);
        if (!(score >= output.min_score) || !IsPeak(heat, number, y, x)) continue;
        ClassCuboid cuboid;
        cuboid.found.class_number = number;
        cuboid.found.score = score;
        cuboid.centre_x = (x + offset(0, y, x)) * cell_px;
        cuboid.centre_y = (y + offset(1, y, x)) * cell_px;
        cuboid.depth_m = depth(0, y, x);
        cuboid.dims = {size(2, y, x), size(0, y, x), size(1, y, x)};  // stored as w, h, l
        cuboid.alpha_rad = Alpha(rotation, rotations, y, x);
        cuboids.push_back(cuboid);
      }
    }
  }
  return cuboids;
}

}  // namespace sslcd
