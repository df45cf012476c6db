// SPDX-License-Identifier: BSD-3-Clause
// Stereo lifting judged on a rendered sequence: lift_bench SEQUENCE BOXES CASE SEED [EVERY
// [ROWS.csv]] SEQUENCE: `sslcd_sim halv --case CASE --seed SEED --render --render-truth`; BOXES:
// from scripts/instance_boxes.py or a detector; every EVERYth frame. A box belongs to the object
// whose visible part it covers best. The truth comes from the world.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "eval/iou3d.h"
#include "formats/boxes.h"
#include "formats/calib.h"
#include "sim/halv.h"
#include "sslcd/core/error.h"
#include "sslcd/formats/poses.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

struct Judged {
  double range, radial, lateral, vertical, yaw, length, width, height, iou;
  DetectionSigmas sigmas;
};

cv::Mat Read(const std::string& folder, const char* kind, int frame, int flags) {
  char name[32];
  std::snprintf(name, sizeof name, "/%s/%06d.png", kind, frame);
  const cv::Mat image = cv::imread(folder + name, flags);
  if (image.empty()) throw Error(ErrorKind::kBadInput, folder + name + ": no image");
  return image;
}

/// The visible part of each object, by WorldObject::id.
std::map<int, Box2d> VisibleBoxes(const cv::Mat& instances) {
  std::map<int, Box2d> boxes;
  for (int y = 0; y < instances.rows; ++y) {
    const auto* row = instances.ptr<std::uint16_t>(y);
    for (int x = 0; x < instances.cols; ++x) {
      if (row[x] == 0) continue;
      const double u = x, v = y;
      Box2d& box = boxes.try_emplace(row[x] - 1, Box2d{u, v, u, v}).first->second;
      box = {std::min(box.left, u), std::min(box.top, v), std::max(box.right, u),
             std::max(box.bottom, v)};
    }
  }
  return boxes;
}

/// The object whose visible box the box covers best; -1: none.
int IdentityOf(const std::map<int, Box2d>& visible, const Box2d& box) {
  int best = -1;
  double most = 0.5;
  for (const auto& [identity, other] : visible) {
    const double iou = Iou(box, other);
    if (iou > most) {
      most = iou;
      best = identity;
    }
  }
  return best;
}

Judged Judge(const LiftedBox& lifted, const Pose& truth, const Vec3& dims) {
  const Vec3 centre = truth.translation(), found = lifted.detection.T_cam_object.translation();
  const Vec3 error = RayFrame(centre) * (found - centre);
  const GravityFrame gravity;
  const Cuboid a = ToCuboid(lifted.detection.T_cam_object, lifted.detection.dims, gravity);
  const Cuboid b = ToCuboid(truth, dims, gravity);
  const Vec3 size = lifted.detection.dims - dims;
  return {centre.norm(), error.x(), error.y(), error.z(),   WrapAngle(a.yaw - b.yaw, M_PI),
          size.x(),      size.y(),  size.z(),  Iou3d(a, b), lifted.sigmas};
}

constexpr const char* kRowNames =
    "frame,identity,status,range,view,ahead,left,radial,lateral,vertical,yaw,length,width,height,"
    "sigma_radial,"
    "sigma_lateral,sigma_yaw,box_left,box_top,box_right,box_bottom";

/// One box as a CSV row. view: bearing of the camera in the object's true frame, from its front to
/// its left [rad]; ahead, left: error of the centre in that frame.
void WriteRow(std::FILE* rows, int frame, int identity, const LiftedBox& lifted, const Pose& truth,
              const Vec3& dims) {
  const bool known =
      lifted.status == LiftStatus::kLifted || lifted.status == LiftStatus::kAmbiguous;
  const Judged judged = known ? Judge(lifted, truth, dims) : Judged{};
  const Vec3 camera = truth.inverse() * Vec3::Zero();
  const Vec3 off = known ? Vec3(truth.inverse() * lifted.detection.T_cam_object.translation())
                         : Vec3(Vec3::Zero());
  const Box2d box = lifted.detection.box.value_or(Box2d());
  std::fprintf(rows,
               "%d,%d,%d,%.2f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.4f,%.3f,%.3f,%.3f,%.3f,%.3f,%.4f,%."
               "1f,%.1f,%.1f,%.1f\n",
               frame, identity, static_cast<int>(lifted.status), truth.translation().norm(),
               std::atan2(camera.y(), camera.x()), off.x(), off.y(), judged.radial, judged.lateral,
               judged.vertical, judged.yaw, judged.length, judged.width, judged.height,
               judged.sigmas.radial, judged.sigmas.lateral, judged.sigmas.yaw, box.left, box.top,
               box.right, box.bottom);
}

template <class Of>
double Quantile(const std::vector<Judged>& judged, double share, Of of) {
  std::vector<double> values;
  for (const Judged& j : judged) values.push_back(of(j));
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void Print(const char* name, const std::vector<Judged>& judged, int boxes) {
  const auto median = [&](auto of) {
    return Quantile(judged, 0.5, [&](const Judged& j) { return std::abs(of(j)); });
  };
  // standard deviation of the inliers
  const auto typical = [&](auto of) { return 1.48 * median(of); };
  double iou = 0;
  for (const Judged& j : judged) iou += j.iou / static_cast<double>(judged.size());
  std::printf(
      "| %s | %d | %.2f | %.3f | %+.2f %.2f %.2f %.2f | %.1f %.1f | %.2f %.2f %.2f | %.2f %.2f "
      "%.2f %.2f |\n",
      name, boxes, judged.size() / std::max(1., double(boxes)), iou,
      Quantile(judged, 0.5, [](const Judged& j) { return j.radial; }),
      median([](const Judged& j) { return j.radial; }),
      median([](const Judged& j) { return j.lateral; }),
      median([](const Judged& j) { return j.vertical; }),
      median([](const Judged& j) { return j.yaw * 180 / M_PI; }),
      Quantile(judged, 0.9, [](const Judged& j) { return std::abs(j.yaw) * 180 / M_PI; }),
      median([](const Judged& j) { return j.length; }),
      median([](const Judged& j) { return j.width; }),
      median([](const Judged& j) { return j.height; }),
      typical([](const Judged& j) { return j.radial / j.sigmas.radial; }),
      typical([](const Judged& j) { return j.lateral / j.sigmas.lateral; }),
      typical([](const Judged& j) { return j.vertical / j.sigmas.vertical; }),
      typical([](const Judged& j) { return j.yaw / j.sigmas.yaw; }));
}

constexpr double kNear = 25;                                 // [m]
const std::vector<double> kEdges{0, 8, 12, 18, 25, 40, 80};  // limits of the bins of ranges [m]

/// Results of boxes by true range.
struct Tally {
  std::vector<std::vector<Judged>> bins{kEdges.size() - 1};
  std::vector<int> counts = std::vector<int>(kEdges.size() - 1);
  std::vector<Judged> near, all;
  int near_boxes = 0, all_boxes = 0;
  std::map<std::string, int> statuses;
};

/// Whether the box counts: its object is within the last bin.
bool Add(const LiftedBox& lifted, const Pose& truth, const Vec3& dims, Tally& tally) {
  const double range = truth.translation().norm();
  const std::size_t bin =
      std::upper_bound(kEdges.begin(), kEdges.end(), range) - kEdges.begin() - 1;
  if (bin >= tally.bins.size()) return false;
  ++tally.statuses[ToString(lifted.status)];
  ++tally.counts[bin];
  ++tally.all_boxes;
  tally.near_boxes += range <= kNear;
  if (lifted.status != LiftStatus::kLifted) return true;
  const Judged judged = Judge(lifted, truth, dims);
  tally.bins[bin].push_back(judged);
  tally.all.push_back(judged);
  if (range <= kNear) tally.near.push_back(judged);
  return true;
}

void PrintTable(const Tally& tally) {
  std::printf(
      "| range [m] | boxes | lifted | mean IoU | along bias, median [m], across, up | yaw median, "
      "90 %% [deg] | "
      "length, width, "
      "height [m] | errors over sigmas: along, across, up, yaw "
      "|\n|---|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < tally.bins.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "%.0f-%.0f", kEdges[i], kEdges[i + 1]);
    Print(name, tally.bins[i], tally.counts[i]);
  }
  Print("0-25", tally.near, tally.near_boxes);
  Print("all", tally.all, tally.all_boxes);
  for (const auto& [status, count] : tally.statuses) std::printf("%s: %d\n", status.c_str(), count);
}

int Run(int argc, char** argv) {
  if (argc < 5)
    throw Error(ErrorKind::kUsage, "lift_bench SEQUENCE BOXES CASE SEED [EVERY [ROWS.csv]]");
  const std::string folder = argv[1];
  const auto boxes = ReadBoxes(argv[2]);
  sim::HalvScene scene;
  scene.case_number = std::atoi(argv[3]);
  const sim::World world = sim::MakeHalvWorld(std::strtoull(argv[4], nullptr, 10), scene).world;
  const int every = argc > 5 ? std::max(1, std::atoi(argv[5])) : 1;
  const Calibration calibration = ReadCalibration(folder + "/calib.txt");
  const StereoCamera camera = MakeStereoCamera(*calibration.left, *calibration.right);
  LiftOptions options;
  options.ground.height_m = world.camera_height_m + 0.2;  // a wrong prior

  Tally tally;
  int frames = 0;
  double ms = 0;
  std::FILE* rows = argc > 6 ? std::fopen(argv[6], "w") : nullptr;
  if (rows) std::fprintf(rows, "%s\n", kRowNames);
  for (const auto& [frame, list] : boxes) {
    if (frame % every != 0) continue;
    const cv::Mat left = Read(folder, "image_2", frame, cv::IMREAD_COLOR);
    const cv::Mat right = Read(folder, "image_3", frame, cv::IMREAD_COLOR);
    const auto visible = VisibleBoxes(Read(folder, "instance_2", frame, cv::IMREAD_UNCHANGED));
    const std::clock_t start = std::clock();
    const std::vector<LiftedBox> lifted =
        LiftBoxes({ViewOf(left), ViewOf(right)}, camera, list, options);
    ms += 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;  // processor time
    ++frames;
    const Pose T_cam_world = world.truth.poses[frame].inverse();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const int identity = IdentityOf(visible, list[i].box);
      if (identity < 0) continue;
      const sim::WorldObject& object = world.objects[identity];
      const Pose truth = T_cam_world * object.PoseAt(frame);
      if (Add(lifted[i], truth, object.dims, tally) && rows)
        WriteRow(rows, frame, identity, lifted[i], truth, object.dims);
    }
  }
  if (rows) std::fclose(rows);
  PrintTable(tally);
  std::printf("%d frames, %.1f boxes and %.1f ms each\n", frames,
              tally.all_boxes / std::max(1., double(frames)), ms / std::max(1, frames));
  return 0;
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  try {
    return sslcd::Run(argc, argv);
  } catch (const sslcd::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
