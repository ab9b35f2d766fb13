// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "core/mesh/mesh_io.h"
#include "core/solid/solid.h"
#include "problems/meshes/any_mesh.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/words.h"

namespace phongpd::python {
namespace {

Solid FromArrays(const Rows3& vertices, const Corners& triangles,
                 const std::string& name) {
  TriangleMesh mesh;
  mesh.vertices = ToPoints(vertices);
  mesh.triangles.resize(triangles.shape(0));
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) mesh.triangles[i][k] = triangles(i, k);
  }
  const Computing computing;
  return MakeSolid(mesh, name);
}

// And what there is to know of the file.
std::pair<Solid, std::vector<std::string>> Read(const std::string& path,
                                                const std::string& name) {
  const Computing computing;
  std::vector<std::string> notes;
  Solid solid = MakeSolid(ReadAnyMesh(path, &notes), name);
  return {std::move(solid), Lines(std::move(notes))};
}

}  // namespace

void BindSolid(nb::module_& module) {
  nb::class_<Solid>(module, "Solid")
      .def_static("from_arrays", &FromArrays)
      .def_static("read", &Read)
      .def("write", [](const Solid& solid,
                       const std::string& path) { WriteMesh(solid, path); })
      .def_prop_ro("name", [](const Solid& solid) { return solid.name(); })
      .def_prop_ro("vertices",
                   [](nb::handle self) {
                     return View(nb::cast<const Solid&>(self).mesh().vertices,
                                 self);
                   })
      .def_prop_ro("triangles",
                   [](nb::handle self) {
                     return View(nb::cast<const Solid&>(self).mesh().triangles,
                                 self);
                   })
      .def_prop_ro("volume",
                   [](const Solid& solid) { return solid.report().volume; })
      .def_prop_ro("components",
                   [](const Solid& solid) { return solid.report().components; })
      .def_prop_ro("warnings", [](const Solid& solid) {
        return Lines(NamedWarnings(solid.report(), solid.name()));
      });
}

}  // namespace phongpd::python
