// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"

namespace phongpd::python {
namespace {

using Meshes = std::vector<std::pair<Rows3, Corners>>;
// Matrices, rows first.
using Poses = nb::ndarray<const double, nb::shape<-1, 4, 4>, nb::c_contig,
                          nb::device::cpu>;

std::vector<TriangleMesh> ToMeshes(const Meshes& arrays) {
  std::vector<TriangleMesh> meshes;
  for (const auto& [vertices, triangles] : arrays) {
    TriangleMesh mesh;
    mesh.vertices = ToPoints(vertices);
    for (size_t i = 0; i < triangles.shape(0); ++i) {
      mesh.triangles.push_back(
          {triangles(i, 0), triangles(i, 1), triangles(i, 2)});
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

Eigen::Isometry3d ToMatrix(const Poses& poses, size_t i) {
  Eigen::Isometry3d matrix = Eigen::Isometry3d::Identity();
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 4; ++column) {
      matrix.matrix()(static_cast<Eigen::Index>(row),
                      static_cast<Eigen::Index>(column)) =
          poses(i, row, column);
    }
  }
  return matrix;
}

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
