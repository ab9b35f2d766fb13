// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <array>
#include <memory>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "core/projection/query_batch.h"
#include "core/projection/smoothed_metric.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"

namespace phongpd::python {
namespace {

using Eigen::Vector3d;
using Point = std::array<double, 3>;

// A metric, and the space that its triangles are numbered in.
struct Metric {
  ContactSpace space;
  std::shared_ptr<const PenetrationMetric> metric;
};

Metric Phong(const ContactSpace& space, double smoothing_length,
             bool is_tangent_plane) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = smoothing_length;
  if (is_tangent_plane) options.field = FieldKind::kTangentPlane;
  const Computing computing;
  return {space, std::make_shared<const PhongMetric>(space, options)};
}

Metric Euclidean(const ContactSpace& space) {
  const Computing computing;
  return {space, std::make_shared<const EuclideanMetric>(space)};
}

Metric Smoothed(const ContactSpace& space, double smoothing_length,
                bool is_at_contact) {
  const auto at = is_at_contact ? SmoothedAt::kContact : SmoothedAt::kPosition;
  const Computing computing;
  return {space,
          std::make_shared<const SmoothedMetric>(space, smoothing_length, at)};
}

// Columns of one row a point; `tracked` carries the branch from row to row.
nb::dict Query(const Metric& metric, const Rows3& rows, bool is_tracked) {
  const size_t count = rows.shape(0);
  Column<unsigned char, 1> status(count), inside(count);
  Column<double, 1> signed_distance(count);
  Column<double, 3> contact(count), direction(count), gradient(count);
  Column<int, 1> triangle(count);
  {
    const Computing computing;
    const auto keep = [&](size_t i, const PenetrationResult& r) {
      status[i] = static_cast<unsigned char>(r.status);
      inside[i] = r.inside;
      signed_distance[i] = r.signed_distance;
      contact.Set(i, r.contact);
      direction.Set(i, r.direction);
      gradient.Set(i, r.gradient);
      triangle[i] = r.triangle;
    };
    if (is_tracked) {
      Branch branch;
      for (size_t i = 0; i < count; ++i) {
        const PenetrationResult r = metric.metric->Query(Row(rows, i), branch);
        branch = r.branch;
        keep(i, r);
      }
    } else {
      QueryBatch(
          *metric.metric, count, [&](size_t i) { return Row(rows, i); }, keep);
    }
  }
  nb::dict out;
  out["status"] = status.Array();
  out["inside"] = inside.Array();
  out["signed_distance"] = signed_distance.Array();
  out["contact"] = contact.Array();
  out["direction"] = direction.Array();
  out["gradient"] = gradient.Array();
  out["triangle"] = triangle.Array();
  return out;
}

// One answer, as short a way as there is: no arrays until they are asked for.
struct Answer {
  Vector3d point;
  PenetrationResult result;
};

Answer At(const Metric& metric, const Point& q, const Answer* after) {
  const Vector3d point(q[0], q[1], q[2]);
  // Microseconds: letting other threads run would cost as much.
  return {point,
          metric.metric->Query(
              point, after == nullptr ? Branch() : after->result.branch)};
}

}  // namespace

void BindMetrics(nb::module_& module) {
  module.attr("default_smoothing_length") = kDefaultSmoothingLength;
  nb::class_<Metric>(module, "Metric")
      .def_static("phong", &Phong)
      .def_static("euclidean", &Euclidean)
      .def_static("smoothed", &Smoothed)
      .def("query", &Query)
      .def("at", &At, nb::arg("q"), nb::arg("after").none());
  nb::class_<Answer>(module, "Answer")
      .def_prop_ro(
          "status",
          [](const Answer& a) { return static_cast<int>(a.result.status); })
      .def_prop_ro("inside", [](const Answer& a) { return a.result.inside; })
      .def_prop_ro("signed_distance",
                   [](const Answer& a) { return a.result.signed_distance; })
      .def_prop_ro("point", [](const Answer& a) { return ToArray(a.point); })
      .def_prop_ro("contact",
                   [](const Answer& a) { return ToArray(a.result.contact); })
      .def_prop_ro("direction",
                   [](const Answer& a) { return ToArray(a.result.direction); })
      .def_prop_ro("gradient",
                   [](const Answer& a) { return ToArray(a.result.gradient); })
      .def_prop_ro("penetration",
                   [](const Answer& a) {
                     return ToArray(a.result.PenetrationVector(a.point));
                   })
      .def_prop_ro("triangle",
                   [](const Answer& a) { return a.result.triangle; });
}

}  // namespace phongpd::python
