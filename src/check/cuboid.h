// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "check/sequence.h"

namespace sslcd::check {

/// The values of a row of the file, from which a Detection is made (docs/formats.md).
struct FileCuboid {
  Vec3 bottom;  ///< x y z
  double h = 0, w = 0, l = 0;
  double rotation_y = 0;  ///< wrapped
};
FileCuboid ReadCuboid(const Detection& detection);
void WriteCuboid(const FileCuboid& cuboid, Row& row);

/// Turn of KITTI's alpha: the bearing of the centre. [rad]
double Bearing(const Detection& detection);

/// Whether the heading of a label means anything: its symmetry is not `full`.
bool HasHeading(const Sequence& sequence, const Row& row);

/// Whether a row's alpha is a value of its own; KITTI writes -10 for "unknown".
bool HasAlphas(const Sequence& sequence);

/// The median IoU of the given 2D boxes and those of the cuboids as `change` makes them. None:
/// fewer than kLeastBoxes rows with a box whose cuboid is in front of the camera.
using CuboidChange = std::function<void(Row&, Camera&)>;
std::optional<double> MedianIou(const Sequence& sequence, const CuboidChange& change = {});
constexpr int kLeastBoxes = 30;

}  // namespace sslcd::check
