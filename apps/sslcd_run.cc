// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <map>
#include <new>

#include "commands.h"
#include "examples.h"
#include "sslcd/core/error.h"

namespace {

int ExitCode(sslcd::ErrorKind kind) {
  switch (kind) {
    case sslcd::ErrorKind::kUsage: return 2;
    case sslcd::ErrorKind::kBadInput: return 3;
    case sslcd::ErrorKind::kBadConfig: return 4;
    case sslcd::ErrorKind::kNoSolution: return 5;
    case sslcd::ErrorKind::kOutput: return 1;
  }
  return 1;
}

// The exit code. Throws what the command throws.
int RunCommandLine(int argc, char** argv) {
  using namespace sslcd::apps;
  CLI::App app(
      "Object-level mapping for visual SLAM: stereo odometry and 3D detections in, a map of "
      "objects and a better "
      "trajectory out.");
  app.require_subcommand(1);
  app.footer(Examples({"check my_sequence", "run my_sequence --out runs/monday --report",
                       "draw runs/monday --out map.svg", "run --help"}) +
             "\n\nExit codes: 0 ok, 1 a result could not be written, 2 usage, 3 bad input, 4 bad "
             "configuration, "
             "5 no solution, 6 a mistake in the data, 130 and 143 interrupted.");
  Console console;
  const std::map<std::string, Command> commands = {
      {"run", AddRunCommand(app, console)},
      {"detect", AddDetectCommand(app, console)},
      {"check", AddCheckCommand(app, console)},
      {"eval", AddEvalCommand(app, console)},
      {"draw", AddDrawCommand(app, console)},
      {"export", AddExportCommand(app, console)},
      {"report", AddReportCommand(app, console)},
      {"compare", AddCompareCommand(app, console)},
      {"model", AddModelCommand(app, console)},
      {"match", AddMatchCommand(app, console)},
      {"graph", AddGraphCommand(app, console)},
      {"map", AddMapCommand(app, console)},
      {"relocalise", AddRelocaliseCommand(app, console)},
      {"sites", AddSitesCommand(app, console)},
      {"bench", AddBenchCommand(app, console)},
      {"check-config", AddCheckConfigCommand(app, console)},
      {"dump-config", AddDumpConfigCommand(app, console)},
      {"version", AddVersionCommand(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  int code = commands.at(app.get_subcommands().front()->get_name())();
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    std::fprintf(stderr, "error: the results could not be printed: is the output's disk full?\n");
    if (code == 0) code = 1;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using sslcd::apps::Printable;
  try {
    return RunCommandLine(argc, argv);
  } catch (const sslcd::Error& error) {
    std::fprintf(stderr, "error: %s\n", Printable(error.what()).c_str());
    return ExitCode(error.kind());
  } catch (const std::bad_alloc&) {  // whose handler needs no memory
    std::fputs("error: not enough memory; end other programs, or use fewer frames or threads\n",
               stderr);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", Printable(error.what()).c_str());
    return 1;
  }
}
