// SPDX-License-Identifier: BSD-3-Clause
#include "bench_kitti.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "benchmark/paper_figures.h"
#include "evaluation.h"
#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/run.h"

namespace sslcd::apps {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Sequences(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".txt" &&
        entry.path().stem().string().find_first_not_of("0123456789") == std::string::npos)
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path TruePoses(const std::string& sequence) {
  return fs::path("oxts_cam0_poses") / (sequence + ".txt");
}

std::map<std::string, std::optional<double>> RunOne(const std::string& folder,
                                                    const std::string& detections,
                                                    const std::string& sequence,
                                                    const Options& options) {
  DatasetRequest request;
  request.path = folder;
  request.format = "kitti-tracking";
  request.sequence = sequence;
  request.detections = detections;
  request.odometry = "orbslam3_poses";
  request.groundtruth = TruePoses(sequence).string();
  const Dataset dataset = LoadDataset(request);
  const RunResult run =
      RunSequence(dataset.frames,
                  {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera}, options);
  const MapFile map{dataset.up_axis, run.objects};
  EvaluationInput input;
  input.estimate = run.trajectory;
  input.frames = run.frames;
  input.odometry = run.odometry;
  input.groundtruth = dataset.groundtruth;
  input.map = &map;
  input.detections = &dataset.frames;
  input.labels_path = (fs::path(folder) / "label_02" / (sequence + ".txt")).string();
  const Metrics metrics = Evaluate(input);
  return {metrics.begin(), metrics.end()};
}

}  // namespace

benchmark::Table KittiTable(const std::string& folder, const std::vector<std::string>& detections,
                            const Options& options, const std::function<bool()>& stop) {
  benchmark::Table table{"table1",
                         "3D IoU of standing cars, KITTI tracking",
                         {"detections", "sequence", "single detections", "map", "coverage",
                          "purity", "VisualDet3D (paper)", "CubeSLAM (paper)", "Ji et al. (paper)"},
                         {}};
  const std::vector<std::string> usual = {"det_stereo_grade_car", "det_pointrcnn_car"};
  for (const std::string& set : detections.empty() ? usual : detections) {
    const fs::path path = fs::path(folder) / set;
    if (!fs::is_directory(path)) {
      if (detections.empty()) continue;
      throw Error(ErrorKind::kBadInput, {path.string()},
                  "no such folder of detections; check --detections");
    }
    for (const std::string& sequence : Sequences(path)) {
      if (stop && stop()) return {};
      // Without true poses the map cannot be judged (sequence 0011).
      if (!fs::is_regular_file(folder / TruePoses(sequence))) continue;
      const auto figures = RunOne(folder, set, sequence, options);
      const auto cell = [&](const char* name) {
        const std::optional<double>& value = figures.at(name);
        return value ? benchmark::Cell("%.3f", *value) : std::string();
      };
      std::vector<std::string> row{
          set, sequence, cell("iou_raw"), cell("iou_map"), cell("coverage"), cell("purity"), "",
          "",  ""};
      for (const benchmark::PaperIou& paper : benchmark::kPaperIou)
        if (paper.sequence == sequence) {
          row[6] = benchmark::Cell("%.3f", paper.visualdet3d);
          row[7] = benchmark::Cell("%.3f", paper.cubeslam);
          row[8] = benchmark::Cell("%.3f", paper.paper);
        }
      table.rows.push_back(std::move(row));
    }
  }
  if (table.rows.empty())
    throw Error(ErrorKind::kBadInput, {folder},
                "holds no sequence with detections and true poses (oxts_cam0_poses); give "
                "--detections");
  return table;
}

}  // namespace sslcd::apps
