// SPDX-License-Identifier: BSD-3-Clause
#include "check/boxes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "check/cuboid.h"
#include "core/median.h"
#include "perception/projection.h"

namespace sslcd::check {
namespace {

constexpr double kBetter = 0.12, kGood = 0.5, kHeading = 0.02;  // IoU
constexpr double kOtherFocal = 1.2, kNearPlain = 0.1;           // ratio, its logarithm
constexpr double kOtherCamera = 0.2;                            // [m]
constexpr double kBoxedShare = 0.5;

struct BoxConvention {
  std::string id, name;
  CuboidChange change;
};

/// The ratio that people make by mistake, if it is near one.
double Rounded(double ratio) {
  for (const double plain : {0.1, 0.25, 1. / 3, 0.5, 2., 3., 4., 10.})
    if (std::abs(std::log(ratio / plain)) < kNearPlain) return plain;
  return ratio;
}

/// Changes the cuboid of a row.
template <class F>
CuboidChange OfCuboid(F change) {
  return [change](Row& row, Camera&) {
    FileCuboid cuboid = ReadCuboid(row.detection);
    change(cuboid);
    WriteCuboid(cuboid, row);
  };
}

template <class F>
CuboidChange OfBox(F change) {
  return [change](Row& row, Camera& camera) {
    const Box2d box = change(row.written.box, camera);
    row.written.box = box;
    row.detection.box = box.Area() > 0 ? std::optional<Box2d>(box) : std::nullopt;
  };
}

bool IsMoreWideThanLong(const Sequence& sequence) {
  const auto wide = std::count_if(sequence.rows.begin(), sequence.rows.end(), [](const Row& row) {
    return row.detection.dims.y() > row.detection.dims.x();
  });
  return 2 * static_cast<std::size_t>(wide) > sequence.rows.size();
}

void AddSizes(const Sequence& sequence, std::vector<BoxConvention>& all) {
  // a cuboid is as long as wide or longer, or its heading is a quarter turn off
  const bool swapped = IsMoreWideThanLong(sequence);
  std::array<int, 3> order = {0, 1, 2};  // where h, w, l are in the columns
  while (std::next_permutation(order.begin(), order.end())) {
    if (order == std::array<int, 3>{0, 2, 1} && !swapped) continue;
    std::string name = "   ";
    for (int i = 0; i < 3; ++i) name[order[i]] = "hwl"[i];
    all.push_back({"size_order",
                   std::string("sizes read as ") + name[0] + " " + name[1] + " " + name[2],
                   OfCuboid([order](FileCuboid& c) {
                     const std::array<double, 3> columns = {c.h, c.w, c.l};
                     c.h = columns[order[0]];
                     c.w = columns[order[1]];
                     c.l = columns[order[2]];
                   })});
  }
  all.push_back({"box_centre", "the place taken as the cuboid's centre",
                 OfCuboid([](FileCuboid& c) { c.bottom.y() += 0.5 * c.h; })});
  all.push_back({"box_centre", "the place taken as the centre of the top face",
                 OfCuboid([](FileCuboid& c) { c.bottom.y() += c.h; })});
}

void AddFormats(std::vector<BoxConvention>& all) {
  all.push_back({"box_format", "boxes read as left top width height",
                 OfBox([](const Box2d& b, const Camera&) {
                   return Box2d{b.left, b.top, b.left + b.right, b.top + b.bottom};
                 })});
  all.push_back({"box_format", "boxes read as centre, width and height",
                 OfBox([](const Box2d& b, const Camera&) {
                   return Box2d{b.left - b.right / 2, b.top - b.bottom / 2, b.left + b.right / 2,
                                b.top + b.bottom / 2};
                 })});
  all.push_back({"box_format", "boxes read as top left bottom right",
                 OfBox([](const Box2d& b, const Camera&) {
                   return Box2d{b.top, b.left, b.bottom, b.right};
                 })});
  all.push_back({"box_format", "boxes read as shares of the image",
                 OfBox([](const Box2d& b, const Camera& camera) {
                   const double w = camera.width > 0 ? camera.width : 2 * camera.cx,
                                h = camera.height > 0 ? camera.height : 2 * camera.cy;
                   return Box2d{b.left * w, b.top * h, b.right * w, b.bottom * h};
                 })});
}

/// What the boxes say about the camera: the ratio of their width to the cuboids', and how far the
/// camera would have to be to the right [m].
struct CameraFit {
  double focal_ratio = 1, aside_m = 0;
};
std::optional<CameraFit> FitCamera(const Sequence& sequence) {
  std::vector<double> ratios, asides;
  for (const Row& row : sequence.rows) {
    const double z = row.detection.T_cam_object.translation().z();
    if (!row.detection.box || z < 2 || row.detection.box->left < 2) continue;
    Camera whole = *sequence.camera;
    whole.width = whole.height = 0;
    const auto box = ProjectCuboid(row.detection.T_cam_object, row.detection.dims, whole);
    if (!box) continue;
    const Box2d& given = *row.detection.box;
    ratios.push_back(std::sqrt(given.Area() / box->Area()));
    asides.push_back((box->left + box->right - given.left - given.right) / 2 * z / whole.fx);
  }
  if (static_cast<int>(ratios.size()) < kLeastBoxes) return std::nullopt;
  return CameraFit{Rounded(Median(std::move(ratios))), Median(std::move(asides))};
}

void AddCameras(const Sequence& sequence, std::vector<BoxConvention>& all) {
  const auto fit = FitCamera(sequence);
  if (!fit) return;
  const double f = fit->focal_ratio, aside = fit->aside_m;
  if (std::abs(std::log(f)) > std::log(kOtherFocal)) {
    all.push_back(
        {"focal_length", "the focal length times " + Figure(f, 3), [f](Row&, Camera& camera) {
           camera.fx *= f;
           camera.fy *= f;
         }});
    all.push_back({"focal_length", "focal length and principal point times " + Figure(f, 3),
                   [f](Row&, Camera& camera) {
                     for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy})
                       *value *= f;
                   }});
  }
  if (std::abs(aside) > kOtherCamera)
    all.push_back(
        {"wrong_camera",
         "a camera " + Metres(std::abs(aside)) + " to the " + (aside > 0 ? "right" : "left"),
         [aside](Row&, Camera& camera) { camera.offset.x() -= aside; }});
}

/// What the headings' test could make of it: swapped sides look like a quarter turn.
double IouWithOtherHeadings(const Sequence& sequence) {
  double best = 0;
  const bool has_alphas = HasAlphas(sequence);
  const auto with = [&](auto heading) {
    const auto iou = MedianIou(sequence, [&](Row& row, Camera&) {
      FileCuboid cuboid = ReadCuboid(row.detection);
      cuboid.rotation_y = WrapAngle(heading(row));
      WriteCuboid(cuboid, row);
    });
    best = std::max(best, iou.value_or(0));
  };
  if (!IsMoreWideThanLong(sequence))
    with([](const Row& row) { return row.written.rotation_y + M_PI / 2; });
  if (has_alphas) with([](const Row& row) { return row.written.alpha + Bearing(row.detection); });
  return best;
}

bool HasBoxes(const Sequence& sequence) {
  const auto boxed = std::count_if(sequence.rows.begin(), sequence.rows.end(),
                                   [](const Row& row) { return row.detection.box.has_value(); });
  return boxed > 0 &&
         static_cast<double>(boxed) > kBoxedShare * static_cast<double>(sequence.rows.size());
}

}  // namespace

Outcome CheckBoxes(const Sequence& sequence) {
  if (!sequence.camera) {
    if (HasBoxes(sequence) && static_cast<int>(sequence.rows.size()) >= kLeastBoxes)
      return Found("no_calibration",
                   "there are 2D boxes and no calibration: nothing compares them with cuboids");
    return NotTestable("no calibration");
  }
  std::vector<BoxConvention> all;
  AddSizes(sequence, all);
  AddFormats(all);
  AddCameras(sequence, all);
  const std::optional<double> measured = MedianIou(sequence);
  const double given = measured.value_or(0), turned = IouWithOtherHeadings(sequence);
  const BoxConvention* best = nullptr;
  double of_best = 0;
  for (const BoxConvention& other : all) {
    const std::optional<double> iou = MedianIou(sequence, other.change);
    if (!iou || *iou < kGood || *iou < given + kBetter || *iou <= of_best) continue;
    if (other.id == "size_order" && *iou < turned + kHeading) continue;
    best = &other;
    of_best = *iou;
  }
  const std::string text = measured ? "cuboids fill their 2D boxes to " + Percent(given)
                                    : std::string("no box can be compared");
  if (best) {
    const CuboidChange change = best->change;
    return Found(best->id, text + "; with " + best->name + " to " + Percent(of_best),
                 [change](Sequence& s) {
                   Camera camera = *s.camera;
                   for (Row& row : s.rows) {
                     camera = *s.camera;
                     change(row, camera);
                   }
                   s.camera = camera;
                 });
  }
  if (!measured)
    return NotTestable("fewer than " + std::to_string(kLeastBoxes) + " 2D boxes inside the image");
  return Ok(text);
}

}  // namespace sslcd::check
