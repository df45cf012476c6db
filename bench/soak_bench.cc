// SPDX-License-Identifier: BSD-3-Clause
// Runs for long: real sequences through the streaming interface, one after another, round after
// round. All rounds have the same frames, so time and memory must not grow from round to round, and
// the results must be the same bytes.
//
//   soak_bench ROUNDS SHARED DATA...
//
// SHARED 0: each sequence has a mapper of its own, which ends with it. What is still in memory
// between two sequences belongs to no map. SHARED 1: the sequences of a round share a mapper, as
// with Mapper::StartSequence, and memory is that with the map, at the end of the round. Prints a
// CSV row for each round: CPU times of AddFrame in ms, memory in MiB, and whether poses and loops
// are those of the first round.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <vector>

#include "process_usage.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

struct Round {
  std::vector<double> ms;       // of each call
  std::vector<double> results;  // the last pose of each sequence, and the number of its loops
  double used_mib = 0;          // largest after a sequence
  std::size_t landmarks = 0;    // of the last mapper
};

void Note(const Mapper& mapper, Round& round) {
  const Pose T_world_cam = mapper.CameraTrajectory().poses.back();
  round.results.insert(round.results.end(), T_world_cam.data(),
                       T_world_cam.data() + Pose::kParameters);
  round.results.push_back(mapper.SummariseLoopSearch().accepted);
  round.landmarks = mapper.Objects().size();
}

Round Drive(const std::vector<Dataset>& sequences, bool shared) {
  Round round;
  std::unique_ptr<Mapper> mapper;
  int first_index = 0;
  for (const Dataset& data : sequences) {
    MapperContext context;
    context.gravity = GravityFrame::FromUp(data.up_axis);
    context.labels = data.labels;
    context.camera = data.camera;
    if (!mapper)
      mapper = std::make_unique<Mapper>(DefaultOptions(Mode::kRobust), context);
    else
      mapper->StartSequence();
    for (Frame frame : data.frames) {
      frame.index += first_index;
      const double start = CpuMs();
      mapper->AddFrame(frame);
      round.ms.push_back(CpuMs() - start);
    }
    first_index += data.frames.back().index + 1;
    Note(*mapper, round);
    if (!shared) mapper.reset();
    round.used_mib = std::max(round.used_mib, UsedMiB());
  }
  return round;
}

void Run(int rounds, bool shared, const std::vector<Dataset>& sequences) {
  std::vector<double> first;
  std::size_t frames = 0;
  const double before_mib = UsedMiB();
  std::printf("round,frames,p50 ms,p99 ms,max ms,used MiB,resident MiB,landmarks,same results\n");
  for (int i = 0; i < rounds; ++i) {
    const Round round = Drive(sequences, shared);
    if (i == 0) first = round.results;
    frames += round.ms.size();
    std::printf("%d,%zu,%.3f,%.3f,%.1f,%.3f,%.1f,%zu,%s\n", i + 1, frames, Quantile(round.ms, 0.5),
                Quantile(round.ms, 0.99), Quantile(round.ms, 1), round.used_mib - before_mib,
                ResidentMiB(), round.landmarks, round.results == first ? "yes" : "no");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: soak_bench ROUNDS SHARED DATA...\n");
    return 2;
  }
  try {
    std::vector<sslcd::Dataset> sequences;
    for (int i = 3; i < argc; ++i) {
      sslcd::DatasetRequest request;
      request.path = argv[i];
      sequences.push_back(sslcd::LoadDataset(request));
    }
    sslcd::Run(std::atoi(argv[1]), std::atoi(argv[2]) != 0, sequences);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
