// SPDX-License-Identifier: BSD-3-Clause
// A host that must not wait: the mapper has a thread of its own, and a bounded queue.
//   06_asynchronous SEQUENCE    a folder as in docs/formats.md, e.g. tests/data/sim_rectangle
#include <sslcd/sslcd.h>

#include <cstdio>
#include <map>
#include <vector>

// What a host keeps of the results, up to date by the changes alone.
struct Results {
  std::map<int, sslcd::Pose> poses;         // by frame
  std::map<int, sslcd::LoopClosure> loops;  // by id, refused ones, too
  int frames = 0;

  // snippet: changes
  // Returns whether the mapper still runs.
  bool Take(sslcd::AsyncMapper& mapper) {
    const sslcd::AsyncReport report = mapper.TakeReport();
    for (const sslcd::FramePose& pose : report.changes.poses) poses[pose.frame] = pose.T_world_cam;
    for (const sslcd::LoopClosure& loop : report.changes.loops) loops[loop.id] = loop;
    frames += report.frames;
    if (report.dropped > 0) std::printf("%d frames dropped: too slow\n", report.dropped);
    if (report.refused > 0) std::printf("%s\n", report.refusal.c_str());
    if (!report.failure.empty()) std::printf("the mapper has ended: %s\n", report.failure.c_str());
    return report.failure.empty();
  }
};

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sslcd::DatasetRequest request;
  request.path = argv[1];
  const sslcd::Dataset data = sslcd::LoadDataset(request);
  const sslcd::MapperContext context{sslcd::GravityFrame::FromUp(data.up_axis), data.labels,
                                     data.camera};
  Results results;
  // a recording is read faster than it is mapped; live, the default of 64 waiting frames is enough
  // snippet: asynchronous
  sslcd::AsyncMapper mapper(sslcd::Options(), context, /*most_waiting=*/1000);
  for (const sslcd::Frame& frame : data.frames) {
    mapper.AddFrame(frame);  // returns at once; false: the queue is full
    if (!results.Take(mapper)) break;
  }
  mapper.Refine();
  mapper.Wait();

  results.Take(mapper);
  std::vector<sslcd::Pose> estimate;
  for (const auto& [frame, T_world_cam] : results.poses) estimate.push_back(T_world_cam);
  int accepted = 0;
  for (const auto& [id, loop] : results.loops)
    accepted += loop.decision == sslcd::LoopDecision::kAccepted;
  std::printf("%d frames, %d loops; ATE %.2f m\n", results.frames, accepted,
              sslcd::ComputeAte(estimate, data.groundtruth->poses).error.rmse);
}
