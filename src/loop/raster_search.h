// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/coarse_poses.h"
#include "loop/map_tiles.h"

namespace sslcd {

/// The result of SearchRasters.
struct RasterPoses {
  /// in no order; `score` is s [nats]
  std::vector<CoarsePose> poses;
  /// every other pose at the searched headings has a lower s, but for neighbours of these [nats]
  float cut_off = 0;
  /// by MapTiles::Tile::number: rows have a common heading with the local objects
  std::vector<bool> searched;

  bool HasSearched(const MapTiles& map, const CoarsePose& pose) const;
};

/// Poses at which the local objects meet most objects of the map, anywhere at the headings of the
/// map's rows (FindHeadings): about the `most` best local maxima of
///   s(x, y, yaw) = sum over the rarest objects k of raster_k(R(yaw) p_k + (x, y))
/// (GainRaster). O(area of the map's tiles). `points` are the local ones with the centre at the
/// origin.
RasterPoses SearchRasters(const std::vector<LayoutPoint>& points, const LayoutIndex& index,
                          std::size_t most);

/// Gain of a match of two objects of a label at the same place, by its frequency in the map:
///   log((1 - w) / share) - log(2 pi rho),  without the -2 log(sigma) of the place. [nats]
float MatchGain(int label, const LayoutIndex& index);

}  // namespace sslcd
