// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/constellation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sslcd {
namespace {

// Without a clear axis, noise turns it: largest ratio of the variances across and along. Smallest
// standard deviation along, which fixes the yaw. Set by hand.
constexpr float kRoundest = 0.6f;
constexpr float kShortest = 2.f;  // [m]

std::uint32_t Mixed(std::uint32_t label) {  // the finaliser of MurmurHash3
  label = (label + 1) * 0x85EBCA6Bu;
  label = (label ^ label >> 13) * 0xC2B2AE35u;
  return label ^ label >> 16;
}

void Sort(std::array<float, kMembers>& v) {  // the shortest network for five
  const auto order = [&](int i, int j) {
    const float low = std::min(v[i], v[j]);
    v[j] = std::max(v[i], v[j]);
    v[i] = low;
  };
  order(0, 3), order(1, 4), order(0, 2), order(1, 3), order(0, 1), order(2, 4), order(1, 2);
  order(3, 4), order(2, 3);
}

void WithoutMiddle(const std::array<float, kMembers>& all, float* kept) {
  for (int i = 0; i < kMembers; ++i)
    if (i != kMembers / 2) *kept++ = all[i];
}

}  // namespace

std::optional<Constellation> MakeConstellation(const std::array<const SitePoint*, kMembers>& five) {
  Constellation one;
  for (const SitePoint* point : five) {
    one.x += point->x / kMembers;
    one.y += point->y / kMembers;
    one.labels += Mixed(point->label);
  }
  float xx = 0, xy = 0, yy = 0;
  for (const SitePoint* point : five) {
    const float dx = point->x - one.x, dy = point->y - one.y;
    xx += dx * dx / kMembers, xy += dx * dy / kMembers, yy += dy * dy / kMembers;
  }
  // The eigenvalues and the first eigenvector of the covariance.
  const float middle = (xx + yy) / 2, half = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  const float along = middle + half, across = middle - half;
  if (!(along >= kShortest * kShortest) || across > kRoundest * along) return std::nullopt;
  const float cosine_of_double = std::clamp((xx - yy) / (2 * half), -1.f, 1.f);
  one.axis_x = std::sqrt((1 + cosine_of_double) / 2);
  one.axis_y = std::copysign(std::sqrt((1 - cosine_of_double) / 2), xy);
  std::array<float, kMembers> u{}, v{};
  float skew = 0;
  for (int i = 0; i < kMembers; ++i) {
    const float dx = five[i]->x - one.x, dy = five[i]->y - one.y;
    u[i] = one.axis_x * dx + one.axis_y * dy;
    v[i] = one.axis_x * dy - one.axis_y * dx;
    skew += u[i] * u[i] * u[i];
  }
  if (skew < 0) {
    one.axis_x = -one.axis_x, one.axis_y = -one.axis_y;
    for (int i = 0; i < kMembers; ++i) u[i] = -u[i], v[i] = -v[i];
  }
  Sort(u), Sort(v);
  WithoutMiddle(u, one.coordinates.data());
  WithoutMiddle(v, one.coordinates.data() + kCoordinates / 2);
  return one;
}

bool IsFirstToPropose(const std::vector<Neighbours>& near, const std::array<int, kMembers>& five) {
  for (int m = 1; m < kMembers; ++m) {
    const int other = five[m];
    if (other > five[0]) continue;
    bool all = true;
    for (int i = 0; i < kMembers && all; ++i)
      all = five[i] == other ||
            std::find(near[other].begin(), near[other].end(), five[i]) != near[other].end();
    if (all) return false;
  }
  return true;
}

}  // namespace sslcd
