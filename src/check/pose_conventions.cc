// SPDX-License-Identifier: BSD-3-Clause
#include "check/pose_conventions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "check/static_objects.h"

namespace sslcd::check {
namespace {

using Eigen::Matrix3d;

Pose WithAxes(const Matrix3d& R, const Vec3& t) { return Pose(lie::SO3<double>::FromMatrix(R), t); }

/// The 48 signed permutations of three axes: 24 rotations, 24 reflections.
std::vector<Matrix3d> SignedPermutations() {
  std::vector<Matrix3d> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d M = Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) M(i, order[i]) = signs & (1 << i) ? -1 : 1;
      all.push_back(M);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

Matrix3d Rows(const Vec3& x, const Vec3& y, const Vec3& z) {
  Matrix3d M;
  M << x.transpose(), y.transpose(), z.transpose();
  return M;
}

std::string AxesText(const Matrix3d& M) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    int j = 0;
    M.row(i).cwiseAbs().maxCoeff(&j);
    text += (i > 0 ? ", " : "") + std::string(1, "xyz"[i]) + " = " + (M(i, j) < 0 ? "-" : "") +
            std::string(1, "xyz"[j]);
  }
  return text;
}

class Conventions {
 public:
  std::vector<PoseConvention> All() {
    Add("inverse_poses", "inverse poses", [](const Pose& T) { return T.inverse(); });
    // the columns of a row of the file: qw qx qy qz
    Add("quaternion_order", "quaternions read as qw qx qy qz", [](const Pose& T) {
      const auto& q = T.so3().unit_quaternion();
      return Pose(lie::SO3<double>(Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())),
                  T.translation());
    });
    // x forward, y left, z up; x right, y up, z backward: rows are the file's axes in the camera's
    const Matrix3d ros = Rows(Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0));
    const Matrix3d opengl = Vec3(1, -1, -1).asDiagonal();
    AddAxes("ros_axes", "ROS axes (x forward, y left, z up) turned to the camera's", ros);
    AddAxes("opengl_axes", "OpenGL axes (x right, y up, z backward) turned to the camera's",
            opengl);
    Add("rotation_inverse", "inverse rotations",
        [](const Pose& T) { return Pose(T.so3().inverse(), T.translation()); });
    for (const int axis : {0, 2, 1}) {
      Matrix3d mirror = Matrix3d::Identity();
      mirror(axis, axis) = -1;
      AddReflection("mirrored_poses", std::string(1, "xyz"[axis]) + " mirrored", mirror);
    }
    for (const int kept : {0, 2, 1}) {
      Matrix3d swap = Matrix3d::Identity();
      swap.row((kept + 1) % 3).swap(swap.row((kept + 2) % 3));
      AddReflection(
          "swapped_axes",
          std::string(1, "xyz"[(kept + 1) % 3]) + " and " + "xyz"[(kept + 2) % 3] + " swapped",
          swap);
    }
    for (const Matrix3d& M : SignedPermutations()) {
      if (M.isIdentity()) continue;
      AddAxes("other_axes", "other axes (" + AxesText(M) + ")", M);
    }
    return std::move(all_);
  }

 private:
  void Add(std::string id, std::string name, std::function<Pose(const Pose&)> correct) {
    all_.push_back({std::move(id), std::move(name), std::move(correct)});
  }
  /// `M` turns vectors of the camera to the axes that the file uses for camera and world.
  void AddAxes(const std::string& id, const std::string& name, const Matrix3d& M) {
    Add(id, name, [M](const Pose& T) {
      return WithAxes(M.transpose() * T.so3().matrix() * M, M.transpose() * T.translation());
    });
  }
  /// Positions and rotations; positions alone; and columns of positions and quaternions, which
  /// turns rotations around.
  void AddReflection(const std::string& id, const std::string& name, const Matrix3d& M) {
    AddAxes(id, name, M);
    Add(id, name + " (positions only)",
        [M](const Pose& T) { return Pose(T.so3(), M.transpose() * T.translation()); });
    Add(id, name + " (columns of positions and quaternions)", [M](const Pose& T) {
      return WithAxes((M.transpose() * T.so3().matrix() * M).transpose(),
                      M.transpose() * T.translation());
    });
  }

  std::vector<PoseConvention> all_;
};

// Set on the sequences of tests/cli/mistakes_test.py.
constexpr double kLeastGain = 0.04;    // of the scatter's share
constexpr double kBelowStill = 0.1;    // the other convention has to explain the motion
constexpr double kForwardShare = 0.9;  // mean cosine of a camera that looks ahead
constexpr double kTie = 0.02;          // of the share: the convention that comes first is named
constexpr double kUpsideDown = 0.03;
constexpr std::size_t kMostSteps = 400;

double Penalty(const std::vector<Pose>& poses, const PoseConvention& convention) {
  const std::size_t stride = 1 + poses.size() / kMostSteps;
  double up = 0;
  for (std::size_t i = 0; i < poses.size(); i += stride)
    up -= (convention.correct(poses[i]).so3() * Vec3(Vec3::UnitY())).y();
  return up > 0 ? kUpsideDown : 0;
}

struct Candidate {
  const PoseConvention* convention = nullptr;
  Scatter scatter;
  double rank = 2;
};

Candidate BestConvention(const Sequence& sequence, const StaticObjects& objects, double forward) {
  Candidate best;
  for (const PoseConvention& convention : PoseConventions()) {
    // traffic that overtakes looks like a camera that moves backward
    if (forward > kForwardShare &&
        ForwardShare(sequence, convention.correct).value_or(0) < kForwardShare)
      continue;
    Scatter scatter =
        ScatterOf(objects.pairs, MotionsOf(sequence.poses, convention.correct), objects.cap_m);
    const double rank = scatter.share + Penalty(sequence.poses, convention);
    if (best.convention && rank > best.rank - kTie) continue;
    best = {&convention, std::move(scatter), rank};
  }
  return best;
}

}  // namespace

const std::vector<PoseConvention>& PoseConventions() {
  static const std::vector<PoseConvention> all = Conventions().All();
  return all;
}

std::optional<double> ForwardShare(const Sequence& sequence,
                                   const std::function<Pose(const Pose&)>& correct) {
  const std::vector<Pose>& poses = sequence.poses;
  const std::size_t stride = 1 + poses.size() / kMostSteps;
  std::vector<Vec3> steps;
  double longest = 0;
  for (std::size_t i = 1; i < poses.size(); i += stride) {
    if (sequence.steps[i] && sequence.steps[i]->lost) continue;
    const Pose &a = poses[i - 1], &b = poses[i];
    steps.push_back((correct ? correct(a).inverse() * correct(b) : a.inverse() * b).translation());
    longest = std::max(longest, steps.back().norm());
  }
  double sum = 0;
  int count = 0;
  for (const Vec3& step : steps) {
    if (!(step.norm() > 0.1 * longest)) continue;
    sum += step.z() / step.norm();
    ++count;
  }
  if (count < kLeastPairs) return std::nullopt;
  return sum / count;
}

Outcome CheckPoseConvention(const Sequence& sequence) {
  if (!sequence.has_odometry) return NotTestable("no odometry is given");
  const std::optional<StaticObjects> objects = FindStaticObjects(sequence);
  if (!objects)
    return NotTestable("fewer than " + std::to_string(kLeastObjects) +
                       " objects that are seen again while the camera moves");
  const std::optional<double> forward = ForwardShare(sequence, {});
  if (!forward) return NotTestable("the camera does not move");
  const Scatter given = ScatterOf(objects->pairs, MotionsOf(sequence.poses), objects->cap_m);
  const std::string measured = "objects scatter " + Metres(given.median_m) + " within " +
                               std::to_string(objects->lag) + " frames, " + Percent(given.share) +
                               " of the most that counts; " + Percent(*forward) +
                               " of the motion is along the camera's axis";
  const Candidate best = BestConvention(sequence, *objects, *forward);
  const bool better = best.convention && given.share - best.scatter.share > kLeastGain &&
                      best.scatter.share < objects->still.share - kBelowStill &&
                      CompareBlocks(given, best.scatter).Decide();
  if (!better) return Ok(measured);
  const auto correct = best.convention->correct;
  return Found(best.convention->id,
               measured + "; with " + best.convention->name + " they scatter " +
                   Metres(best.scatter.median_m) + ", " + Percent(best.scatter.share),
               [correct](Sequence& s) {
                 for (Pose& pose : s.poses) pose = correct(pose);
                 const Pose T = s.poses.front().inverse();  // the first camera as the world
                 for (Pose& pose : s.poses) pose = T * pose;
                 s.up_axis = Vec3(0, -1, 0);
               });
}

}  // namespace sslcd::check
