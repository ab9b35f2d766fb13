// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/operand.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/bounds/mesh_approximation.h"
#include "core/mesh/counted.h"
#include "core/solid/mesh_defects.h"
#include "core/solid/solid.h"

namespace phongpd::internal {
namespace {

// Bits of an operand's diagonal on the grid below which the user is told.
constexpr double kEnoughBits = 24.0;
// Coordinates beyond this many diagonals leave less than 24 bits of a double
// to the operand itself.
constexpr double kFarAway = 1e9;

std::string Rounded(double value) {
  std::ostringstream stream;
  stream.precision(3);
  stream << value;
  return stream.str();
}

const char* Described(ApproximationKind kind) {
  if (kind == ApproximationKind::kRobotHull) {
    return "replaced by its convex hull";
  }
  return kind == ApproximationKind::kAlphaWrap ? "wrapped" : "decimated";
}

std::string Sentence(const ApproximationStep& step) {
  std::string text = step.operand + ": " + Described(step.kind) + ", " +
                     std::to_string(step.triangles_before) + " to " +
                     Counted(step.triangles_after, "triangle") + ", at most " +
                     Rounded(step.bound) + " away";
  if (step.is_surface_bound) text += " from the surface it had";
  text += step.is_conservative
              ? "; encloses it, gaps narrower than about twice that may close"
              : "; gaps and walls narrower than about twice that may vanish or "
                "appear";
  return text;
}

void WarnIfFarAway(const Solid& solid, ContactSpaceReport* report) {
  const BoundingBox box = ComputeBounds(solid);
  const double farthest =
      box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
  if (!(farthest > kFarAway * box.Diagonal())) return;
  report->warnings.push_back(
      solid.name() + ": coordinates reach " +
      Rounded(farthest / box.Diagonal()) +
      " times its diagonal, where doubles are " +
      Rounded(std::ldexp(farthest, -52) / box.Diagonal()) +
      " of it apart; move it nearer to the origin");
}

// Replaces *solid and reports it.
void Apply(ApproximationKind kind, const ApproximateMesh& approximate,
           Solid* solid, ContactSpaceReport* report) {
  const std::string& name = solid->name();
  ApproximationStep step;
  step.operand = name;
  step.kind = kind;
  step.bound = approximate.bound;
  step.lower_bound = approximate.lower_bound;
  step.is_conservative = approximate.is_conservative;
  step.triangles_before = solid->mesh().triangles.size();
  step.triangles_after = approximate.mesh.triangles.size();
  AddStep(step, &report->approximation);
  report->warnings.push_back(Sentence(step));
  const int was = SurfaceGenus(*solid), is = SurfaceGenus(approximate.mesh);
  if (was != is) {
    report->warnings.push_back(name + ": the genus was " + std::to_string(was) +
                               " and is " + std::to_string(is) + " now");
  }
  if (!approximate.note.empty()) {
    report->warnings.push_back(name + ": " + approximate.note);
  }
  *solid = MakeSolid(approximate.mesh, name);
}

// Says when rounding by up to `step` is coarse for this operand; nothing when
// step is 0.
void CheckResolution(const GridSolid& solid, const Solid& given, double step,
                     ContactSpaceReport* report) {
  if (step == 0.0) return;  // nothing was rounded
  const TriangleMesh& mesh = given.mesh();
  const std::string& name = given.name();
  const double bits = std::log2(ComputeBounds(mesh).Diagonal() / step);
  const std::size_t facets = mesh.triangles.size() - solid.facets.size();
  std::vector<bool> used(solid.vertices.size(), false);
  std::vector<bool> was_used(mesh.vertices.size(), false);
  for (const Triangle& t : solid.facets) {
    for (const int v : t) used[v] = true;
  }
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) was_used[v] = true;
  }
  const auto count = [](const std::vector<bool>& flags) {
    return std::count(flags.begin(), flags.end(), true);
  };
  if (facets > 0 || bits < kEnoughBits) {
    std::ostringstream text;
    text.precision(3);
    text << name << ": coordinates are rounded to " << step << ", "
         << std::exp2(-bits) << " of its size, because the other operand is "
         << "larger; "
         << Counted(count(was_used) - count(used), "vertex", "vertices")
         << " and " << Counted(facets, "facet") << " collapsed";
    // Without a larger one the details are just too small.
    std::string line = text.str();
    if (bits > kGridBits - 2) {
      line = name + ": details below " + Rounded(step) + " (2^-38 of the " +
             "larger operand) are lost; " +
             Counted(count(was_used) - count(used), "vertex", "vertices") +
             " and " + Counted(facets, "facet") + " collapsed";
    }
    report->warnings.push_back(line);
  }
}

void RequireWrapAlpha(const ContactSpaceOptions& options) {
  if (options.wrap_alpha >= 0.0) return;  // no for NaN
  throw InputError("wrap alpha: expected a fraction of the diagonal, found " +
                   Rounded(options.wrap_alpha));
}

// By its hull and by fewer triangles, as asked for.
void Replace(bool is_robot, const ContactSpaceOptions& options, Solid* solid,
             ContactSpaceReport* report) {
  if (is_robot && options.robot_hull) {
    Apply(ApproximationKind::kRobotHull, ConvexHull(*solid), solid, report);
  }
  if (options.target_faces > 0) {
    Apply(ApproximationKind::kDecimation,
          Decimate(*solid, options.target_faces), solid, report);
  }
  WarnIfFarAway(*solid, report);
}

}  // namespace

ContactSpaceOptions WithNames(ContactSpaceOptions options, const Solid& robot,
                              const Solid& obstacle) {
  options.robot_name = robot.name();
  options.obstacle_name = obstacle.name();
  return options;
}

void AddStep(const ApproximationStep& step, Approximation* approximation) {
  approximation->steps.push_back(step);
  approximation->bound += step.bound;
  approximation->is_conservative &= step.is_conservative;
}

Solid PrepareOperand(const Solid& solid, OperandRole role,
                     const ContactSpaceOptions& options,
                     ContactSpaceReport* report) {
  const bool is_robot = role == OperandRole::kRobot;
  RequireNotEmpty(solid, is_robot ? "robot" : "obstacle");
  (is_robot ? report->robot : report->obstacle) = solid.report();
  RequireWrapAlpha(options);
  Solid prepared = solid;
  if (options.wrap_alpha > 0.0) {
    Apply(ApproximationKind::kAlphaWrap, WrapSolid(solid, options.wrap_alpha),
          &prepared, report);
  }
  Replace(is_robot, options, &prepared, report);
  return prepared;
}

Solid PrepareOperand(const TriangleMesh& mesh, OperandRole role,
                     const ContactSpaceOptions& options,
                     ContactSpaceReport* report) {
  RequireWrapAlpha(options);
  const bool is_robot = role == OperandRole::kRobot;
  const std::string& name =
      is_robot ? options.robot_name : options.obstacle_name;
  MeshReport& found = is_robot ? report->robot : report->obstacle;
  RepairReport& repaired =
      is_robot ? report->robot_repair : report->obstacle_repair;
  const double alpha =
      options.wrap_alpha > 0.0 ? options.wrap_alpha : kRepairAlpha;
  Solid solid =
      RepairSolid(mesh, name, options.repair, alpha, &found, &repaired);
  for (const std::string& line : repaired.actions) {
    report->warnings.push_back(name + ": " + line);
  }
  for (const std::string& line : NamedWarnings(found, name)) {
    report->warnings.push_back(line);
  }
  if (!repaired.is_wrapped) {
    return PrepareOperand(solid, role, options, report);
  }
  ApproximationStep step;
  step.operand = name;
  step.kind = ApproximationKind::kAlphaWrap;
  step.bound = repaired.wrap_bound;
  step.is_surface_bound = true;
  step.triangles_before = mesh.triangles.size();
  step.triangles_after = solid.mesh().triangles.size();
  AddStep(step, &report->approximation);
  report->warnings.push_back(Sentence(step));
  Replace(is_robot, options, &solid, report);
  return solid;
}

GridPair PlaceOperands(const Solid& robot, const Solid& obstacle,
                       LatticeDivisor divisor, ContactSpaceReport* report) {
  GridPair pair =
      MakeGridPair(robot, robot.name(), obstacle, obstacle.name(), divisor);
  const double resolution = std::min(pair.frame.rounding, pair.frame.step);
  CheckResolution(pair.obstacle, obstacle, resolution, report);
  CheckResolution(pair.reflected_robot, robot, resolution, report);
  return pair;
}

void RefuseLostFacets(const GridSolid& obstacle, const Solid& b,
                      const GridSolid& robot, const Solid& a, double step) {
  std::string names;
  if (robot.facets.size() < a.mesh().triangles.size()) names = a.name();
  if (obstacle.facets.size() < b.mesh().triangles.size()) {
    names += (names.empty() ? "" : " and ") + b.name();
  }
  if (names.empty()) return;
  throw InputError(names + ": too fine for the grid of " + Rounded(step) +
                   " (2^-38 of the larger operand); expected a solid after "
                   "rounding, found facets that collapsed and a contact space "
                   "that leaks; remove details below the grid or make the "
                   "operands more alike in size");
}

}  // namespace phongpd::internal
