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

// And was it decided exactly, of a quaternion that is linear?
struct Judged {
  RigidCheck check;
  bool is_exact = false;
};

nb::tuple Row(const Judged& judged) {
  const RigidCheck& check = judged.check;
  return nb::make_tuple(
      ToString(check.outcome), check.time, check.from, check.to,
      nb::make_tuple(check.robot_mesh, check.robot_triangle),
      nb::make_tuple(check.obstacle_mesh, check.obstacle_triangle), check.tests,
      judged.is_exact);
}

Judged Judge(const RigidJudge& judge, const RobotPose& start,
             const RobotPose& end, bool exact) {
  Judged judged{judge.Check({start, end})};
  if (exact && judged.check.outcome == MotionVerdict::kUndecided) {
    judged = {judge.CheckExactly(QuaternionMotion::Between(start, end)), true};
  }
  return judged;
}

std::vector<RobotPose> WayOf(const Poses& poses,
                             const std::vector<std::string>& names) {
  std::vector<RobotPose> way;
  for (size_t i = 0; i < poses.shape(0); ++i) {
    way.push_back(PoseOf(ToMatrix(poses, i), names.at(i)));
  }
  return way;
}

// The way through the poses, a row for each motion of it.
nb::list Check(const RigidJudge& judge, const Poses& poses,
               const std::vector<std::string>& names, bool exact) {
  std::vector<Judged> judged;
  {
    const Computing computing;
    const std::vector<RobotPose> way = WayOf(poses, names);
    for (size_t i = 1; i < way.size(); ++i) {
      judged.push_back(Judge(judge, way[i - 1], way[i], exact));
    }
  }
  nb::list rows;
  for (const Judged& one : judged) rows.append(Row(one));
  return rows;
}

nb::tuple Clearance(const RigidJudge& judge, const Poses& poses,
                    const std::vector<std::string>& names, double relative,
                    double absolute) {
  RigidClearance found;
  {
    const Computing computing;
    found = judge.PathClearance(WayOf(poses, names), {relative, absolute});
  }
  return ClearanceRow(found);
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
      .def("clearance", &Clearance)
      .def("first_hit", &FirstHit);
}

}  // namespace phongpd::python
