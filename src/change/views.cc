// SPDX-License-Identifier: BSD-3-Clause
#include "change/views.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "association/spatial_index.h"

namespace sslcd {
namespace {

constexpr double kTail = 0.005;  // share of the detections beyond the limits of the detector
constexpr double kStorey = 1;    // tolerance of heights [m]; set by hand
constexpr int kBearings = 72;    // sectors of bearing

struct Sight {
  Vec3 in_camera;
  double up_m = 0;  // above the camera
  double Bearing() const { return std::atan2(in_camera.x(), in_camera.z()); }
  double Range() const { return in_camera.norm(); }
};

Sight SightOf(const FrameSightings& frame, const Place& place, const GravityFrame& gravity) {
  const Vec3& p = place.T_world_object.translation();
  return {frame.T_world_cam.inverse() * p, (p - frame.T_world_cam.translation()).dot(gravity.up)};
}

// Where a detector sees anything.
class Limits {
 public:
  Limits(const std::vector<FrameSightings>& frames, const std::vector<std::vector<int>>& seen,
         const std::vector<Place>& places, const GravityFrame& gravity)
      : sectors_(kBearings) {
    std::vector<double> ranges, heights;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      for (const int number : seen[f]) {
        const Sight sight = SightOf(frames[f], places[number], gravity);
        if (!std::isfinite(sight.Range() + sight.up_m)) continue;  // NaN cannot be sorted
        ranges.push_back(sight.Range());
        heights.push_back(sight.up_m);
        ++sectors_[SectorOf(sight)];
      }
    }
    least_ = kTail * static_cast<double>(ranges.size()) / kBearings;
    range_m = Quantile(ranges, 1 - kTail);
    low_ = Quantile(heights, kTail) - kStorey;
    high_ = Quantile(heights, 1 - kTail) + kStorey;
  }

  bool Has(const Sight& sight) const {
    return sight.Range() <= range_m && low_ <= sight.up_m && sight.up_m <= high_ &&
           sectors_[SectorOf(sight)] > least_;
  }

  double range_m = 0;

 private:
  static int SectorOf(const Sight& sight) {
    const double turns = sight.Bearing() / (2 * M_PI) + 0.5;
    return turns > 0 ? std::min(static_cast<int>(turns * kBearings), kBearings - 1) : 0;
  }
  static double Quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }

  std::vector<int> sectors_;
  double least_ = 0, low_ = 0, high_ = 0;
};

// The places that each frame has seen, ascending.
std::vector<std::vector<int>> PlacesSeen(const Sightings& sightings,
                                         const std::vector<Place>& places) {
  std::vector<int> place_of(sightings.landmarks().size(), -1);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const int landmark : places[i].landmarks) place_of[landmark] = static_cast<int>(i);
  std::vector<std::vector<int>> seen;
  for (const FrameSightings& frame : sightings.frames()) {
    std::vector<int> numbers;
    for (const int landmark : frame.landmarks)
      if (place_of[landmark] >= 0) numbers.push_back(place_of[landmark]);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    seen.push_back(std::move(numbers));
  }
  return seen;
}

}  // namespace

std::vector<std::vector<Views>> CollectViews(const Sightings& sightings,
                                             const std::vector<Place>& places) {
  const GravityFrame& gravity = sightings.world().gravity;
  std::vector<std::vector<Views>> views(places.size(),
                                        std::vector<Views>(sightings.world().sessions));
  const std::vector<std::vector<int>> seen_in = PlacesSeen(sightings, places);
  const Limits limits(sightings.frames(), seen_in, places, gravity);
  SpatialIndex index;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3& p = places[i].T_world_object.translation();
    index.Put(static_cast<int>(i), p.dot(gravity.forward), p.dot(gravity.left));
  }
  for (std::size_t f = 0; f < sightings.frames().size(); ++f) {
    const FrameSightings& frame = sightings.frames()[f];
    const Vec3& camera = frame.T_world_cam.translation();
    const std::vector<int> near =
        index.FindWithin(camera.dot(gravity.forward), camera.dot(gravity.left), limits.range_m);
    std::vector<int> candidates;
    std::set_union(near.begin(), near.end(), seen_in[f].begin(), seen_in[f].end(),
                   std::back_inserter(candidates));
    const Pose T_cam_world = frame.T_world_cam.inverse();
    std::vector<Silhouette> nearer = frame.passing;
    struct Candidate {
      int place;
      bool seen;
      Sight sight;
      Silhouette silhouette;
    };
    std::vector<Candidate> before;
    for (const int number : candidates) {
      const Place& place = places[number];
      const bool seen = std::binary_search(seen_in[f].begin(), seen_in[f].end(), number);
      if (place.map != frame.map && !seen) continue;
      const Candidate one{number, seen, SightOf(frame, place, gravity),
                          SilhouetteOf(T_cam_world * place.T_world_object, place.dims)};
      if (place.sessions[frame.session].sightings > 0) nearer.push_back(one.silhouette);
      if (seen || limits.Has(one.sight)) before.push_back(one);
    }
    for (const Candidate& one : before)
      views[one.place][frame.session].push_back(
          {frame.stamp, static_cast<float>(one.sight.Range()),
           static_cast<float>(one.sight.Bearing()),
           static_cast<float>(VisibleFraction(one.silhouette, nearer)), one.seen});
  }
  return views;
}

}  // namespace sslcd
