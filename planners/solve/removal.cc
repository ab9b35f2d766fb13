// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "constraints/rigid/rigid_judge.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/solid/shrunk_solid.h"
#include "core/stopwatch.h"
#include "planners/solve/plan.h"
#include "planners/solve/turning_removal.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Beside the rest there is as much room as this share of both sizes.
constexpr double kRoom = 0.05;

// The translations along an axis, up and down, after which the boxes are apart
// by that room.
std::array<double, 2> WaysAlong(int axis, const BoundingBox& part,
                                const BoundingBox& rest) {
  const double room = kRoom * (part.Diagonal() + rest.Diagonal());
  return {rest.max[axis] - part.min[axis] + room,
          rest.min[axis] - part.max[axis] - room};
}

// The translations along one axis after which the boxes are apart, the least
// first; none at all where they are.
std::vector<Vector3d> WaysOut(const BoundingBox& part,
                              const BoundingBox& rest) {
  std::vector<Vector3d> ways;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [up, down] = WaysAlong(axis, part, rest);
    if (up <= 0.0 || down >= 0.0) return {Vector3d::Zero()};
    ways.emplace_back(up * Vector3d::Unit(axis));
    ways.emplace_back(down * Vector3d::Unit(axis));
  }
  std::stable_sort(
      ways.begin(), ways.end(),
      [](const Vector3d& a, const Vector3d& b) { return a.norm() < b.norm(); });
  return ways;
}

// The path as far as it takes to be beside the rest on any side.  Requires one
// that begins elsewhere.
Path UntilBeside(const Path& path, const BoundingBox& part,
                 const BoundingBox& rest) {
  Path way = {path.front()};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d step = path[i + 1] - path[i];
    double first = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (step[axis] == 0.0) continue;
      const auto [up, down] = WaysAlong(axis, part, rest);
      const double end = step[axis] > 0.0 ? up : down;
      const double t = (end - path[i][axis]) / step[axis];
      if (t >= 0.0) first = std::min(first, t);
    }
    way.push_back(first < 1.0 ? Vector3d(path[i] + first * step) : path[i + 1]);
    if (first < 1.0) break;
  }
  return way;
}

BoundingBox BoxOf(const std::vector<Solid>& solids) {
  BoundingBox all = ComputeBounds(solids.front());
  for (const Solid& solid : solids) {
    const BoundingBox box = ComputeBounds(solid);
    all.min = all.min.cwiseMin(box.min);
    all.max = all.max.cwiseMax(box.max);
  }
  return all;
}

// By names of their own, which a world needs: the second pin is "pin (2)".
std::vector<Solid> ToldApart(const std::vector<Solid>& solids) {
  std::vector<Solid> told;
  std::set<std::string> names;
  for (const Solid& solid : solids) {
    std::string name = solid.name();
    for (int i = 2; !names.insert(name).second; ++i) {
      name = solid.name() + " (" + std::to_string(i) + ')';
    }
    told.push_back(solid.Named(name));
  }
  return told;
}

// Not only smaller but within the part, or less was granted than is said: the
// surfaces are apart, and one holds the other.
void RequireWithin(const Solid& shrunk, const Solid& part) {
  const RigidMotion rest(RobotPose{}, RobotPose{});
  // Inside out it bounds nothing: its triangles alone are judged.
  const bool are_apart =
      RigidJudge(shrunk, Reversed(part.mesh())).Check(rest).IsFree();
  if (are_apart && !RigidJudge(shrunk, part).Check(rest).IsFree()) return;
  throw InputError("tolerance: expected " + part.name() +
                   " to stay within itself when it is drawn in, found that it "
                   "does not; take a smaller one");
}

// Whatever side a way leads to, it is out: of all sides the shortest.  Without
// a way to one there is none to another, for all are in one cell.
PathAnswer ShortestWayOut(const World& world, const BoundingBox& part,
                          const BoundingBox& rest, bool verifies) {
  PathAnswer best;
  for (const Vector3d& goal : WaysOut(part, rest)) {
    // To get there is longer, and to all that follow.
    if (!best.path.empty() && goal.norm() >= best.length) break;
    PlanRequest request;
    request.goal = goal;
    request.verifies = verifies;
    PathAnswer answer = Plan(world, request);
    if (!answer.is_solved) {
      // A way that was found stays one; what refutes another is a fault.
      const bool is_fault = answer.status == PathStatus::kVerificationFailed;
      return best.path.empty() || is_fault ? answer : best;
    }
    Path way = UntilBeside(answer.path, part, rest);
    // Its end is rounded: judged again.
    if (CheckPath(*answer.evidence.free_space, way).free) {
      answer.path = std::move(way);
    }
    answer.length = PathLength(answer.path);
    if (best.path.empty() || answer.length < best.length) {
      best = std::move(answer);
    }
  }
  return best;
}

// The first of those left that comes out is a step; else all are stuck.
bool TakeOut(const std::vector<Solid>& parts,
             const std::vector<std::size_t>& left,
             const RemovalOptions& options, Disassembly* answer) {
  answer->stuck.clear();
  for (const std::size_t part : left) {
    std::vector<Solid> rest;
    for (const std::size_t i : left) {
      if (i != part) rest.push_back(parts[i]);
    }
    Disassembly::Step step{part, RemovePart(parts[part], rest, options)};
    if (step.removal.IsOut()) {
      answer->steps.push_back(std::move(step));
      answer->stuck.clear();
      return true;
    }
    answer->stuck.push_back(std::move(step));
  }
  return false;
}

}  // namespace

void RemovalOptions::Validate() const {
  if (!(std::isfinite(tolerance) && tolerance >= 0.0)) {
    throw InputError("tolerance: expected a number >= 0, found " +
                     FormatDouble(tolerance));
  }
  if (!(turn_seconds >= 0.0 && turn_seconds <= 1e9)) {
    throw InputError("turn_seconds: expected seconds in [0, 1e9], found " +
                     FormatDouble(turn_seconds));
  }
}

Removal RemovePart(const Solid& part, const std::vector<Solid>& rest,
                   const RemovalOptions& options) {
  const Stopwatch stopwatch;
  options.Validate();
  if (rest.empty()) {
    throw InputError(part.name() +
                     ": expected parts that it is among, found "
                     "none");
  }
  Removal removal;
  Workspace workspace;
  workspace.robot = part;
  workspace.obstacles = ToldApart(rest);
  if (options.tolerance > 0.0) {
    const ShrunkSolid shrunk = Shrunk(part, options.tolerance);
    RequireWithin(shrunk.solid, part);
    workspace.robot = shrunk.solid;
    removal.granted_least = shrunk.least;
    removal.granted_most = shrunk.most;
  }
  PathAnswer answer =
      ShortestWayOut(World(workspace, part.name()), ComputeBounds(part),
                     BoxOf(rest), options.verifies);
  removal.status = answer.status;
  removal.reason = std::move(answer.reason);
  removal.path = std::move(answer.path);
  removal.length = answer.length;
  removal.clearance = answer.clearance;
  removal.needs_turns = answer.status == PathStatus::kInfeasibleProved;
  if (removal.needs_turns && options.turn_seconds > 0.0) {
    internal::RemoveByTurning(workspace.robot, rest, options.turn_seconds,
                              &removal);
  }
  removal.seconds = stopwatch.Seconds();
  return removal;
}

bool Disassembly::IsProved() const {
  return std::all_of(stuck.begin(), stuck.end(), [](const Step& step) {
    return step.removal.status == PathStatus::kInfeasibleProved;
  });
}

Disassembly Disassemble(const std::vector<Solid>& parts,
                        const RemovalOptions& options) {
  const Stopwatch stopwatch;
  if (parts.size() < 2) {
    throw InputError("parts: expected at least 2, found " +
                     std::to_string(parts.size()));
  }
  Disassembly answer;
  std::vector<std::size_t> left(parts.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  // Turns cost their time in vain where another part comes out without.
  RemovalOptions quick = options;
  quick.turn_seconds = 0.0;
  while (left.size() > 1) {
    bool is_any_out = TakeOut(parts, left, quick, &answer);
    if (!is_any_out && options.turn_seconds > 0.0) {
      is_any_out = TakeOut(parts, left, options, &answer);
    }
    if (!is_any_out) break;
    left.erase(std::find(left.begin(), left.end(), answer.steps.back().part));
  }
  answer.seconds = stopwatch.Seconds();
  return answer;
}

}  // namespace phongpd
