// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/constellation_key.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

// Cells are kCell wide at the centre and grow with sqrt(1 + distance / kGrow): far objects are less
// sure, by heading and by scale of the odometry. kNoise: standard deviation of a coordinate's
// difference between map and drive, in cells. Chosen on generated sites (docs/scale.md). [m]
constexpr float kCell = 1.5f, kGrow = 6.f, kNoise = 0.22f;

using Cells = std::array<int, kCoordinates>;

float InCells(float metres) {
  const float steps = 2 * kGrow / kCell * (std::sqrt(1 + std::abs(metres) / kGrow) - 1);
  return metres < 0 ? -steps : steps;
}

std::uint64_t Hash(const Cells& cells, std::uint32_t labels) {
  std::uint64_t hash = labels * 0x9E3779B97F4A7C15u;
  for (const int cell : cells) {
    hash ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
    hash *= 0xBF58476D1CE4E5B9u;
    hash ^= hash >> 29;
  }
  hash *= 0x94D049BB133111EBu;
  return hash ^ hash >> 32;
}

// Nearly the log odds of a normal distribution's sides; 0 on the boundary.
float CostOfCrossing(float distance) {
  const float sigmas = distance / kNoise;
  return sigmas * (0.8f + 0.5f * sigmas);
}

}  // namespace

ConstellationKey KeyOf(const Constellation& one) {
  Cells cells;
  ConstellationKey key;
  for (int i = 0; i < kCoordinates; ++i) {
    const float at = InCells(one.coordinates[i]), floor = std::floor(at);
    cells[i] = static_cast<int>(floor);
    key.inside |= (static_cast<std::uint32_t>((at - floor) * 16) & 15) << 4 * i;
  }
  key.cell = Hash(cells, one.labels);
  return key;
}

SearchedConstellation::SearchedConstellation(const Constellation& one) : one_(one) {
  for (int i = 0; i < kCoordinates; ++i) {
    const float at = InCells(one.coordinates[i]), floor = std::floor(at);
    cell_[i] = static_cast<int>(floor);
    inside_[i] = at - floor;
    for (int offset = 0; offset < 4; ++offset)
      for (int place = 0; place < 16; ++place) {
        const float away = (static_cast<float>(offset - 1) +
                            (static_cast<float>(place) + 0.5f) / 16 - inside_[i]) /
                           kNoise;
        difference_[i][offset][place] =
            static_cast<std::uint8_t>(std::min(kDifferenceSteps * away * away, 255.f));
      }
  }
}

void SearchedConstellation::AppendProbes(float most_cost, std::vector<Probe>& probes) const {
  Cells cell = cell_;
  const auto descend = [&](const auto& self, int i, int offsets, float cost) -> void {
    if (i == kCoordinates) {
      probes.push_back({Hash(cell, one_.labels), static_cast<std::uint16_t>(offsets), cost});
      return;
    }
    self(self, i + 1, offsets | 1 << 2 * i, cost);
    for (const int step : {-1, 1}) {
      const float crossing = cost + CostOfCrossing(step < 0 ? inside_[i] : 1 - inside_[i]);
      if (crossing > most_cost) continue;
      cell[i] += step;
      self(self, i + 1, offsets | (1 + step) << 2 * i, crossing);
      cell[i] -= step;
    }
  };
  descend(descend, 0, 0, 0);
}

}  // namespace sslcd
