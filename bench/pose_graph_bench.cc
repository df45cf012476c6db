// SPDX-License-Identifier: BSD-3-Clause
// Pose graphs with known minima and with many false loops. usage: pose_graph_bench DATA_FOLDER
// [OUT_FOLDER]. Prints one row per graph, with CPU seconds. With OUT_FOLDER it writes the synthetic
// graphs there for other solvers (pose_graph_gtsam.py runs this program and GTSAM on the same
// files), and solves two of 5000 poses that are read from there.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>

#include "formats/atomic_file.h"
#include "formats/g2o.h"
#include "pose_graph/pose_graph_world.h"
#include "pose_graph/torus_world.h"
#include "sslcd/formats/poses.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

constexpr int kRepetitions = 5;  // the fastest counts

double BestSeconds(const std::function<void()>& run) {
  double best = 1e9;
  for (int i = 0; i < kRepetitions; ++i) {
    const std::clock_t start = std::clock();
    run();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

void Minimum(const std::string& name, const PoseGraph& given) {
  PoseGraphSummary summary;
  const double seconds = BestSeconds([&] {
    PoseGraph graph = given;
    summary = SolvePoseGraph(graph, {});
  });
  std::printf("%-16s chi2 %.6g -> %.6g  iterations %d  seconds %.3f\n", name.c_str(),
              summary.initial_chi2, summary.final_chi2, summary.iterations, seconds);
}

// A torus like the public torus3D. Writes it, reads it with its information projected, and leaves
// the projected graph in the file.
void Torus(const std::string& name, double indefinite_share, const std::string& folder) {
  TorusOptions options;
  options.rings = 50;
  options.per_ring = 100;
  options.indefinite_share = indefinite_share;
  const std::string path = folder + "/" + name + ".g2o";
  WriteFileAtomically(path, G2oText(MakeTorus(options).graph));
  const PoseGraph graph = ReadG2o(path).graph;
  WriteFileAtomically(path, G2oText(graph));
  Minimum(name, graph);
}

void Robust(const std::string& name, const PoseGraph& given, const std::vector<Pose>& truth,
            const RobustPoseGraphOptions& options) {
  PoseGraph plain = given, robust;
  SolvePoseGraph(plain, options.graph);
  RobustPoseGraphSummary summary;
  const double seconds = BestSeconds([&] { summary = SolveRobust(robust = given, options); });
  std::printf(
      "%-16s ATE odometry %.2f  plain %.2f  robust %.3f m  kept %d  refused %d  rounds %d  seconds "
      "%.3f\n",
      name.c_str(), AteRmse(given, truth), AteRmse(plain, truth), AteRmse(robust, truth),
      summary.loops_kept, summary.loops_refused, summary.rounds, seconds);
}

void Kitti(const std::string& folder, const std::string& sequence) {
  RobustPoseGraphOptions options;
  options.graph.freedom = PoseFreedom::kPlanar;
  options.graph.gravity = GravityFrame::FromUp(Vec3(0, 0, 1));
  const std::string prefix = folder + "/kitti_" + sequence;
  const std::vector<Pose> truth = PosesOf(ReadG2o(prefix + "_GT.g2o").graph);
  PoseGraph only_true = ReadG2o(prefix + "_odom_GT_LC.g2o").graph;
  SolvePoseGraph(only_true, options.graph);
  std::printf("%-16s ATE with the true loops only %.3f m\n", ("kitti " + sequence).c_str(),
              AteRmse(only_true, truth));
  for (const std::string alpha : {"0.50", "0.15", "0.00"})
    Robust("  alpha " + alpha, ReadG2o(prefix + "_alpha_" + alpha + ".g2o").graph, truth, options);
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  using namespace sslcd;
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s DATA_FOLDER [OUT_FOLDER]\n", argv[0]);
    return 2;
  }
  const std::string data = argv[1];
  for (const std::string name : {"sphere2500", "parking-garage"}) {
    const std::string path = data + "/g2o/" + name + ".g2o";
    if (std::filesystem::exists(path)) Minimum(name, ReadG2o(path).graph);
  }
  if (argc > 2) {
    Torus("torus", 0, argv[2]);
    Torus("torus-indefinite", 0.3, argv[2]);
  }
  for (const std::string sequence : {"00", "05"}) {
    const std::string folder = data + "/kitti-libviso2-posegraphs";
    if (std::filesystem::exists(folder + "/kitti_" + sequence + "_GT.g2o")) Kitti(folder, sequence);
  }
  for (const int false_loops : {0, 17, 57}) {
    PoseGraphWorldOptions options;
    options.false_loops = false_loops;
    const PoseGraphWorld world = MakePoseGraphWorld(options);
    const std::string name = "synthetic-60-" + std::to_string(false_loops);
    Robust(name, world.graph, world.truth, {});
    if (argc < 3) continue;
    WriteFileAtomically(std::string(argv[2]) + "/" + name + ".g2o", G2oText(world.graph));
    Trajectory truth;
    truth.poses = world.truth;
    WriteFileAtomically(std::string(argv[2]) + "/" + name + ".truth", KittiText(truth));
  }
}
