// SPDX-License-Identifier: BSD-3-Clause
#include "layouts.h"

#include <pybind11/stl.h>

#include <optional>

#include "arrays.h"
#include "sslcd/core/error.h"

namespace sslcd::python {

std::vector<LayoutObject> ObjectsFrom(const py::handle& layout, LabelNumbers& numbers) {
  const auto labels = layout.attr("labels").cast<std::vector<std::string>>();
  const auto symmetries = layout.attr("symmetries").cast<std::vector<std::string>>();
  const auto positions = layout.attr("positions").cast<Array>();
  const auto yaws = layout.attr("yaws").cast<Array>();
  const auto dims = layout.attr("dims").cast<Array>();
  std::vector<LayoutObject> objects(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    LayoutObject& object = objects[i];
    object.id = static_cast<int>(i);
    object.label = numbers.emplace(labels[i], static_cast<int>(numbers.size())).first->second;
    const std::optional<Symmetry> symmetry = ParseSymmetry(symmetries[i]);
    if (!symmetry)
      throw Error(ErrorKind::kUsage,
                  "symmetry is '" + symmetries[i] + "', must be one of none, pi, full");
    object.symmetry = *symmetry;
    object.position = Eigen::Map<const Vec3>(positions.data(row, 0));
    object.yaw = yaws.at(row);
    object.dims = Eigen::Map<const Vec3>(dims.data(row, 0));
  }
  return objects;
}

py::object LayoutOf(const std::vector<LayoutObject>& objects) {
  py::list labels, symmetries;
  for (const LayoutObject& object : objects) {
    labels.append(std::to_string(object.label));
    symmetries.append(ToString(object.symmetry));
  }
  const auto rows = static_cast<py::ssize_t>(objects.size());
  const auto vectors = [&](const auto& vector_of) {
    return Stack<1, 3>(objects,
                       [&](const LayoutObject& o) { return Eigen::RowVector3d(vector_of(o)); })
        .reshape({rows, py::ssize_t{3}});
  };
  return py::module_::import("sslcd.layouts")
      .attr("Layout")(labels, vectors([](const LayoutObject& o) { return o.position; }),
                      Column<double>(objects, [](const LayoutObject& o) { return o.yaw; }),
                      vectors([](const LayoutObject& o) { return o.dims; }), symmetries,
                      Column<int>(objects, [](const LayoutObject& o) { return o.id; }));
}

}  // namespace sslcd::python
