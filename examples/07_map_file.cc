// SPDX-License-Identifier: BSD-3-Clause
// A map in a file, to which the same drive is added a second time. After an interruption the same
// call goes on (sslcd::store).
//   07_map_file SEQUENCE FILE    SEQUENCE as in docs/formats.md, e.g. tests/data/sim_rectangle
#include <sslcd/sslcd.h>
#include <sslcd/store/map_session.h>

#include <cstdio>
#include <string>

// Whether the last session of the map has not been ended.
bool IsInterrupted(const std::string& file) {
  return sslcd::HasMap(file) && !sslcd::MapStore(file).Describe().sessions.back().ended;
}

void AddDrive(const sslcd::Dataset& data, const std::string& name, const std::string& file) {
  const auto gravity = sslcd::GravityFrame::FromUp(data.up_axis);
  const sslcd::MapperContext context{gravity, data.labels, data.camera};
  // snippet: session
  sslcd::MapSession session = IsInterrupted(file)
                                  ? sslcd::MapSession::Resume(file, context)
                                  : sslcd::MapSession::Begin(file, {name}, context, std::nullopt);
  for (const sslcd::Frame& frame : data.frames)
    if (!session.IsStored(frame)) session.AddFrame(frame);  // a batch at a time is stored
  session.Refine();
  session.End();
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  sslcd::DatasetRequest request;
  request.path = argv[1];
  const sslcd::Dataset data = sslcd::LoadDataset(request);
  AddDrive(data, "monday", argv[2]);
  AddDrive(data, "tuesday", argv[2]);

  const sslcd::MapStore store(argv[2]);
  const int tuesday = store.Describe().sessions.back().frame_offset;
  int joining = 0;
  for (const sslcd::LoopClosure& loop : store.Results().loops)
    if (loop.decision == sslcd::LoopDecision::kAccepted)
      joining += loop.match_frame < tuesday && loop.query_frame >= tuesday;
  std::printf("%d frames before tuesday, %d loops join the sessions\n", tuesday, joining);
}
