// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>

#include "commands.h"
#include "datasets/run_folder.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "formats/text_rows.h"
#include "overwriting.h"
#include "run_export/run_glb.h"
#include "run_export/run_ply.h"
#include "sslcd/core/error.h"

namespace sslcd::apps {
namespace {

struct ExportArguments {
  std::string run, out;
};

std::string PlyOf(const RunView& run) { return RunPly(SceneOf(run)); }

std::string GlbOf(const RunView& run) { return RunGlb(SceneOf(run)); }

// ReadRun has compared the file with run.json.
std::string GraphOf(const RunView& run) { return ReadFileBytes(run.folder + "/graph.g2o"); }

struct ExportFormat {
  const char* ending;
  std::string (*text)(const RunView& run);
};
const ExportFormat kExportFormats[] = {{".ply", PlyOf}, {".glb", GlbOf}, {".g2o", GraphOf}};

const ExportFormat& FormatOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  std::string endings;
  for (const ExportFormat& format : kExportFormats) {
    if (ending == format.ending) return format;
    endings += (endings.empty() ? "" : ", ") + std::string(format.ending);
  }
  throw Error(ErrorKind::kUsage, path + ": the ending chooses the format: " + endings);
}

int Export(const ExportArguments& a, const Console& console) {
  const ExportFormat& format = FormatOf(a.out);
  RefuseOverwriting(RunFolderPaths(a.run), {a.out});
  WriteFileAtomically(a.out, format.text(ReadRun(a.run)));
  console.Say("wrote " + a.out);
  return 0;
}

}  // namespace

Command AddExportCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "export", "write a finished run for other programs: 3D viewers, pose graph solvers");
  const auto a = std::make_shared<ExportArguments>();
  command->add_option("RUN", a->run, "folder written by 'sslcd_run run'")->required();
  command
      ->add_option("--out", a->out,
                   "file to write: .ply (mesh with edges), .glb (3D scene), .g2o (pose graph)")
      ->required();
  command->footer(
      Examples({"export runs/monday --out monday.ply", "export runs/monday --out monday.glb"}));
  return [a, &console] {
    console.InstallLog();
    return Export(*a, console);
  };
}

}  // namespace sslcd::apps
