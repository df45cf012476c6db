// SPDX-License-Identifier: BSD-3-Clause
#include "check/synchronisation.h"

#include <algorithm>
#include <cmath>

#include "check/object_turns.h"
#include "check/pose_conventions.h"

namespace sslcd::check {
namespace {

constexpr int kMostShift = 10;
constexpr double kCapMetres = 3;  // to tell objects apart
constexpr std::size_t kLeastTurns = 100;
constexpr double kCap = 0.2, kLargest = 0.15;  // [rad]
constexpr double kForward = 0.9;               // as in pose_conventions.cc
constexpr double kFewer = 0.95, kSigmas = 4;   // of the difference, to shift
constexpr double kUnlike = 0.35, kSurely = 0.5, kLeastTurning = 0.005;

/// Each frame gets the pose of `shift` frames later; frames without one lose their detections.
void ShiftPoses(int shift, Sequence& s) {
  const std::vector<Pose> poses = s.poses;
  const auto last = s.frames() - 1;
  for (int i = 0; i <= last; ++i)
    s.poses[static_cast<std::size_t>(i)] =
        poses[static_cast<std::size_t>(std::clamp(i + shift, 0, last))];
  s.rows.erase(std::remove_if(s.rows.begin(), s.rows.end(),
                              [&](const Row& row) {
                                return row.frame + shift < 0 || row.frame + shift > last;
                              }),
               s.rows.end());
}

double Difference(const Sequence& s, const ObjectTurn& turn, int shift) {
  return std::min(kCap, std::abs(turn.turn_rad - OdometryTurn(s.poses, turn.frame + shift)));
}

/// Mean difference of the turns, now and with the odometry of `shift` frames later, and by how many
/// standard errors it is less then. [rad]
struct Shift {
  int frames = 0;
  double before = 0, after = 0, sigmas = 0;
};
Shift Compare(const Sequence& s, const std::vector<ObjectTurn>& turns, int shift) {
  Shift result{shift, 0, 0, 0};
  double squares = 0, count = 0;
  for (const ObjectTurn& turn : turns) {
    if (turn.frame + shift < 1 || turn.frame + shift >= s.frames()) continue;
    const double before = Difference(s, turn, 0), after = Difference(s, turn, shift);
    result.before += before;
    result.after += after;
    squares += (before - after) * (before - after);
    count += 1;
  }
  if (count < static_cast<double>(kLeastTurns)) return {shift, 0, 1, 0};
  result.before /= count;
  result.after /= count;
  const double gain = result.before - result.after,
               variance = std::max(1e-12, squares / count - gain * gain);
  result.sigmas = gain / std::sqrt(variance / count);
  return result;
}

/// The slope of the objects' turns over the odometry's: 1, or 0 for another drive.
struct Slope {
  double slope = 0, sigma = 1, turning = 0;  ///< turning: root mean square of the odometry's [rad]
};
Slope FitSlope(const Sequence& s, const std::vector<ObjectTurn>& turns) {
  double oo = 0, ob = 0, bb = 0, count = 0;
  for (const ObjectTurn& turn : turns) {
    const double odometry = OdometryTurn(s.poses, turn.frame),
                 objects = std::clamp(turn.turn_rad, -kCap, kCap);
    if (std::abs(odometry) > kLargest) continue;
    oo += odometry * odometry;
    ob += odometry * objects;
    bb += objects * objects;
    count += 1;
  }
  if (!(oo > 0) || count < static_cast<double>(kLeastTurns)) return {};
  const double residual = std::max(0., bb - ob * ob / oo) / count;
  return {ob / oo, std::sqrt(residual / oo), std::sqrt(oo / count)};
}

}  // namespace

Outcome CheckSynchronisation(const Sequence& sequence) {
  if (!sequence.has_odometry) return NotTestable("no odometry is given");
  if (ForwardShare(sequence, {}).value_or(0) < kForward)
    return NotTestable("the camera does not look along its path");
  const std::vector<ObjectTurn> turns = TurnsOfObjects(sequence, kCapMetres);
  if (turns.size() < kLeastTurns)
    return NotTestable("fewer than " + std::to_string(kLeastTurns) +
                       " steps in which two objects are seen again");
  Shift best{0, 0, 1, 0};
  for (int shift = -kMostShift; shift <= kMostShift; ++shift) {
    const Shift one = Compare(sequence, turns, shift);
    if (shift != 0 && one.after < best.after) best = one;
  }
  const Slope slope = FitSlope(sequence, turns);
  const std::string measured =
      "objects turn " + Figure(slope.slope) + " times as much as the odometry";
  const int n = best.frames;
  if (best.after < kFewer * best.before && best.sigmas > kSigmas)
    return Found("shifted_stamps",
                 "objects and odometry differ by " + Figure(1000 * best.before, 1) +
                     " mrad a step; with the odometry of " + std::to_string(std::abs(n)) +
                     " frame(s) " + (n > 0 ? "later" : "earlier") + " by " +
                     Figure(1000 * best.after, 1),
                 [n](Sequence& s) { ShiftPoses(n, s); });
  if (slope.turning < kLeastTurning) return NotTestable("the odometry hardly turns");
  if (slope.slope < kUnlike && slope.slope + 3 * slope.sigma < kSurely)
    return Found("other_odometry", measured + ": it is of another drive",
                 [](Sequence& s) { s.has_odometry = false; });
  return Ok(measured);
}

}  // namespace sslcd::check
