// SPDX-License-Identifier: BSD-3-Clause
// Writes a synthetic sequence folder: HALV-sim, or a street or a parking lot seen by a drifting,
// noisy system.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "option_adder.h"
#include "render/options.h"
#include "render/write_images.h"
#include "sim/calibration.h"
#include "sim/halv.h"
#include "sim/sensor.h"
#include "sim/world.h"
#include "sim/write_sequence.h"
#include "sslcd/core/error.h"

namespace {

using namespace sslcd;

struct Arguments {
  std::string out;
  std::uint64_t seed = 1;
  bool force = false;
  sim::StreetOptions street;
  sim::ParkingLotOptions lot;
  sim::OdometryNoise odometry;
  sim::DetectorNoise detector;
  sim::HalvOptions halv;
  bool render = false;
  render::ImageOutput images;
  render::RenderOptions render_options;
  int seeds = 10;
};

CLI::App* AddWriter(CLI::App& app, const char* name, const char* meaning, Arguments& arguments) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->add_option("--out", arguments.out, "folder to write")->required();
  command->add_option("--seed", arguments.seed, "another seed, another world")
      ->capture_default_str();
  command->add_flag("--force", arguments.force, "write into a folder that is not empty");
  return command;
}

template <class... Tables>
void AddTables(CLI::App* command, Tables&... tables) {
  apps::OptionAdder adder(*command);
  (DescribeFields(adder, tables), ...);
}

void Write(const sim::World& world, const Trajectory& odometry,
           const sim::SimulatedDetections& detections, const Arguments& arguments) {
  sim::WriteSequence(world, odometry, detections, arguments.out, arguments.force);
  std::printf("%s: %zu frames, %zu objects, %zu detections\n", arguments.out.c_str(),
              world.truth.size(), world.objects.size(), detections.identity.size());
}

void WriteSimple(const sim::World& world, const Arguments& arguments) {
  Write(world, sim::SimulateOdometry(world.truth, arguments.odometry, arguments.seed),
        sim::SimulateDetections(world, arguments.detector, arguments.seed), arguments);
}

/// A line that counts frames, on a terminal only.
render::ImageOutput WithProgress(render::ImageOutput images) {
  if (isatty(STDERR_FILENO) == 0) return images;
  images.progress = [](int done, int frames) {
    std::fprintf(stderr, "\r%d of %d frames rendered%s", done, frames, done == frames ? "\n" : "");
  };
  return images;
}

void WriteHalv(const Arguments& arguments) {
  const sim::HalvSequence sequence = sim::MakeHalv(arguments.seed, arguments.halv);
  std::optional<render::Renderer> renderer;  // made before anything is written: it may refuse
  if (arguments.images.threads < 1) throw Error(ErrorKind::kUsage, "--threads must be 1 or more");
  if (arguments.render) renderer.emplace(sequence.scene, arguments.seed, arguments.render_options);
  Write(sequence.scene.world, sequence.odometry, sequence.detections, arguments);
  std::printf(
      "the passes meet at %.0f degrees, the odometry errs %.2f times as much as --wander-scale "
      "etc. say\n",
      sequence.scene.viewpoint_rad * 180 / M_PI, sequence.drift_factor);
  if (sequence.scene.left_out > 0)
    std::printf("%d vehicles of %s left out: in the way, or twice in one place\n",
                sequence.scene.left_out, arguments.halv.scene.layout.c_str());
  if (renderer) render::WriteImages(*renderer, arguments.out, WithProgress(arguments.images));
}

int Calibrate(const Arguments& arguments) {
  bool ok = true;
  const std::vector<sim::CalibrationRow> rows = sim::Calibrate(arguments.seeds, arguments.halv);
  for (const sim::CalibrationRow& row : rows) ok = ok && row.ok();
  std::fputs(sim::ToMarkdown(rows).c_str(), stdout);
  return ok ? 0 : 5;
}

int ExitCode(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage: return 2;
    case ErrorKind::kBadInput: return 3;
    case ErrorKind::kNoSolution: return 5;
    default: return 1;
  }
}

int Run(int argc, char** argv) {
  CLI::App app("Writes a synthetic sequence folder for sslcd_run.", "sslcd_sim");
  app.require_subcommand(1);
  Arguments arguments;
  sim::HalvOptions& halv = arguments.halv;
  CLI::App* halv_command =
      AddWriter(app, "halv", "HALV-sim: four calibrated cases with revisits", arguments);
  AddTables(halv_command, halv.scene, halv.drift, halv.detector, halv.appearance,
            arguments.render_options);
  halv_command
      ->add_option("--visit", halv.visit,
                   "another drive through the world of this seed: the same path and objects, other "
                   "noise")
      ->capture_default_str();
  CLI::Option* render = halv_command->add_flag("--render", arguments.render,
                                               "stereo images too: image_2, image_3; needs Embree");
  halv_command
      ->add_flag("--render-truth", arguments.images.truth, "and images of depth and identity")
      ->needs(render);
  halv_command->add_option("--threads", arguments.images.threads, "that render")
      ->capture_default_str();
  CLI::App* calibrate =
      app.add_subcommand("calibrate", "what HALV-sim should be and what it is, as a table");
  calibrate->add_option("--seeds", arguments.seeds, "how many of each case")->capture_default_str();
  AddTables(calibrate, halv.drift, halv.detector, halv.appearance);
  CLI::App* street = AddWriter(app, "street", "a street with parked and driving cars", arguments);
  AddTables(street, arguments.street, arguments.odometry, arguments.detector);
  CLI::App* lot = AddWriter(app, "lot", "a parking lot, driven round and round", arguments);
  AddTables(lot, arguments.lot, arguments.odometry, arguments.detector);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (calibrate->parsed()) return Calibrate(arguments);
  if (halv_command->parsed()) WriteHalv(arguments);
  if (street->parsed()) WriteSimple(sim::MakeStreet(arguments.seed, arguments.street), arguments);
  if (lot->parsed()) WriteSimple(sim::MakeParkingLot(arguments.seed, arguments.lot), arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "sslcd_sim: %s\n", error.what());
    return ExitCode(error.kind());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sslcd_sim: %s\n", error.what());
    return 1;
  }
}
