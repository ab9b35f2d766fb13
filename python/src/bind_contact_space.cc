// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/string.h>

#include <chrono>
#include <future>
#include <memory>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_cache.h"
#include "core/mesh/mesh_io.h"
#include "core/minkowski/build_cancellation.h"
#include "core/solid/solid.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"

namespace phongpd::python {
namespace {

// work() on another thread, so that Ctrl-C reaches Python meanwhile: it stops
// the build and comes up as KeyboardInterrupt.
template <typename Work>
auto Interruptible(const Work& work) {
  const InProgress mark;
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
  ContactSpaceCache folder;
  if (cache) folder.directory = DefaultCacheDirectory();
  return Interruptible([&] {
    return BuildContactSpaceCached(robot, obstacle, options, folder);
  });
}

// The boundary of A ⊕ B: the contact space of −A and B.
ContactSpace Sum(const Solid& a, const Solid& b, double max_seconds,
                 double max_mib, bool cache) {
  TriangleMesh mesh = a.mesh();
  for (Eigen::Vector3d& v : mesh.vertices) v = -v;
  const Solid reflected = MakeSolid(Reversed(std::move(mesh)), a.name());
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

}  // namespace

void BindContactSpace(nb::module_& module) {
  nb::class_<ContactSpace>(module, "ContactSpace")
      .def_static("build", &Build)
      .def_static("sum", &Sum)
      .def_static("take",
                  [](const Solid& solid) {
                    return TakeAsContactSpace(solid, solid.name());
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
}

}  // namespace phongpd::python
