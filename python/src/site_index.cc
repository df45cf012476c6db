// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/retrieval/site_index.h"

#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "results.h"

namespace sslcd::python {
namespace {

using namespace py::literals;

// Of a sslcd.Layout, whose axes are those of an index.
std::vector<SiteObject> ObjectsOf(const py::handle& layout) {
  const auto labels = layout.attr("labels").cast<std::vector<std::string>>();
  const Array positions = layout.attr("positions").cast<Array>();
  std::vector<SiteObject> objects;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    objects.push_back({labels[i], positions.at(row, 0), positions.at(row, 1)});
  }
  return objects;
}

void Build(const std::vector<std::string>& names, const py::list& layouts,
           const std::string& path) {
  std::vector<Site> sites;
  for (std::size_t i = 0; i < names.size(); ++i) sites.push_back({names[i], ObjectsOf(layouts[i])});
  const py::gil_scoped_release release;
  SiteIndex::Build(sites, path);
}

py::list Find(const SiteIndex& index, const py::object& stretch, int most) {
  const std::vector<SiteObject> objects = ObjectsOf(stretch);
  std::vector<SiteCandidate> found;
  {
    const py::gil_scoped_release release;
    found = index.Find(objects, most);
  }
  py::list candidates;
  for (const SiteCandidate& one : found)
    candidates.append(Make("SiteCandidate", "site"_a = one.site, "name"_a = Text(one.name),
                           "score"_a = one.score, "matches"_a = one.matches, "yaw"_a = one.yaw,
                           "x"_a = one.x, "y"_a = one.y));
  return candidates;
}

}  // namespace

void BindSiteIndex(py::module_& module) {
  module.def("build_site_index", &Build, py::arg("names"), py::arg("layouts"), py::arg("path"));
  py::class_<SiteIndex>(module, "SiteIndex")
      .def(py::init([](const std::string& path) {
             const py::gil_scoped_release release;
             return SiteIndex(path);
           }),
           py::arg("path"))
      .def("__len__", &SiteIndex::size)
      .def("objects", &SiteIndex::objects)
      .def("find", &Find, py::arg("stretch"), py::arg("most"));
}

}  // namespace sslcd::python
