// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <vector>

#include "planners/solve/removal.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/interruptible.h"
#include "python/src/rigid_arrays.h"

namespace phongpd::python {
namespace {

nb::tuple Row(std::size_t part, const Removal& removal) {
  return nb::make_tuple(
      part, ToString(removal.status), removal.reason, ToArray(removal.path),
      PoseRows(removal.poses), ToArray(removal.pivot), removal.needs_turns,
      removal.length, removal.clearance, removal.granted_least,
      removal.granted_most, removal.seconds);
}

nb::list Rows(const std::vector<Disassembly::Step>& steps) {
  nb::list rows;
  for (const Disassembly::Step& step : steps) {
    rows.append(Row(step.part, step.removal));
  }
  return rows;
}

}  // namespace

void BindRemoval(nb::module_& module) {
  module.def("remove", [](const Solid& part, const std::vector<Solid>& rest,
                          double tolerance, bool verify, double turn_seconds) {
    const Removal removal = Interruptible([&] {
      return RemovePart(part, rest, {tolerance, verify, turn_seconds});
    });
    return Row(0, removal);
  });
  module.def("disassemble",
             [](const std::vector<Solid>& parts, double tolerance, bool verify,
                double turn_seconds) {
               const Disassembly answer = Interruptible([&] {
                 return Disassemble(parts, {tolerance, verify, turn_seconds});
               });
               return nb::make_tuple(Rows(answer.steps), Rows(answer.stuck));
             });
}

}  // namespace phongpd::python
