// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "planners/rigid/optimizer/rigid_optimize.h"
#include "planners/rigid/rigid_plan.h"
#include "problems/output/rigid_row.h"
#include "problems/scenes/scene_source.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/interruptible.h"
#include "python/src/rigid_arrays.h"
#include "python/src/words.h"

namespace phongpd::python {
namespace {

// Of (2, 4, 4), start and goal; bounds of (2, 3) or (0, 3): none.
RigidRequest RequestOf(const Poses& ends, const Rows3& bounds,
                       double time_limit, std::uint64_t seed, int threads) {
  RigidRequest request;
  request.start = PoseOf(ToMatrix(ends, 0), "start");
  request.goal = PoseOf(ToMatrix(ends, 1), "goal");
  if (bounds.shape(0) == 2) request.bounds = {Row(bounds, 0), Row(bounds, 1)};
  request.time_limit = time_limit;
  request.seed = seed;
  request.threads = threads;
  return request;
}

nb::tuple ToTuple(const RigidAnswer& answer) {
  nb::object clearance = nb::none();
  if (HasFreePath(answer.status)) clearance = ClearanceRow(answer.clearance);
  return nb::make_tuple(ToString(answer.status), answer.reason,
                        PoseRows(answer.path), answer.length, answer.planner,
                        answer.seconds, clearance);
}

nb::list MeshRows(const std::vector<TriangleMesh>& meshes) {
  nb::list rows;
  for (const TriangleMesh& mesh : meshes) {
    std::vector<int> corners;
    for (const Triangle& t : mesh.triangles) {
      corners.insert(corners.end(), t.begin(), t.end());
    }
    rows.append(
        nb::make_tuple(ToArray(mesh.vertices),
                       Owned(std::move(corners), {mesh.triangles.size(), 3})));
  }
  return rows;
}

// Of a scene file or a family: the world, and what the scene says of it.
nb::tuple LoadTurning(const std::string& text) {
  const TurningScene scene = [&] {
    const Computing computing;
    const SceneSource source(text);
    if (!source.turns()) {
      throw InputError(text +
                       ": expected a scene of a robot that turns, found "
                       "another; World.load takes it");
    }
    return source.LoadTurning();
  }();
  const BoundingBox& box = scene.bounds;
  nb::object bounds = nb::none();
  if (!box.IsEmpty()) {
    bounds = ToArray(std::vector<Eigen::Vector3d>{box.min, box.max});
  }
  return nb::make_tuple(RigidWorldOf(scene), scene.name, scene.unit,
                        PoseRows({scene.start, scene.goal}), bounds,
                        scene.time_limit, Lines(scene.warnings));
}

nb::tuple PlanPoses(const RigidWorld& world, const Poses& ends,
                    const Rows3& bounds, double time_limit, std::uint64_t seed,
                    int threads) {
  RigidRequest request = RequestOf(ends, bounds, time_limit, seed, threads);
  return ToTuple(Interruptible([&](const std::atomic<bool>& is_asked) {
    request.is_interrupted = [&is_asked] { return is_asked.load(); };
    return Plan(world, request);
  }));
}

nb::tuple OptimizePoses(const RigidWorld& world, const Poses& ends,
                        const Rows3& bounds, double time_limit,
                        std::uint64_t seed, int threads,
                        const std::string& from, int knots, double margin,
                        double start_noise, bool is_tracked) {
  RigidOptimizeRequest request;
  request.task = RequestOf(ends, bounds, time_limit, seed, threads);
  request.from = ParseRigidStart(from, "start_from");
  request.knots = knots;
  request.margin = margin;
  request.start_noise = start_noise;
  request.is_tracked = is_tracked;
  const RigidOptimum found =
      Interruptible([&](const std::atomic<bool>& is_asked) {
        request.task.is_interrupted = [&is_asked] { return is_asked.load(); };
        return Optimize(world, request);
      });
  return nb::make_tuple(ToTuple(found.answer), ToString(found.solver),
                        found.is_confirmed, found.planned_length, found.rounds,
                        found.iterations, found.added_samples);
}

}  // namespace

void BindRigidPlan(nb::module_& module) {
  nb::class_<RigidWorld>(module, "RigidWorld")
      .def("__init__",
           [](RigidWorld* self, const Meshes& robot, const Meshes& obstacles) {
             const std::vector<TriangleMesh> moving = ToMeshes(robot);
             const std::vector<TriangleMesh> fixed = ToMeshes(obstacles);
             const Computing computing;
             new (self) RigidWorld(moving, fixed);
           })
      .def("plan", &PlanPoses)
      .def("optimize", &OptimizePoses)
      .def_prop_ro(
          "robot",
          [](const RigidWorld& world) { return MeshRows(world.robot()); })
      .def_prop_ro("obstacles", [](const RigidWorld& world) {
        return MeshRows(world.obstacles());
      });
  module.def("load_turning", &LoadTurning);
}

}  // namespace phongpd::python
