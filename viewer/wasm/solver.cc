// SPDX-License-Identifier: GPL-3.0-or-later
// The planner of motions for the pages of the viewer, for robots that turn and
// for such as only translate: compiled to WebAssembly (wasm_module.cmake),
// called by solver.js.  All numbers are in the user's unit.
//
// Of planners/rigid it is all but two things that a page has not: threads, so
// that one portfolio races alone, and windows, so that the answer to an end
// that collides tells no depth.
#include <Eigen/Geometry>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "planners/rigid/end_depth.h"
#include "planners/rigid/rigid_plan.h"
#include "planners/rigid/rigid_portfolio.h"
#include "planners/rigid/rigid_race.h"
#include "planners/rigid/rigid_world.h"
#include "planners/world/path_status.h"
#include "viewer/drawn_poses.h"
#include "viewer/wasm/page_failure.h"

namespace phongpd {
namespace internal {

RaceEnd RacePortfolios(const RigidModel& model, const TreeTask& task,
                       std::uint64_t seed, int /*lanes*/, RigidStop* stop) {
  RigidPortfolio portfolio(model, task, seed, stop);
  RaceEnd end;
  end.seed = seed;
  if (portfolio.Search(stop)) {
    end.path = portfolio.path();
    end.planner = portfolio.planner();
  }
  end.checks = portfolio.checks();
  end.tests = portfolio.tests();
  end.nodes = portfolio.nodes();
  return end;
}

std::optional<double> DepthAtEnd(const RigidWorld& /*world*/,
                                 const RigidCheck& /*check*/,
                                 const RobotPose& /*pose*/) {
  return std::nullopt;
}

}  // namespace internal

namespace {

constexpr std::size_t kPoseNumbers = 7;  // x y z, then w x y z

// What the page has told and been told.
struct Solver {
  std::vector<TriangleMesh> robot, obstacles;
  std::unique_ptr<RigidWorld> world;
  RigidRequest request;
  RigidAnswer answer;
  std::vector<double> poses;
};

Solver& Only() {
  static Solver solver;
  return solver;
}

RobotPose PoseFrom(const double* numbers) {
  RobotPose pose;
  pose.position = {numbers[0], numbers[1], numbers[2]};
  pose.orientation =
      Eigen::Quaterniond(numbers[3], numbers[4], numbers[5], numbers[6]);
  return pose;
}

}  // namespace
}  // namespace phongpd

// Takes a mesh of the robot, or of the obstacles, of `vertices` × 3 coordinates
// and `triangles` × 3 indices, and frees both.
PAGE_EXPORT(add_mesh)
void AddMesh(int is_robot, double* coordinates, int vertices, int* indices,
             int triangles) {
  phongpd::TriangleMesh mesh;
  for (int v = 0; v < vertices; ++v) {
    mesh.vertices.emplace_back(coordinates[3 * v], coordinates[3 * v + 1],
                               coordinates[3 * v + 2]);
  }
  for (int t = 0; t < triangles; ++t) {
    mesh.triangles.push_back(
        {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]});
  }
  std::free(coordinates);
  std::free(indices);
  phongpd::Solver& solver = phongpd::Only();
  (is_robot != 0 ? solver.robot : solver.obstacles).push_back(std::move(mesh));
}

// Where the robot's origin may be: the two corners of a box, 6 numbers, which
// are freed.  Not called: the planner's default.
PAGE_EXPORT(set_bounds) void SetBounds(double* corners) {
  phongpd::Only().request.bounds = {Eigen::Vector3d(corners),
                                    Eigen::Vector3d(corners + 3)};
  std::free(corners);
}

// Plans from the first pose of `ends` to the second, 7 numbers each, and frees
// them.  True: there is a path; else reason() tells why not.
PAGE_EXPORT(plan)
int PlanInPage(double* ends, int turns, double seconds, int seed) {
  phongpd::Solver& solver = phongpd::Only();
  if (!solver.world) {
    solver.world =
        std::make_unique<phongpd::RigidWorld>(solver.robot, solver.obstacles);
  }
  phongpd::RigidRequest& request = solver.request;
  request.start = phongpd::PoseFrom(ends);
  request.goal = phongpd::PoseFrom(ends + phongpd::kPoseNumbers);
  request.time_limit = seconds;
  request.seed = static_cast<std::uint64_t>(seed);
  request.threads = 1;
  std::free(ends);
  solver.answer = turns != 0
                      ? phongpd::Plan(*solver.world, request)
                      : phongpd::PlanWithoutTurning(*solver.world, request);
  solver.poses.clear();
  for (const auto& pose : phongpd::DrawnPoses(solver.answer.path)) {
    const Eigen::Quaterniond& turn = pose.orientation;
    solver.poses.insert(
        solver.poses.end(),
        {pose.position.x(), pose.position.y(), pose.position.z(), turn.w(),
         turn.x(), turn.y(), turn.z()});
  }
  return solver.answer.IsSolved() ? 1 : 0;
}

// Of the last plan; texts and numbers are valid until the next one.
PAGE_EXPORT(status) const char* Status() {
  return phongpd::ToString(phongpd::Only().answer.status);
}
PAGE_EXPORT(reason) const char* Reason() {
  return phongpd::Only().answer.reason.c_str();
}
PAGE_EXPORT(planner) const char* Planner() {
  return phongpd::Only().answer.planner.c_str();
}
// To be drawn (drawn_poses.h).
PAGE_EXPORT(pose_count) int PoseCount() {
  return static_cast<int>(phongpd::Only().poses.size() / phongpd::kPoseNumbers);
}
PAGE_EXPORT(poses) const double* Poses() {
  return phongpd::Only().poses.data();
}
PAGE_EXPORT(length) double Length() { return phongpd::Only().answer.length; }
PAGE_EXPORT(clearance) double Clearance() {
  return phongpd::Only().answer.clearance.lower;
}
PAGE_EXPORT(took) double Took() { return phongpd::Only().answer.seconds; }
