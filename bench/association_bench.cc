// SPDX-License-Identifier: BSD-3-Clause
// Data association of one frame with a growing number of distant landmarks: the cost must not grow
// with the map.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "map/object_map.h"
#include "sim/sensor.h"
#include "sim/world.h"

namespace sslcd {
namespace {

// Landmarks on a grid of 6 m, at least 1 km away from the camera's view.
void AddBallast(ObjectMap& map, int count) {
  for (int i = 0; i < count; ++i) {
    MapLandmark landmark;
    landmark.label = "Car";
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose.position = Vec3(5000. + 6. * (i % 300), 1, 5000. + 6. * (i / 300));
    landmark.dims = Vec3(4, 1.7, 1.5);
    map.Insert(std::move(landmark));
  }
}

void DataAssociation(benchmark::State& state) {
  sim::StreetOptions street;
  street.frames = 400;
  const sim::World world = sim::MakeStreet(7, street);
  const auto frames = sim::MakeFrames(sim::SimulateOdometry(world.truth, {}, 7),
                                      sim::SimulateDetections(world, {}, 7));
  std::vector<double> times_ms;
  for (auto _ : state) {
    ObjectMap map(world.gravity, world.labels, {}, {}, {});
    AddBallast(map, static_cast<int>(state.range(0)));
    double total_s = 0;
    for (const Frame& frame : frames) {
      const auto start = std::chrono::steady_clock::now();
      map.AddFrame(frame.index, frame.stamp, frame.T_odom_cam, frame.detections, &world.camera);
      const double elapsed_s =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      total_s += elapsed_s;
      times_ms.push_back(1e3 * elapsed_s);
    }
    state.SetIterationTime(total_s);
  }
  std::sort(times_ms.begin(), times_ms.end());
  state.counters["p50_ms"] = times_ms[times_ms.size() / 2];
  state.counters["p95_ms"] = times_ms[times_ms.size() * 95 / 100];
}
BENCHMARK(DataAssociation)
    ->Arg(0)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sslcd

BENCHMARK_MAIN();
