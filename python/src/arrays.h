// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd::python {

namespace py = pybind11;

/// A C-contiguous array of doubles.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A matrix or vector as an array of its shape.
template <class Derived>
Array ToArray(const Eigen::MatrixBase<Derived>& matrix) {
  std::vector<py::ssize_t> shape = {matrix.rows(), matrix.cols()};
  if (matrix.cols() == 1) shape.pop_back();
  Array array(shape);
  double* value = array.mutable_data();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) *value++ = matrix(row, column);
  return array;
}

/// A list of matrices [N, rows, cols]; `matrix_of(item)` gives that of an item.
template <int kRows, int kCols, class Items, class MatrixOf>
Array Stack(const Items& items, const MatrixOf& matrix_of) {
  using RowMajor = Eigen::Matrix<double, kRows, kCols, Eigen::RowMajor | Eigen::DontAlign>;
  Array array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(items.size()), kRows, kCols});
  double* value = array.mutable_data();
  for (const auto& item : items) {
    const RowMajor matrix = matrix_of(item);
    value = std::copy_n(matrix.data(), kRows * kCols, value);
  }
  return array;
}

/// A list of numbers [N]; `number_of(item)` gives that of an item.
template <class T, class Items, class NumberOf>
py::array_t<T> Column(const Items& items, const NumberOf& number_of) {
  py::array_t<T> array(static_cast<py::ssize_t>(items.size()));
  T* value = array.mutable_data();
  for (const auto& item : items) *value++ = static_cast<T>(number_of(item));
  return array;
}

/// [4, 4], and [N, 4, 4].
Array ToArray(const Pose& pose);
Array ToArray(const std::vector<Pose>& poses);

/// The pose of a row-major 4x4 matrix. A matrix with a value that is not finite becomes a pose that
/// is not finite, which the library refuses or counts. Throws Error(kBadInput) with `name` if the
/// matrix is no rigid transform.
Pose PoseFrom(const double* matrix, const std::string& name);
/// Of an array [N, 4, 4]; `name` becomes `name[i]`.
std::vector<Pose> PosesFrom(const Array& matrices, const std::string& name);

/// Of an array [3].
Vec3 VectorFrom(const Array& values);

}  // namespace sslcd::python
