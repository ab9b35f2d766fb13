// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

namespace phongpd::python {

void BindSolid(nanobind::module_& module);
void BindContactSpace(nanobind::module_& module);
void BindPiece(nanobind::module_& module);
void BindMetrics(nanobind::module_& module);
void BindTracker(nanobind::module_& module);
void BindDepth(nanobind::module_& module);
void BindFleet(nanobind::module_& module);
void BindWorld(nanobind::module_& module);
void BindRemoval(nanobind::module_& module);
void BindRigid(nanobind::module_& module);
void BindRigidPlan(nanobind::module_& module);
void BindRows(nanobind::module_& module);
void BindSweeps(nanobind::module_& module);
void BindView(nanobind::module_& module);

}  // namespace phongpd::python
