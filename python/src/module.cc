// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd._native: the library as the Python files of the package need it.
// Arguments come checked and of the right type from there; what users read is
// written there, too.
#include <nanobind/nanobind.h>

#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "planners/ompl/ompl_planning.h"
#include "python/src/bindings.h"

NB_MODULE(_native, module) {
  namespace nb = nanobind;
  // A notebook's kernel ends with everything alive.
  nb::set_leak_warnings(false);
  const auto input_error = nb::exception<phongpd::InputError>(
      module, "InputError", PyExc_ValueError);
  // After its base, so that it is tried before it.
  nb::exception<phongpd::BuildRefusal>(module, "BuildRefusal", input_error);
  nb::exception<phongpd::BuildCancelled>(module, "BuildCancelled");
  module.attr("__version__") = PHONGPD_VERSION;
  phongpd::SilenceOmpl();
  phongpd::python::BindSolid(module);
  phongpd::python::BindContactSpace(module);
  phongpd::python::BindPiece(module);
  phongpd::python::BindMetrics(module);
  phongpd::python::BindTracker(module);
  phongpd::python::BindDepth(module);
  phongpd::python::BindWorld(module);
  phongpd::python::BindRemoval(module);
  phongpd::python::BindFleet(module);
  phongpd::python::BindRigid(module);
  phongpd::python::BindRigidPlan(module);
  phongpd::python::BindRows(module);
  phongpd::python::BindSweeps(module);
  phongpd::python::BindView(module);
}
