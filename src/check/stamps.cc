// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "check/stamps.h"
#include "check/static_objects.h"
#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr double kNanoStep = 1e7, kMicroStep = 1e4, kMilliStep = 15;  // of stamps
constexpr double kStill = 0.03, kFastest = 150, kUsual = 60;          // [m/s]
constexpr int kLeastSteps = 15;
constexpr double kMostRatio = 0.6, kFar = 0.6;  // of shares of the scatter

double MedianStep(const Sequence& sequence) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < sequence.stamps.size(); ++i)
    steps.push_back(sequence.stamps[i] - sequence.stamps[i - 1]);
  return Median(std::move(steps));
}

/// The median length of the longer half of the steps.
double MovingStep(const Sequence& sequence) {
  std::vector<double> lengths;
  for (std::size_t i = 1; i < sequence.poses.size(); ++i)
    lengths.push_back(
        (sequence.poses[i].translation() - sequence.poses[i - 1].translation()).norm());
  std::sort(lengths.begin(), lengths.end());
  return lengths[lengths.size() * 3 / 4];
}

void Scale(double factor, std::vector<Pose>& poses) {
  for (Pose& pose : poses) pose = Pose(pose.so3(), factor * pose.translation());
}

double ShareWith(const StaticObjects& objects, std::vector<Pose> poses, double factor) {
  Scale(factor, poses);
  return ScatterOf(objects.pairs, MotionsOf(poses), objects.cap_m).share;
}

Outcome WrongUnit(const std::string& evidence, double factor) {
  return Found("odometry_units", evidence, [factor](Sequence& s) { Scale(factor, s.poses); });
}

}  // namespace

Outcome CheckStampUnits(const Sequence& sequence) {
  if (sequence.frames() < 3) return NotTestable("fewer than 3 frames");
  const double step = MedianStep(sequence), length = MovingStep(sequence);
  const std::string measured = "a frame every " + Figure(step, 3) + " s";
  const bool millis =
      sequence.has_odometry && step >= kMilliStep && length / step < kStill && length > 0.01;
  const double factor = step >= kNanoStep ? 1e-9 : step >= kMicroStep ? 1e-6 : millis ? 1e-3 : 1;
  if (factor == 1) return Ok(measured);
  const std::string unit = factor == 1e-9 ? "ns" : factor == 1e-6 ? "us" : "ms";
  return Found("stamp_units",
               measured + ", " + Figure(length / step, 4) + " m/s; in " + unit + " it would be " +
                   Figure(step * factor, 3) + " s",
               [factor](Sequence& s) {
                 for (double& stamp : s.stamps) stamp *= factor;
                 if (s.groundtruth)
                   for (double& stamp : s.groundtruth->stamps) stamp *= factor;
               });
}

Outcome CheckOdometryUnits(const Sequence& sequence) {
  if (!sequence.has_odometry) return NotTestable("no odometry is given");
  if (sequence.frames() <= kLeastSteps)
    return NotTestable("fewer than " + std::to_string(kLeastSteps) + " steps");
  const double speed = MovingStep(sequence) / MedianStep(sequence);
  std::string measured = "the camera moves by " + Figure(speed) + " m/s";
  if (const auto objects = FindStaticObjects(sequence)) {
    const double given = ShareWith(*objects, sequence.poses, 1);
    for (const double factor : {0.001, 0.01, 100., 1000.}) {
      const double share = ShareWith(*objects, sequence.poses, factor);
      if (share < kFar && share < kMostRatio * given &&
          share < ShareWith(*objects, sequence.poses, 0.6 * factor) &&
          share < ShareWith(*objects, sequence.poses, factor / 0.6))
        return WrongUnit(measured + ", and objects scatter " + Percent(given) + " of " +
                             Metres(objects->cap_m) + "; with the positions times " +
                             Figure(factor, factor < 1 ? 3 : 0) + " " + Percent(share),
                         factor);
    }
  }
  if (!(speed > kFastest)) return Ok(measured);
  return WrongUnit(measured + "; in mm it would be " + Figure(speed * 0.001) + " m/s",
                   speed * 0.01 <= kUsual ? 0.01 : 0.001);
}

}  // namespace sslcd::check
