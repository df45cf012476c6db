// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "commands.h"
#include "loop_lines.h"
#include "sslcd/pipeline/run.h"

namespace sslcd::apps {

/// The options of `run` for a map in a file.
struct MapArguments {
  std::string file, session;
  bool resume = false;

  void AddTo(CLI::App& command);
  bool given() const { return !file.empty(); }
};

/// A drive to be added to a map.
struct MapDrive {
  std::string name, folder;
  FrameSource next;
  int total = 0;                 ///< number of frames, for the progress
  std::function<bool()> failed;  ///< the source has ended because of an error
  LoopLines& loops;
};

/// Replaces the mapper's options by those of the map, if it is there, with what the user has set
/// over them. Throws Error(kBadInput) if the file is no map.
void UseOptionsOfMap(const MapArguments& map, const ConfigArguments& config,
                     Configuration& configuration);

/// Adds the drive as a session, or goes on with it. If it is stopped, or its source has failed,
/// what has been done is stored and the session stays open. The result is what the map then has of
/// this session, with the frame numbers of the drive.
RunResult RunInMap(const MapArguments& map, const MapDrive& drive, const MapperContext& context,
                   const Options& options, const RunHooks& hooks);

/// "site.db: session 'monday' with 812 landmarks, 7 loops to earlier sessions".
std::string MapLine(const MapArguments& map);

}  // namespace sslcd::apps
