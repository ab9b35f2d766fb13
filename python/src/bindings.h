// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <string>

#include "core/mesh/triangle_mesh.h"
#include "core/solid/mesh_check.h"

namespace phongpd::python {

// A checked solid (MakeSolid), shared and never changed.
struct Solid {
  std::shared_ptr<const TriangleMesh> mesh;
  std::string name;
  MeshReport report;
};

void BindSolid(nanobind::module_& module);
void BindContactSpace(nanobind::module_& module);
void BindMetrics(nanobind::module_& module);
void BindTracker(nanobind::module_& module);
void BindDepth(nanobind::module_& module);
void BindWorld(nanobind::module_& module);
void BindRows(nanobind::module_& module);
void BindSweeps(nanobind::module_& module);
void BindView(nanobind::module_& module);

}  // namespace phongpd::python
