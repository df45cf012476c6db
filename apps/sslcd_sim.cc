// SPDX-License-Identifier: BSD-3-Clause
// Writes a synthetic sequence folder: a street or a parking lot, seen by a drifting, noisy system.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/error.h"
#include "sslcd/sim/sensor.h"
#include "sslcd/sim/world.h"
#include "sslcd/sim/write_sequence.h"

namespace {

using namespace sslcd;

/// A field table as command-line options: `scale_error` becomes `--scale-error`. Ranges are the library's to check.
class OptionAdder : public FieldVisitor {
 public:
  explicit OptionAdder(CLI::App& app) : app_(app) {}
  void Real(const char* key, double& value, double, double, const char* meaning) override { Add(key, value, meaning); }
  void Integer(const char* key, int& value, int, int, const char* meaning) override { Add(key, value, meaning); }
  void Text(const char* key, std::string& value, const char* meaning) override { Add(key, value, meaning); }
  void Flag(const char* key, bool& value, const char* meaning) override { Add(key, value, meaning); }
  void Choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
  void Section(const char*, const char*, const std::function<void(FieldVisitor&)>&) override {
  }  // too detailed for here

 private:
  template <class T>
  void Add(std::string key, T& value, const char* meaning) {
    std::replace(key.begin(), key.end(), '_', '-');
    app_.add_option("--" + key, value, meaning)->capture_default_str();
  }
  CLI::App& app_;
};

struct Arguments {
  std::string out;
  std::uint64_t seed = 1;
  bool force = false;
  sim::StreetOptions street;
  sim::ParkingLotOptions lot;
  sim::OdometryNoise odometry;
  sim::DetectorNoise detector;
};

template <class WorldOptions>
CLI::App* AddWorld(CLI::App& app, const char* name, const char* meaning, WorldOptions& world, Arguments& arguments) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->add_option("--out", arguments.out, "folder to write")->required();
  command->add_option("--seed", arguments.seed, "another seed, another world")->capture_default_str();
  command->add_flag("--force", arguments.force, "write into a folder that is not empty");
  OptionAdder adder(*command);
  DescribeFields(adder, world);
  DescribeFields(adder, arguments.odometry);
  DescribeFields(adder, arguments.detector);
  return command;
}

void Write(const sim::World& world, const Arguments& arguments) {
  const Trajectory odometry = sim::SimulateOdometry(world.truth, arguments.odometry, arguments.seed);
  const sim::SimulatedDetections detections = sim::SimulateDetections(world, arguments.detector, arguments.seed);
  sim::WriteSequence(world, odometry, detections, arguments.out, arguments.force);
  std::printf("%s: %zu frames, %zu objects, %zu detections\n", arguments.out.c_str(), world.truth.size(),
              world.objects.size(), detections.identity.size());
}

int ExitCode(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage: return 2;
    case ErrorKind::kBadInput: return 3;
    default: return 1;
  }
}

int Run(int argc, char** argv) {
  CLI::App app("Writes a synthetic sequence folder for sslcd_run.", "sslcd_sim");
  app.require_subcommand(1);
  Arguments arguments;
  const CLI::App* street =
      AddWorld(app, "street", "a street with parked and driving cars", arguments.street, arguments);
  AddWorld(app, "lot", "a parking lot, driven round and round", arguments.lot, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  Write(street->parsed() ? sim::MakeStreet(arguments.seed, arguments.street)
                         : sim::MakeParkingLot(arguments.seed, arguments.lot),
        arguments);
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
