// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/string.h>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_cache.h"
#include "core/contact/contact_space_file.h"
#include "core/mesh/mesh_io.h"
#include "core/solid/solid.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/build_options.h"
#include "python/src/interruptible.h"
#include "python/src/words.h"

namespace phongpd::python {
namespace {

ContactSpace Build(const Solid& robot, const Solid& obstacle, bool robot_hull,
                   size_t target_faces, double wrap, bool outer_shell_only,
                   double max_seconds, double max_mib, bool cache) {
  const ContactSpaceOptions options = BuildOptions(
      robot_hull, target_faces, wrap, outer_shell_only, max_seconds, max_mib);
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

void Write(const ContactSpace& space, const std::string& path) {
  const Computing computing;
  if (NamesContactSpaceFile(path)) {
    WriteContactSpace(space, path);
  } else {
    WriteMesh(space.mesh(), path);
  }
}

ContactSpace Read(const std::string& path) {
  const Computing computing;
  return ReadContactSpace(path);
}

nb::dict Report(const ContactSpace& space) {
  const ContactSpaceReport& report = space.report();
  nb::dict seconds, out;
  for (const auto& [stage, time] : report.seconds) {
    seconds[OneLine(stage).c_str()] = time;
  }
  nb::list warnings;
  for (const std::string& line : Lines(report.warnings)) warnings.append(line);
  out["triangles"] = report.triangles;
  out["vertices"] = report.vertices;
  out["closed"] = report.closed;
  out["manifold"] = report.manifold;
  out["components"] = report.components;
  out["genus"] = report.genus;
  out["cavities"] = report.cavities;
  out["volume"] = report.volume;
  out["self_intersections"] = report.self_intersections;
  out["method"] = OneLine(report.method);
  out["from_cache"] = report.from_cache;
  out["grid_step"] = report.grid_step;
  out["approximation"] = OneLine(KindsOf(report.approximation));
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
      .def_static("read", &Read)
      .def("write", &Write)
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
