// SPDX-License-Identifier: BSD-3-Clause
#include "map_run.h"

namespace sslcd::apps {

void MapArguments::AddTo(CLI::App& command) {
  CLI::Option* map = command.add_option(
      "--map", file, "add the drive to a map in this file, which is made if it is not there");
  command.add_option("--session", session, "name in the map; default: that of the dataset")
      ->needs(map);
  command
      .add_flag("--resume", resume,
                "go on with a session that was interrupted: the same command as before")
      ->needs(map);
}

}  // namespace sslcd::apps
