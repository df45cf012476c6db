// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <Eigen/Geometry>

#include "arrays.h"
#include "bindings.h"
#include "configuration.h"
#include "formats/pairs.h"
#include "layouts.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "sslcd/loop/layout_match.h"

namespace sslcd::python {
namespace {

using namespace py::literals;
py::object HypothesisToPython(const PoseHypothesis& hypothesis) {
  const YawShift& pose = hypothesis.pose;
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = Eigen::AngleAxisd(pose.yaw, Vec3::UnitZ()).toRotationMatrix();
  T.topRightCorner<3, 1>() = pose.t;
  const auto& matches = hypothesis.fit.matches;
  py::array_t<int> pairs(std::vector<std::size_t>{matches.size(), 2});
  int* value = pairs.mutable_data();
  for (const auto& [local, global] : matches) {
    *value++ = local;
    *value++ = global;
  }
  return Make("Hypothesis", "yaw"_a = pose.yaw, "T_global_local"_a = ToArray(T),
              "matches"_a = pairs, "score"_a = hypothesis.fit.score,
              "sigma"_a = hypothesis.fit.sigma);
}

py::object Match(const py::object& local, const py::object& global,
                 const std::vector<std::string>& settings) {
  LayoutMatchOptions options;
  SingleLookOptions decision;
  Apply(settings, [&](FieldVisitor& visitor) {
    visitor.Section("loop", "the keys that a run has too",
                    [&](FieldVisitor& loop) { loop.Nested("match", options, "layout matching"); });
    visitor.Nested("decision", decision, "when the best pose is accepted");
  });
  LabelNumbers numbers;
  const std::vector<LayoutObject> some = ObjectsFrom(local, numbers),
                                  all = ObjectsFrom(global, numbers);
  const LayoutAnswer answer = [&] {
    const py::gil_scoped_release release;
    return MatchLayouts(some, all, options, decision);
  }();
  py::list hypotheses;
  for (const PoseHypothesis& hypothesis : answer.hypotheses)
    hypotheses.append(HypothesisToPython(hypothesis));
  return Make("MatchResult", "decision"_a = ToString(answer.decision), "reason"_a = answer.reason,
              "score"_a = answer.score, "second_score"_a = answer.second_score,
              "hypotheses"_a = hypotheses);
}

py::list ReadPairs(const std::string& path) {
  py::list pairs;
  const LayoutPairFile file = ReadLayoutPairFile(path);
  for (const LayoutPair& pair : file.pairs)
    pairs.append(py::make_tuple(pair.id, LayoutOf(pair.local),
                                LayoutOf(file.map ? *file.map : pair.global)));
  return pairs;
}

}  // namespace

void BindMatch(py::module_& module) {
  module.def("match", &Match, py::arg("local"), py::arg("global_"), py::arg("settings"));
  module.def("read_pairs", &ReadPairs, py::arg("path"));
}

}  // namespace sslcd::python
