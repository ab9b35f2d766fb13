// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/rigid_arrays.h"

namespace phongpd::python {
namespace {

nb::tuple Row(const RigidCheck& check) {
  return nb::make_tuple(
      ToString(check.outcome), check.time, check.from, check.to,
      nb::make_tuple(check.robot_mesh, check.robot_triangle),
      nb::make_tuple(check.obstacle_mesh, check.obstacle_triangle),
      check.tests);
}

// The way through the poses, a row for each motion of it.
nb::list Check(const RigidJudge& judge, const Poses& poses,
               const std::vector<std::string>& names) {
  std::vector<RigidCheck> checks;
  {
    const Computing computing;
    std::vector<RobotPose> way;
    for (size_t i = 0; i < poses.shape(0); ++i) {
      way.push_back(PoseOf(ToMatrix(poses, i), names.at(i)));
    }
    for (size_t i = 1; i < way.size(); ++i) {
      checks.push_back(judge.Check({way[i - 1], way[i]}));
    }
  }
  nb::list rows;
  for (const RigidCheck& check : checks) rows.append(Row(check));
  return rows;
}

nb::tuple FirstHit(const RigidJudge& judge, const Poses& poses,
                   const std::vector<std::string>& names, double resolution) {
  RigidFirstHit hit;
  {
    const Computing computing;
    hit = judge.FirstHit({PoseOf(ToMatrix(poses, 0), names.at(0)),
                          PoseOf(ToMatrix(poses, 1), names.at(1))},
                         resolution);
  }
  return nb::make_tuple(
      ToString(hit.outcome), hit.from, hit.to,
      nb::make_tuple(hit.robot_mesh, hit.robot_triangle),
      nb::make_tuple(hit.obstacle_mesh, hit.obstacle_triangle), hit.tests);
}

}  // namespace

void BindRigid(nb::module_& module) {
  nb::class_<RigidJudge>(module, "RigidJudge")
      .def("__init__",
           [](RigidJudge* self, const Meshes& robot, const Meshes& obstacles) {
             const std::vector<TriangleMesh> moving = ToMeshes(robot);
             const std::vector<TriangleMesh> fixed = ToMeshes(obstacles);
             const Computing computing;
             new (self) RigidJudge(moving, fixed);
           })
      .def("check", &Check)
      .def("first_hit", &FirstHit);
}

}  // namespace phongpd::python
