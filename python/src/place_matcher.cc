// SPDX-License-Identifier: BSD-3-Clause
#include "place_matcher.h"

#include <pybind11/stl.h>

#include <memory>

#include "arrays.h"
#include "layouts.h"
#include "sslcd/core/error.h"

namespace sslcd::python {
namespace {

using namespace py::literals;

std::shared_ptr<py::object> HeldWithoutGil(const py::object& function) {
  return {new py::object(function), [](py::object* held) {
            const py::gil_scoped_acquire acquire;
            delete held;
          }};
}

std::optional<PlaceAnswer> AnswerFrom(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  const py::object type = py::module_::import("sslcd.layouts").attr("PlaceAnswer");
  if (!py::isinstance(given, type))
    throw Error(ErrorKind::kUsage, "the place matcher returned " +
                                       py::repr(given).cast<std::string>() +
                                       ", expected a sslcd.PlaceAnswer or None");
  PlaceAnswer answer;
  const auto matches = given.attr("matches").cast<py::array_t<int>>();
  for (py::ssize_t i = 0; i < matches.shape(0); ++i)
    answer.matches.emplace_back(matches.at(i, 0), matches.at(i, 1));
  answer.match_frame = given.attr("match_frame").cast<int>();
  answer.T_match_query = PoseFrom(given.attr("T_match_query").cast<Array>().data(),
                                  "the place matcher's T_match_query");
  answer.score = given.attr("score").cast<double>();
  answer.accepted = given.attr("accepted").cast<bool>();
  return answer;
}

}  // namespace

PlaceMatcher PlaceMatcherFrom(const py::object& function) {
  if (function.is_none()) return {};
  return [held = HeldWithoutGil(function)](const PlaceQuery& query) {
    const py::gil_scoped_acquire acquire;
    const py::object asked =
        py::module_::import("sslcd.layouts")
            .attr("PlaceQuery")("local"_a = LayoutOf(query.local),
                                "global_"_a = LayoutOf(query.global), "frame"_a = query.frame,
                                "old_frame"_a = query.old_frame);
    return AnswerFrom((*held)(asked));
  };
}

}  // namespace sslcd::python
