// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "png_drawing.h"
#include "report/draw_run.h"
#include "sslcd/core/error.h"
#include "written.h"

namespace sslcd::apps {
namespace {

struct DrawArguments {
  std::string run, out = "map.svg", groundtruth;
  DrawOptions options;
  bool json = false;
};

int LoopsDrawn(const RunView& run, const DrawOptions& options) {
  if (options.loop) return 1;
  const int loops = static_cast<int>(AcceptedLoops(run).size());
  return std::min(loops, options.max_loops.value_or(loops));
}

int Draw(const DrawArguments& a, const Console& console) {
  const std::string extension = std::filesystem::path(a.out).extension();
  if (extension != ".svg" && extension != ".png")
    throw Error(ErrorKind::kUsage, a.out + ": the name of a picture ends with .svg or .png");
  const RunView run = ReadRun(a.run, a.groundtruth);
  const Drawing drawing = DrawRun(run, a.options);
  WriteFileAtomically(a.out, extension == ".svg" ? SvgText(drawing) : PngBytes(drawing));
  console.Say("wrote " + a.out);
  if (a.json)
    PrintWritten({{"run", a.run},
                  {"frames", run.trajectory.size()},
                  {"objects", run.map.objects.size()},
                  {"loops", LoopsDrawn(run, a.options)}},
                 {a.out});
  return 0;
}

}  // namespace

Command AddDrawCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "draw", "draw a finished run from above: map, loops, trajectory before and after");
  const auto a = std::make_shared<DrawArguments>();
  command->add_option("RUN", a->run, "folder written by 'sslcd_run run'")->required();
  command->add_option("--out", a->out, "picture to write, .svg or .png")->capture_default_str();
  command->add_option("--groundtruth", a->groundtruth,
                      "true poses; default: those that the run was compared with");
  command->add_option("--size", a->options.width, "width of the picture [px]")
      ->check(CLI::Range(200, 8000))
      ->capture_default_str();
  CLI::Option* loops =
      command
          ->add_option("--loops", a->options.max_loops, "draw at most so many loops; default all")
          ->check(CLI::NonNegativeNumber);
  CLI::Option* loop = command->add_option(
      "--loop", a->options.loop,
      "draw one loop with both cameras and its matched objects: that of this query frame");
  CLI::Option* both =
      command->add_flag("--before-after", a->options.before_after,
                        "two maps: the loops on the odometry, and on the corrected trajectory");
  loop->excludes(loops)->excludes(both);
  command->add_flag("--json", a->json, "print what was drawn as JSON and nothing else");
  command->footer(
      Examples({"draw runs/monday --out map.svg", "draw runs/monday --out map.png --before-after",
                "draw runs/monday --loop 380 --out loop.svg --json"}));
  return [a, &console] {
    if (a->json) console.quiet = true;
    console.InstallLog();
    return Draw(*a, console);
  };
}

}  // namespace sslcd::apps
