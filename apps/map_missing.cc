// SPDX-License-Identifier: BSD-3-Clause
// In place of map_run.cc and command_map.cc where sslcd was built without SQLite.
#include "map_run.h"
#include "sslcd/core/error.h"

namespace sslcd::apps {
namespace {

[[noreturn]] void FailWithoutStore() {
  throw Error(ErrorKind::kUsage,
              "this sslcd_run was built without SQLite, which maps in files need: install "
              "libsqlite3-dev (3.37 or newer) and build it again");
}

}  // namespace

void UseOptionsOfMap(const MapArguments& map, const ConfigArguments&, Configuration&) {
  if (map.given()) FailWithoutStore();
}

RunResult RunInMap(const MapArguments&, const MapDrive&, const MapperContext&, const Options&,
                   const RunHooks&) {
  FailWithoutStore();
}

std::string MapLine(const MapArguments&) { FailWithoutStore(); }

namespace {

Command AddWithoutStore(CLI::App& app, const char* name) {
  app.add_subcommand(name, "maps in files (not in this build)")->allow_extras();
  return [] {
    FailWithoutStore();
    return 0;
  };
}

}  // namespace

Command AddMapCommand(CLI::App& app, Console&) { return AddWithoutStore(app, "map"); }
Command AddRelocaliseCommand(CLI::App& app, Console&) { return AddWithoutStore(app, "relocalise"); }
Command AddSitesCommand(CLI::App& app, Console&) { return AddWithoutStore(app, "sites"); }

}  // namespace sslcd::apps
