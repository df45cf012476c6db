// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::python {
namespace {

using namespace py::literals;

py::object StatsToPython(const ErrorStats& stats) {
  return Make("ErrorStats", "rmse"_a = stats.rmse, "mean"_a = stats.mean, "median"_a = stats.median,
              "std"_a = stats.std, "max"_a = stats.max, "count"_a = stats.count);
}

py::object Ate(const Array& estimate, const Array& reference, const std::string& alignment,
               const Array& up) {
  const std::vector<Pose> est = PosesFrom(estimate, "estimate"),
                          ref = PosesFrom(reference, "reference");
  const AteResult ate = ComputeAte(est, ref, ParseAlignment(alignment), VectorFrom(up));
  return Make("AteResult", "error"_a = StatsToPython(ate.error), "alignment"_a = alignment,
              "scale"_a = ate.S_ref_est.scale, "T_ref_est"_a = ToArray(ate.S_ref_est.T_ref_est),
              "unique"_a = ate.unique,
              "errors"_a = Column<double>(ate.errors, [](double error) { return error; }));
}

py::object Rpe(const Array& estimate, const Array& reference, double delta, const std::string& unit,
               bool all_pairs) {
  RpeOptions options{delta, DeltaUnit::kFrames, all_pairs};
  if (unit == "metres")
    options.unit = DeltaUnit::kMetres;
  else if (unit != "frames")
    throw Error(ErrorKind::kUsage, "unit is '" + unit + "', must be one of frames, metres");
  const RpeResult rpe =
      ComputeRpe(PosesFrom(estimate, "estimate"), PosesFrom(reference, "reference"), options);
  return Make("RpeResult", "translation"_a = StatsToPython(rpe.translation),
              "rotation"_a = StatsToPython(rpe.rotation_rad));
}

Trajectory TrajectoryFrom(const py::handle& given, const std::string& name) {
  const auto stamps = given.attr("stamps").cast<Array>();
  return {{stamps.data(), stamps.data() + stamps.size()},
          PosesFrom(given.attr("poses").cast<Array>(), name)};
}

py::tuple MatchStamps(const py::object& estimate, const py::object& reference,
                      double max_difference_s) {
  const MatchedPoses matched =
      MatchByStamp(TrajectoryFrom(estimate, "estimate"), TrajectoryFrom(reference, "reference"),
                   max_difference_s);
  return py::make_tuple(ToArray(matched.est), ToArray(matched.ref));
}

}  // namespace

void BindEvaluation(py::module_& module) {
  module.def("ate", &Ate, py::arg("estimate"), py::arg("reference"), py::arg("alignment"),
             py::arg("up"));
  module.def("rpe", &Rpe, py::arg("estimate"), py::arg("reference"), py::arg("delta"),
             py::arg("unit"), py::arg("all_pairs"));
  module.def("match_by_stamp", &MatchStamps, py::arg("estimate"), py::arg("reference"),
             py::arg("max_difference_s"));
}

}  // namespace sslcd::python
