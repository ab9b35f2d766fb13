// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <Eigen/Core>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Between NumPy and the library.  The Python files convert what users give to
// C-contiguous arrays of these types first, and say what is wrong with it.
namespace phongpd::python {

namespace nb = nanobind;

using Rows3 =
    nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Rows4 =
    nb::ndarray<const double, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;
using Corners =
    nb::ndarray<const int, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

// A NumPy array of that shape which owns `values`.
template <typename T>
nb::object Owned(std::unique_ptr<T[]> values,
                 std::initializer_list<size_t> shape) {
  T* kept = values.release();
  nb::capsule owner(kept,
                    [](void* p) noexcept { delete[] static_cast<T*>(p); });
  return nb::cast(
      nb::ndarray<nb::numpy, T>(kept, shape.size(), shape.begin(), owner));
}
template <typename T>
nb::object Owned(std::vector<T> values, std::initializer_list<size_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  nb::capsule owner(
      kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, T>(kept->data(), shape.size(),
                                            shape.begin(), owner));
}

// Read-only, without a copy; `owner` keeps them.
inline nb::object View(const std::vector<Eigen::Vector3d>& rows,
                       nb::handle owner) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const size_t shape[2] = {rows.size(), 3};
  return nb::cast(nb::ndarray<nb::numpy, const double>(
      rows.empty() ? nullptr : rows[0].data(), 2, shape, owner));
}
inline nb::object View(const std::vector<Triangle>& rows, nb::handle owner) {
  static_assert(sizeof(Triangle) == 3 * sizeof(int));
  const size_t shape[2] = {rows.size(), 3};
  return nb::cast(nb::ndarray<nb::numpy, const int>(
      rows.empty() ? nullptr : rows[0].data(), 2, shape, owner));
}

inline Eigen::Vector3d Row(const Rows3& rows, size_t i) {
  return {rows(i, 0), rows(i, 1), rows(i, 2)};
}

inline std::vector<Eigen::Vector3d> ToPoints(const Rows3& rows) {
  std::vector<Eigen::Vector3d> points(rows.shape(0));
  for (size_t i = 0; i < points.size(); ++i) points[i] = Row(rows, i);
  return points;
}

inline nb::object ToArray(const Eigen::Vector3d& p) {
  return Owned(std::vector<double>{p.x(), p.y(), p.z()}, {3});
}
inline nb::object ToArray(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points) {
    values.insert(values.end(), {p.x(), p.y(), p.z()});
  }
  return Owned(std::move(values), {points.size(), 3});
}

// Columns of an answer, one row a point, filled while Python runs on.  Their
// memory is touched by who fills it first, and not cleared before.
template <typename T, size_t kWidth>
class Column {
 public:
  explicit Column(size_t rows) : rows_(rows), values_(new T[rows * kWidth]) {}
  T& operator[](size_t row) { return values_[row]; }
  void Set(size_t row, const Eigen::Vector3d& v) {
    for (size_t k = 0; k < 3; ++k) {
      values_[3 * row + k] = v[static_cast<Eigen::Index>(k)];
    }
  }
  // Once.
  nb::object Array() {
    if constexpr (kWidth == 1) return Owned(std::move(values_), {rows_});
    return Owned(std::move(values_), {rows_, kWidth});
  }

 private:
  size_t rows_;
  std::unique_ptr<T[]> values_;
};

}  // namespace phongpd::python
