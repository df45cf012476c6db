// SPDX-License-Identifier: BSD-3-Clause
// The bundle adjustment that follows a loop closure: a round course driven twice, 500 keyframes,
// 200 objects, each seen in both laps, 10 sightings per keyframe. It starts with errors of some
// centimetres per keyframe, like after a pose graph.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include "bundle/object_ba.h"

namespace sslcd {
namespace {

BaProblem TwoLaps(int keyframes, int objects, int sightings_per_keyframe) {
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  BaProblem problem;
  const double step_m = 2, turn = 4 * M_PI / keyframes, radius = step_m / turn;
  for (int i = 0; i < keyframes; ++i)
    problem.cameras.push_back({i, Pose::RotY(turn * i) * Pose::Trans(-radius, 0, 0)});
  for (int k = 0; k < objects; ++k) {
    const double bearing = 2 * M_PI * k / objects, r = radius + (k % 2 ? 6. : -6.);
    problem.objects.push_back(
        {k,
         k % 4 ? Symmetry::kNone : Symmetry::kFull,
         {Vec3(-r * std::cos(bearing), 0.5, r * std::sin(bearing)), bearing}});
  }
  for (int i = 0; i < keyframes; ++i) {
    const Pose T_cam_world = problem.cameras[i].T_world_cam.inverse();
    if (i > 0) {
      Pose step = problem.cameras[i - 1].T_world_cam.inverse() * problem.cameras[i].T_world_cam;
      step = step * Pose::Exp(1e-3 * Vec6::NullaryExpr([&] { return gauss(random); }));
      problem.odometry.push_back({i - 1, i, step});
    }
    std::vector<std::pair<double, int>> ahead;
    for (int k = 0; k < objects; ++k) {
      const Vec3 seen = T_cam_world * problem.objects[k].pose.position;
      if (seen.z() > 2) ahead.push_back({seen.norm(), k});
    }
    std::sort(ahead.begin(), ahead.end());
    ahead.resize(std::min<std::size_t>(ahead.size(), sightings_per_keyframe));
    for (const auto& [range, k] : ahead) {
      Pose seen = T_cam_world * ToPose(problem.objects[k].pose, problem.gravity);
      const DetectionSigmas sigmas = SigmasAt(range, problem.noise, problem.noise_scale);
      const Vec3 error(sigmas.radial * gauss(random), sigmas.lateral * gauss(random),
                       sigmas.vertical * gauss(random));
      seen.translation() += RayFrame(seen.translation()).transpose() * error;
      seen.so3() = seen.so3() * lie::SO3<double>::RotZ(sigmas.yaw * gauss(random));
      problem.sightings.push_back({i, k, seen});
    }
  }
  return problem;
}

void AfterALoopClosure(benchmark::State& state) {
  BaProblem solved = TwoLaps(500, 200, 10);
  SolveBa(solved, {});
  std::mt19937 random(2);
  std::normal_distribution<double> gauss;
  std::vector<double> times_ms;
  int iterations = 0;
  for (auto _ : state) {
    BaProblem problem = solved;
    for (std::size_t i = 1; i < problem.cameras.size(); ++i) {
      Vec6 off = 1e-3 * Vec6::NullaryExpr([&] { return gauss(random); });
      off.head<3>() *= 30;
      problem.cameras[i].T_world_cam = problem.cameras[i].T_world_cam * Pose::Exp(off);
    }
    const auto start = std::chrono::steady_clock::now();
    const BaSummary summary = SolveBa(problem, {});
    const double elapsed_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    state.SetIterationTime(elapsed_s);
    times_ms.push_back(1e3 * elapsed_s);
    iterations += summary.iterations;
    if (!summary.usable) state.SkipWithError(summary.message.c_str());
  }
  std::sort(times_ms.begin(), times_ms.end());
  state.counters["p50_ms"] = times_ms[times_ms.size() / 2];
  state.counters["p95_ms"] = times_ms[times_ms.size() * 95 / 100];
  state.counters["iterations"] = double(iterations) / times_ms.size();
}
BENCHMARK(AfterALoopClosure)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(60);

}  // namespace
}  // namespace sslcd

BENCHMARK_MAIN();
