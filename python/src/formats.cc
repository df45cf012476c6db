// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "bindings.h"
#include "sslcd/core/error.h"
#include "sslcd/formats/poses.h"

namespace sslcd::python {
namespace {

std::string TrajectoryText(const Array& stamps, const Array& poses) {
  Trajectory trajectory{{stamps.data(), stamps.data() + stamps.size()}, PosesFrom(poses, "poses")};
  if (trajectory.stamps.size() != trajectory.poses.size())
    throw Error(ErrorKind::kUsage, "stamps and poses have different lengths");
  return TumText(trajectory);
}

}  // namespace

void BindFormats(py::module_& module) {
  module.def(
      "gravity_axes",
      [](const Array& up) { return ToArray(GravityFrame::FromUp(VectorFrom(up)).Basis()); },
      py::arg("up"));
  module.def("tum_text", &TrajectoryText, py::arg("stamps"), py::arg("poses"));
  module.def(
      "kitti_text",
      [](const Array& poses) {
        return KittiText({std::vector<double>(poses.shape(0)), PosesFrom(poses, "poses")});
      },
      py::arg("poses"));
}

}  // namespace sslcd::python
