// SPDX-License-Identifier: BSD-3-Clause
// A host in real time: a frame every PACE milliseconds goes to an AsyncMapper, and each call may
// take BUDGET milliseconds until the report is taken. The host's thread has one core, the mapper's
// threads another one.
//
//   stream_bench DATA GROUNDTRUTH [PACE [BUDGET [LAPS]]]    (20 ms, 5 ms, 1)
//
// With more laps, the sequence is driven again and again, each lap a new sequence from an unknown
// pose. Prints a CSV row for each lap, and one with the results after the last frame and after a
// last refinement.
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <thread>
#include <vector>

#include "process_usage.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/pipeline/async_mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

using Clock = std::chrono::steady_clock;

struct Plan {
  Dataset data;
  double pace_ms = 20, budget_ms = 5;
  int laps = 1;
};

// Threads that this one starts afterwards have the same core.
void UseCore(int core) {
  if (std::thread::hardware_concurrency() < 2) return;
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(core, &cores);
  pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
}

// What a host keeps of the reports.
struct Book {
  std::map<int, FramePose> poses;
  std::map<int, LoopDecision> loops;
  int dropped = 0, refused = 0;

  void Add(const AsyncReport& report) {
    for (const FramePose& pose : report.changes.poses) poses[pose.frame] = pose;
    for (const LoopClosure& loop : report.changes.loops) loops[loop.id] = loop.decision;
    dropped += report.dropped;
    refused += report.refused;
    if (!report.failure.empty()) throw std::runtime_error(report.failure);
  }
  int Accepted() const {
    return static_cast<int>(std::count_if(loops.begin(), loops.end(), [](const auto& loop) {
      return loop.second == LoopDecision::kAccepted;
    }));
  }
  // Of the first lap. [m]
  double Ate(const Dataset& data) const {
    Trajectory estimate;
    for (const Frame& frame : data.frames) {
      const auto found = poses.find(frame.index);
      if (found == poses.end()) continue;
      estimate.stamps.push_back(frame.stamp);
      estimate.poses.push_back(found->second.T_world_cam);
    }
    const MatchedPoses pairs = MatchByStamp(estimate, *data.groundtruth);
    return ComputeAte(pairs.est, pairs.ref, Alignment::kSe3).error.rmse;
  }
};

void PrintLap(int lap, const std::vector<double>& ms, const Book& book) {
  const std::size_t quarter = ms.size() / 4;
  const auto first = ms.begin(), last = ms.end();
  const auto step = static_cast<std::ptrdiff_t>(quarter);
  std::printf("lap %d,%.2f,%.2f,%.2f,%.2f,%.2f,%d,%d,%.1f,%.1f\n", lap + 1, Quantile(ms, 0.5),
              Quantile(ms, 0.99), Quantile(ms, 1), Quantile({first, first + step}, 0.99),
              Quantile({last - step, last}, 0.99), book.dropped, book.refused, UsedMiB(),
              ResidentMiB());
  std::fflush(stdout);
}

// Hands in the frames of one lap at their time and returns the milliseconds of each call.
std::vector<double> Drive(const Plan& plan, int first_index, AsyncMapper& mapper, Book& book) {
  std::vector<double> ms;
  Clock::time_point next = Clock::now();
  for (Frame frame : plan.data.frames) {
    frame.index += first_index;
    const Clock::time_point start = Clock::now();
    mapper.AddFrame(std::move(frame));
    mapper.WaitFor(plan.budget_ms / 1e3);
    const AsyncReport report = mapper.TakeReport();
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    book.Add(report);
    next += std::chrono::microseconds(static_cast<long>(1e3 * plan.pace_ms));
    std::this_thread::sleep_until(next);
  }
  return ms;
}

void Run(const Plan& plan) {
  MapperContext context;
  context.gravity = GravityFrame::FromUp(plan.data.up_axis);
  context.labels = plan.data.labels;
  context.camera = plan.data.camera;
  UseCore(1);
  AsyncMapper mapper(DefaultOptions(Mode::kRobust), context);
  UseCore(0);
  Book book;
  const double before_mib = UsedMiB();
  std::printf(
      "lap,p50 ms,p99 ms,max ms,first quarter p99 ms,last quarter p99 ms,dropped,refused,"
      "used MiB,resident MiB\n");
  const int count = plan.data.frames.back().index + 1;
  for (int lap = 0; lap < plan.laps; ++lap) {
    if (lap > 0) mapper.StartSequence();
    const std::vector<double> ms = Drive(plan, lap * count, mapper, book);
    mapper.Wait();
    book.Add(mapper.TakeReport());
    PrintLap(lap, ms, book);
  }
  const double grown_kib = 1024 * (UsedMiB() - before_mib);
  const int loops = book.Accepted();
  const double ate_m = book.Ate(plan.data);
  mapper.Refine();
  mapper.Wait();
  book.Add(mapper.TakeReport());
  std::printf(
      "frames,loops,ATE m,loops refined,ATE refined m,KiB per frame,objects\n"
      "%zu,%d,%.3f,%d,%.3f,%.2f,%zu\n",
      plan.laps * plan.data.frames.size(), loops, ate_m, book.Accepted(), book.Ate(plan.data),
      grown_kib / (static_cast<double>(plan.data.frames.size()) * plan.laps),
      mapper.Snapshot().get().Objects().size());
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: stream_bench DATA GROUNDTRUTH [PACE [BUDGET [LAPS]]]\n");
    return 2;
  }
  try {
    sslcd::DatasetRequest request;
    request.path = argv[1];
    request.groundtruth = argv[2];
    sslcd::Plan plan;
    plan.data = sslcd::LoadDataset(request);
    if (argc > 3) plan.pace_ms = std::atof(argv[3]);
    if (argc > 4) plan.budget_ms = std::atof(argv[4]);
    if (argc > 5) plan.laps = std::atoi(argv[5]);
    sslcd::Run(plan);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
