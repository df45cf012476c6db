// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/perception/colour.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.h"
#include "bindings.h"
#include "configuration.h"

namespace sslcd::python {
namespace {

using Pixels = py::array_t<unsigned char, py::array::c_style>;

// [N, D]; a row of zeros where the box has no pixel in the image.
py::array_t<float> ColourVectors(const Pixels& pixels, const Array& boxes,
                                 const std::vector<std::string>& settings) {
  const ColourOptions options = OptionsFrom(settings).colour;
  const ImageView image{pixels.data(), static_cast<int>(pixels.shape(1)),
                        static_cast<int>(pixels.shape(0)),
                        static_cast<std::size_t>(pixels.strides(0)), 3};
  std::vector<std::vector<float>> vectors;
  std::size_t size = 0;
  for (py::ssize_t i = 0; i < boxes.shape(0); ++i) {
    const double* b = boxes.data(i, 0);
    const Box2d box{b[0], b[1], b[2], b[3]};
    vectors.push_back(box.Area() > 0 ? ColourVector(image, box, options) : std::vector<float>());
    size = std::max(size, vectors.back().size());
  }
  py::array_t<float> rows(std::vector<std::size_t>{vectors.size(), size});
  float* row = rows.mutable_data();
  std::fill_n(row, vectors.size() * size, 0.F);
  for (const std::vector<float>& vector : vectors) {
    std::copy(vector.begin(), vector.end(), row);
    row += size;
  }
  return rows;
}

}  // namespace

void BindColour(py::module_& module) {
  module.def("colour_vectors", &ColourVectors, py::arg("image"), py::arg("boxes"),
             py::arg("settings"));
}

}  // namespace sslcd::python
