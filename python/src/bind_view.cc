// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <vector>

#include "constraints/rigid/rigid_motion.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/rigid_arrays.h"
#include "viewer/rigid_view.h"
#include "viewer/view_page.h"

namespace phongpd::python {
namespace {

using Picture = phongpd::View;  // View makes arrays here

TriangleMesh ToMesh(const Rows3& vertices, const Corners& triangles) {
  TriangleMesh mesh;
  mesh.vertices = ToPoints(vertices);
  mesh.triangles.resize(triangles.shape(0));
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) mesh.triangles[i][k] = triangles(i, k);
  }
  return mesh;
}

void AddMesh(Picture* view, const std::string& name, const std::string& role,
             const Rows3& vertices, const Corners& triangles) {
  ViewRole as = ViewRole::kMesh;
  for (const ViewRole one : {ViewRole::kObstacle, ViewRole::kContactSpace}) {
    if (role == ToString(one)) as = one;
  }
  view->meshes.push_back({name, as, ToMesh(vertices, triangles)});
}

void AddAnswer(Picture* view, const Rows3& points, const Rows4& orientation,
               const std::string& status, double depth, double clearance) {
  ViewAnswer answer;
  answer.position = Row(points, 0);
  answer.orientation = Eigen::Quaterniond(orientation(0, 0), orientation(0, 1),
                                          orientation(0, 2), orientation(0, 3));
  answer.status = status;
  answer.depth = depth;
  answer.clearance = clearance;
  answer.direction = Row(points, 1);
  answer.on_robot = Row(points, 2);
  answer.on_obstacle = Row(points, 3);
  answer.has_witness = true;
  view->answers.push_back(answer);
}

}  // namespace

// The page of a view, composed piece by piece.
void BindView(nb::module_& module) {
  nb::class_<Picture>(module, "View")
      .def("__init__",
           [](Picture* self, const std::string& title,
              const std::vector<std::string>& notes) {
             new (self) Picture();
             self->title = title;
             self->notes = notes;
           })
      .def("add_mesh", &AddMesh)
      .def("set_robot",
           [](Picture* view, const Rows3& vertices, const Corners& triangles) {
             view->robot = ToMesh(vertices, triangles);
           })
      .def("set_unit",
           [](Picture* view, const std::string& name) { view->unit = name; })
      .def("set_ends",
           [](Picture* view, const Rows3& ends) {
             view->start = Row(ends, 0);
             view->goal = Row(ends, 1);
           })
      .def("add_path",
           [](Picture* view, const std::string& name, const Rows3& points,
              bool is_free) {
             view->paths.push_back({name, ToPoints(points), is_free});
           })
      .def("set_turned_ends",
           [](Picture* view, const Poses& ends) {
             const RobotPose start = PoseOf(ToMatrix(ends, 0), "start");
             const RobotPose goal = PoseOf(ToMatrix(ends, 1), "goal");
             view->start = start.position;
             view->goal = goal.position;
             view->start_turn = start.orientation;
             view->goal_turn = goal.orientation;
           })
      .def("add_turning_path",
           [](Picture* view, const std::string& name, const Poses& poses,
              bool is_free) {
             std::vector<RobotPose> all;
             for (size_t i = 0; i < poses.shape(0); ++i) {
               all.push_back(PoseOf(ToMatrix(poses, i), name));
             }
             view->paths.push_back(RigidPath(name, all, is_free));
           })
      .def("add_answer", &AddAnswer)
      .def("page", [](const Picture& view, size_t most_triangles) {
        const Computing computing;
        return ViewPage(view, most_triangles);
      });
}

}  // namespace phongpd::python
