// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "datasets/run_folder.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "formats/text_rows.h"
#include "geo_arguments.h"
#include "overwriting.h"
#include "run_export/run_geojson.h"
#include "run_export/run_glb.h"
#include "run_export/run_kml.h"
#include "run_export/run_ply.h"
#include "sslcd/core/error.h"
#include "written.h"

namespace sslcd::apps {
namespace {

struct ExportArguments {
  std::string run, out;
  GeoArguments geo;
  bool json = false;
};

std::string PlyOf(const RunView& run, const GeoOrigin&) { return RunPly(SceneOf(run)); }
std::string GlbOf(const RunView& run, const GeoOrigin&) { return RunGlb(SceneOf(run)); }
// ReadRun has compared the file with run.json.
std::string GraphOf(const RunView& run, const GeoOrigin&) {
  return ReadFileBytes(run.folder + "/graph.g2o");
}
std::string KmlOf(const RunView& run, const GeoOrigin& origin) {
  return RunKml(SceneOf(run), origin);
}
std::string GeoJsonOf(const RunView& run, const GeoOrigin& origin) {
  return RunGeoJson(SceneOf(run), origin);
}

struct ExportFormat {
  const char* ending;
  bool on_earth;  // has a place for an origin, and needs one
  std::string (*content)(const RunView& run, const GeoOrigin& origin);
};
const ExportFormat kExportFormats[] = {{".ply", false, PlyOf},
                                       {".glb", false, GlbOf},
                                       {".g2o", false, GraphOf},
                                       {".kml", true, KmlOf},
                                       {".geojson", true, GeoJsonOf}};

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
  const std::optional<GeoOrigin> origin = a.geo.Origin();
  if (format.on_earth && !origin)
    throw Error(ErrorKind::kUsage,
                a.out +
                    ": needs the place of the run on the Earth: give --origin LATITUDE,LONGITUDE "
                    "of the first camera, and --heading");
  if (!format.on_earth && origin)
    throw Error(ErrorKind::kUsage, a.out + ": --origin is for .kml and .geojson; leave it out");
  RefuseOverwriting(RunFolderPaths(a.run), {a.out});
  const RunView run = ReadRun(a.run);
  WriteFileAtomically(a.out, format.content(run, origin.value_or(GeoOrigin())));
  console.Say("wrote " + a.out);
  if (a.json)
    PrintWritten({{"run", a.run},
                  {"frames", run.trajectory.size()},
                  {"objects", run.map.objects.size()},
                  {"loops", AcceptedLoops(run).size()}},
                 {a.out});
  return 0;
}

}  // namespace

Command AddExportCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "export",
      "write a finished run for other programs: 3D viewers, pose graph solvers, maps of the Earth");
  const auto a = std::make_shared<ExportArguments>();
  command->add_option("RUN", a->run, "folder written by 'sslcd_run run'")->required();
  command
      ->add_option("--out", a->out,
                   "file to write: .ply (mesh with edges), .glb (3D scene), .g2o (pose graph), "
                   ".kml, .geojson (with --origin)")
      ->required();
  a->geo.AddTo(*command, "for .kml and .geojson");
  command->add_flag("--json", a->json, "print what was written as JSON and nothing else");
  command->footer(
      Examples({"export runs/monday --out monday.ply", "export runs/monday --out monday.glb --json",
                "export runs/monday --out monday.kml --origin 49.01,8.43 --heading 120"}));
  return [a, &console] {
    if (a->json) console.quiet = true;
    console.InstallLog();
    return Export(*a, console);
  };
}

}  // namespace sslcd::apps
