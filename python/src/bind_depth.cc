// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>

#include "core/contact/depth.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/words.h"

namespace phongpd::python {
namespace {

nb::tuple Feature(const ContactFeature& feature) {
  nb::list vertices;
  for (int k = 0; k < feature.kind; ++k) {
    vertices.append(feature.vertices[static_cast<size_t>(k)]);
  }
  return nb::make_tuple(ToString(feature.kind), nb::tuple(vertices));
}

// One row a pose; without orientations the robot keeps its own.
nb::dict At(const DepthQuery& query, const Rows3& positions,
            const std::optional<Rows4>& orientations) {
  const size_t count = positions.shape(0);
  std::vector<Depth> results(count);
  {
    const Computing computing;
    for (size_t i = 0; i < count; ++i) {
      RobotPose pose;
      pose.position = Row(positions, i);
      if (!orientations) {
        results[i] = query.At(pose.position);
        continue;
      }
      const Rows4& q = *orientations;
      pose.orientation = Eigen::Quaterniond(q(i, 0), q(i, 1), q(i, 2), q(i, 3));
      results[i] = query.At(pose);
    }
  }
  Column<double, 1> depth(count), clearance(count), radius(count),
      seconds(count), grid_step(count);
  Column<double, 3> direction(count), contact(count), on_robot(count),
      on_obstacle(count);
  Column<unsigned char, 1> certified(count);
  nb::list status, level, robot_feature, obstacle_feature;
  for (size_t i = 0; i < count; ++i) {
    const Depth& r = results[i];
    status.append(ToString(r.status));
    level.append(ToString(r.level));
    robot_feature.append(Feature(r.robot_feature));
    obstacle_feature.append(Feature(r.obstacle_feature));
    depth[i] = r.depth;
    clearance[i] = r.clearance;
    radius[i] = r.explored_radius;
    seconds[i] = r.seconds;
    grid_step[i] = r.grid_step;
    certified[i] = r.certified;
    direction.Set(i, r.direction);
    contact.Set(i, r.contact);
    on_robot.Set(i, r.on_robot);
    on_obstacle.Set(i, r.on_obstacle);
  }
  nb::dict out;
  out["status"] = status;
  out["depth"] = depth.Array();
  out["clearance"] = clearance.Array();
  out["direction"] = direction.Array();
  out["contact"] = contact.Array();
  out["on_robot"] = on_robot.Array();
  out["on_obstacle"] = on_obstacle.Array();
  out["robot_feature"] = robot_feature;
  out["obstacle_feature"] = obstacle_feature;
  out["certified"] = certified.Array();
  out["explored_radius"] = radius.Array();
  out["level"] = level;
  out["grid_step"] = grid_step.Array();
  out["seconds"] = seconds.Array();
  return out;
}

}  // namespace

void BindDepth(nb::module_& module) {
  nb::class_<DepthQuery>(module, "DepthQuery")
      .def("__init__",
           [](DepthQuery* self, const Solid& robot, const Solid& obstacle,
              double max_radius, double max_seconds) {
             DepthOptions options;
             options.max_radius = max_radius;
             options.max_seconds = max_seconds;
             const Computing computing;
             new (self) DepthQuery(robot, obstacle, options);
           })
      .def("at", &At, nb::arg("positions"),
           nb::arg("orientations").none() = nb::none())
      .def_prop_ro("warnings", [](const DepthQuery& query) {
        return Lines(query.warnings());
      });
}

}  // namespace phongpd::python
