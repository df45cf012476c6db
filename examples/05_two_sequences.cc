// SPDX-License-Identifier: BSD-3-Clause
// The odometry restarts halfway: its stamps begin at 0 again, its poses at the origin. Loops join
// both sequences in one map.
//   05_two_sequences SEQUENCE    a folder as in docs/formats.md, e.g. tests/data/sim_rectangle
#include <sslcd/sslcd.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sslcd::DatasetRequest request;
  request.path = argv[1];
  const sslcd::Dataset data = sslcd::LoadDataset(request);
  const auto gravity = sslcd::GravityFrame::FromUp(data.up_axis);
  sslcd::Mapper mapper(sslcd::Options(), {gravity, data.labels, data.camera});

  const sslcd::Frame first = data.frames.at(data.frames.size() / 2);  // of the second sequence
  const int restart = first.index;
  for (sslcd::Frame frame : data.frames) {
    if (frame.index >= restart) {
      frame.stamp -= first.stamp;
      frame.T_odom_cam = first.T_odom_cam.inverse() * frame.T_odom_cam;
    }
    // snippet: sequences
    if (frame.index == restart) mapper.StartSequence();  // the number of a frame still increases
    mapper.AddFrame(frame);
  }
  int joining = 0;
  for (const sslcd::LoopClosure& loop : mapper.LoopClosures())
    if (loop.decision == sslcd::LoopDecision::kAccepted)
      joining += loop.match_frame < restart && loop.query_frame >= restart;
  const std::vector<sslcd::Pose> estimate = mapper.CameraTrajectory().poses;
  const auto ate = sslcd::ComputeAte(estimate, data.groundtruth->poses);
  std::printf("%d loops join the sequences; ATE of both %.2f m\n", joining, ate.error.rmse);
}
