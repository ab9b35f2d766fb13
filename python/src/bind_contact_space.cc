// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/string.h>

#include <chrono>
#include <future>
#include <memory>
#include <optional>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_cache.h"
#include "core/mesh/mesh_io.h"
#include "core/minkowski/build_cancellation.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "core/projection/query_batch.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"

namespace phongpd::python {
namespace {

// work() on another thread, so that Ctrl-C reaches Python meanwhile: it stops
// the build and comes up as KeyboardInterrupt.
template <typename Work>
auto Interruptible(const Work& work) {
  auto result = std::async(std::launch::async, work);
  const auto is_done = [&result] {
    const nb::gil_scoped_release release;
    return result.wait_for(std::chrono::milliseconds(50)) ==
           std::future_status::ready;
  };
  while (!is_done()) {
    if (PyErr_CheckSignals() == 0) continue;
    nb::python_error error;
    // It may only be about to begin.
    do CancelBuilds();
    while (!is_done());
    throw error;
  }
  return result.get();
}

ContactSpace Build(const Solid& robot, const Solid& obstacle, bool robot_hull,
                   size_t target_faces, double wrap, bool outer_shell_only,
                   double max_seconds, double max_mib, bool cache) {
  ContactSpaceOptions options;
  options.robot_hull = robot_hull;
  options.target_faces = target_faces;
  options.wrap_alpha = wrap;
  options.outer_shell_only = outer_shell_only;
  options.max_seconds = max_seconds;
  options.max_mib = max_mib;
  options.robot_name = robot.name;
  options.obstacle_name = obstacle.name;
  ContactSpaceCache folder;
  if (cache) folder.directory = DefaultCacheDirectory();
  return Interruptible([&] {
    return BuildContactSpaceCached(*robot.mesh, *obstacle.mesh, options,
                                   folder);
  });
}

// The boundary of A ⊕ B: the contact space of −A and B.
ContactSpace Sum(const Solid& a, const Solid& b, double max_seconds,
                 double max_mib, bool cache) {
  Solid reflected = a;
  TriangleMesh mesh = *a.mesh;
  for (Eigen::Vector3d& v : mesh.vertices) v = -v;
  reflected.mesh =
      std::make_shared<const TriangleMesh>(Reversed(std::move(mesh)));
  return Build(reflected, b, false, 0, 0.0, false, max_seconds, max_mib, cache);
}

nb::dict Report(const ContactSpace& space) {
  const ContactSpaceReport& report = space.report();
  nb::dict seconds, out;
  for (const auto& [stage, time] : report.seconds)
    seconds[stage.c_str()] = time;
  nb::list warnings;
  for (const std::string& line : report.warnings) warnings.append(line);
  out["triangles"] = report.triangles;
  out["vertices"] = report.vertices;
  out["closed"] = report.closed;
  out["manifold"] = report.manifold;
  out["components"] = report.components;
  out["genus"] = report.genus;
  out["cavities"] = report.cavities;
  out["volume"] = report.volume;
  out["self_intersections"] = report.self_intersections;
  out["method"] = report.method;
  out["from_cache"] = report.from_cache;
  out["grid_step"] = report.grid_step;
  out["approximation"] = report.approximation.kind;
  out["approximation_bound"] = report.approximation.bound;
  out["seconds"] = seconds;
  out["peak_mib"] = report.peak_mib;
  out["warnings"] = warnings;
  return out;
}

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
  const nb::gil_scoped_release release;
  return {space, std::make_shared<const PhongMetric>(space, options)};
}

Metric Euclidean(const ContactSpace& space) {
  const nb::gil_scoped_release release;
  return {space, std::make_shared<const EuclideanMetric>(space)};
}

// Columns of one row a point; `tracked` carries the branch from row to row.
nb::dict Query(const Metric& metric, const Rows3& rows, bool is_tracked) {
  const size_t count = rows.shape(0);
  Column<unsigned char, 1> status(count), inside(count);
  Column<double, 1> signed_distance(count);
  Column<double, 3> contact(count), direction(count), gradient(count);
  Column<int, 1> triangle(count);
  {
    const nb::gil_scoped_release release;
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
      // Answers are 200 bytes each: not all at once.
      constexpr size_t kBlock = 4096;
      std::vector<Eigen::Vector3d> points;
      std::vector<PenetrationResult> results(std::min(count, kBlock));
      for (size_t begin = 0; begin < count; begin += kBlock) {
        const size_t size = std::min(kBlock, count - begin);
        points.resize(size);
        for (size_t i = 0; i < size; ++i) points[i] = Row(rows, begin + i);
        QueryBatch(*metric.metric, points.data(), size, results.data());
        for (size_t i = 0; i < size; ++i) keep(begin + i, results[i]);
      }
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

// Columns of one row a step of the motion, from the state as it is.
nb::dict Follow(const PenetrationTracker& tracker,
                PenetrationTracker::State* state, const Rows3& rows) {
  const size_t count = rows.shape(0);
  Column<unsigned char, 1> status(count), inside(count);
  Column<double, 1> depth(count), euclidean(count), ratio(count), moved(count);
  Column<double, 3> pd(count), contact(count);
  Column<int, 1> triangle(count);
  {
    const nb::gil_scoped_release release;
    for (size_t i = 0; i < count; ++i) {
      const TrackerResult r = tracker.Step(Row(rows, i), state);
      status[i] = static_cast<unsigned char>(r.status);
      inside[i] = r.inside;
      depth[i] = r.magnitude;
      euclidean[i] = r.euclidean_depth;
      ratio[i] = r.ratio;
      moved[i] = r.moved;
      pd.Set(i, r.pd);
      contact.Set(i, r.contact);
      triangle[i] = r.triangle;
    }
  }
  nb::dict out;
  out["status"] = status.Array();
  out["inside"] = inside.Array();
  out["penetration"] = pd.Array();
  out["depth"] = depth.Array();
  out["euclidean_depth"] = euclidean.Array();
  out["ratio"] = ratio.Array();
  out["moved"] = moved.Array();
  out["contact"] = contact.Array();
  out["triangle"] = triangle.Array();
  return out;
}

}  // namespace

void BindContactSpace(nb::module_& module) {
  nb::class_<ContactSpace>(module, "ContactSpace")
      .def_static("build", &Build)
      .def_static("sum", &Sum)
      .def_static("take",
                  [](const Solid& solid) {
                    return TakeAsContactSpace(*solid.mesh, solid.name);
                  })
      .def("write",
           [](const ContactSpace& space, const std::string& path) {
             WriteMesh(space.mesh(), path);
           })
      .def_prop_ro("vertices",
                   [](nb::handle self) {
                     return View(
                         nb::cast<const ContactSpace&>(self).mesh().vertices,
                         self);
                   })
      .def_prop_ro("triangles",
                   [](nb::handle self) {
                     return View(
                         nb::cast<const ContactSpace&>(self).mesh().triangles,
                         self);
                   })
      .def_prop_ro("length", [](const ContactSpace& s) { return s.length(); })
      .def_prop_ro("report", &Report);
  nb::class_<Metric>(module, "Metric")
      .def_static("phong", &Phong)
      .def_static("euclidean", &Euclidean)
      .def("query", &Query);
  nb::class_<PenetrationTracker::State>(module, "TrackerState")
      .def(nb::init<>());
  nb::class_<PenetrationTracker>(module, "PenetrationTracker")
      .def("__init__",
           [](PenetrationTracker* self, const ContactSpace& space, double ratio,
              double speed) {
             PenetrationTrackerOptions options;
             options.ratio = ratio;
             options.speed = speed;
             const nb::gil_scoped_release release;
             new (self) PenetrationTracker(space, options);
           })
      .def("follow", &Follow);
}

}  // namespace phongpd::python
