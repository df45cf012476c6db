// SPDX-License-Identifier: BSD-3-Clause
#include "map_merge.h"

#include "progress.h"
#include "sslcd/core/log.h"
#include "sslcd/store/map_store.h"
#include "sslcd/store/merge_maps.h"
#include "store/session_view.h"

namespace sslcd::apps {

void MapMergeArguments::AddTo(CLI::App& command) {
  command.add_option("FROM", from, "maps whose sessions are added; they are only read")->required();
  command.add_option("--out", out, "new file for the merged map; default: MAP itself");
  command.add_flag("--rename", rename,
                   "a session whose name is taken becomes NAME-2; otherwise it is refused");
  command.add_flag("--refine-once", refine_once,
                   "one refinement after the last session instead of one for each: quicker, for "
                   "many maps");
}

int MergeInto(const std::string& file, const MapMergeArguments& a, const Console& console) {
  CatchInterrupt();
  Progress progress(console, "frame");
  MergeRequest request{file, a.from, a.out, a.rename, a.refine_once, {}};
  request.progress = [&](int done, int total) {
    progress.Report(done, total);
    return !Interrupted();
  };
  const MergeReport report = MergeMaps(request);
  console.EndStatus();
  if (report.stopped) return InterruptCode();
  const std::string& merged = a.out.empty() ? file : a.out;
  const MapStore store(merged);
  const MapInfo info = store.Describe();
  const MapResults results = store.Results();
  for (const std::string& session : report.left_out)
    Log(LogLevel::kWarning, session + ": has not been ended, so it is left out");
  for (const MergedSession& added : report.added)
    for (const SessionInfo& session : info.sessions)
      if (session.name == added.name)
        console.Say("added '" + added.name + "' of " + added.map + ", " +
                    std::to_string(added.frames) + " frames, " +
                    std::to_string(LoopsToEarlierSessions(results, session)) +
                    " loops to earlier sessions");
  console.Say(merged + ": " + std::to_string(info.sessions.size()) + " sessions");
  return 0;
}

}  // namespace sslcd::apps
