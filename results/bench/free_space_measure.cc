// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/free_space_measure.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <utility>

#include "core/minkowski/build_refusal.h"
#include "core/solid/solid.h"
#include "core/stopwatch.h"
#include "planners/exact/free_space.h"
#include "planners/exact/verification.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "problems/studies/planning_study.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

// A small scanned knot that passes a larger one; both too thin for much of what
// their facets cut to be hidden in either.
Scene ScannedKnots() {
  Scene scene;
  scene.name = "scanned knots";
  scene.workspace.robot =
      MakeSolid(Rotated(MakeScan(MakeKnot(0.5, 0.06, 160, 16), 0.055, 0.002, 4),
                        GenericRotation()),
                "robot");
  scene.workspace.obstacles = {MakeSolid(
      MakeScan(MakeKnot(1.0, 0.12, 160, 16), 0.11, 0.004, 3), "knot")};
  scene.workspace.bounds = {Vector3d::Constant(-6.0), Vector3d::Constant(6.0)};
  scene.start = Vector3d::Constant(-4.0);
  scene.goal = Vector3d::Constant(4.0);
  return scene;
}

double MicrosecondsPer(std::size_t count, double start) {
  return 1e6 * (CpuSeconds() - start) /
         static_cast<double>(std::max<std::size_t>(1, count));
}

}  // namespace

double CpuSeconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

FreeSpaceRow MeasureFreeSpace(const std::string& name,
                              const TriangleMesh& robot,
                              const TriangleMesh& obstacle,
                              const ContactSpace& space, double full_seconds,
                              int segments, std::uint64_t seed) {
  FreeSpaceRow row;
  row.name = name;
  row.robot = robot.triangles.size();
  row.obstacle = obstacle.triangles.size();
  row.full_seconds = full_seconds;
  double start = CpuSeconds();
  const ConvolutionModel model(robot, obstacle);
  row.seconds = CpuSeconds() - start;
  row.facets = model.report().facets;
  const FreeSpace found = FreeSpace::OfConvolutions({model});
  const FreeSpace truth({space});

  std::mt19937_64 random(seed);
  std::vector<std::pair<Vector3d, Vector3d>> motions;
  for (int i = 0; i < segments; ++i) {
    const Vector3d a = RandomPoint(space.bounds(), &random);
    motions.emplace_back(a,
                         a + 0.2 * (RandomPoint(space.bounds(), &random) - a));
  }
  std::vector<char> is_free;
  start = CpuSeconds();
  for (const auto& [a, b] : motions) is_free.push_back(truth.IsFree(a, b));
  row.full_microseconds = MicrosecondsPer(motions.size(), start);
  row.segments = segments;
  start = CpuSeconds();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const bool free = found.IsFree(motions[i].first, motions[i].second);
    row.free += free ? 1 : 0;
    row.disagreements += free != (is_free[i] != 0) ? 1 : 0;
  }
  row.microseconds = MicrosecondsPer(motions.size(), start);
  const std::size_t compared = std::min<std::size_t>(1000, motions.size());
  for (std::size_t i = 0; i < compared; ++i) {
    const auto& [a, b] = motions[i];
    if (is_free[i] == 0) continue;
    row.worst_clearance =
        std::max(row.worst_clearance,
                 std::abs(found.Clearance(a, b) - truth.Clearance(a, b)) /
                     space.length());
  }
  return row;
}

NamedTable FreeSpaceTable(const std::vector<FreeSpaceRow>& rows) {
  return {"free_space.csv",
          MakeTable(
              "Free space from the convolution alone",
              "CPU time of a full build and of a `ConvolutionModel`, and "
              "of a motion check in either; random segments, of whose "
              "answers none may differ, and the clearance of the first "
              "thousand.",
              {"pair", "triangles of A", "triangles of B", "full build, CPU s",
               "convolution, CPU s", "share", "facets", "segments", "free",
               "disagreements", "worst clearance error / D",
               "check in full, CPU us", "in free space alone, CPU us"},
              rows, [](const FreeSpaceRow& r, const auto& add) {
                add(r.name, r.robot, r.obstacle, r.full_seconds, r.seconds,
                    r.seconds / r.full_seconds, r.facets, r.segments, r.free,
                    r.disagreements, r.worst_clearance, r.full_microseconds,
                    r.microseconds);
              })};
}

NamedTable LargePlanTable(double max_seconds) {
  SilenceOmpl();
  Scene scene = ScannedKnots();
  scene.planning.model = "window";
  PlanningStudy study(scene);
  double start = CpuSeconds();
  const Stopwatch stopwatch;
  const PlanningResult result = study.Run({});
  const double cpu = CpuSeconds() - start, wall = stopwatch.Seconds();
  const Verification judged =
      Verifier(scene.workspace).VerifyPath(result.numbers.path);

  const World limited(scene.workspace, scene.name, {}, {max_seconds, 0.0});
  std::string whole = "built";
  start = CpuSeconds();
  try {
    limited.Spaces(SpaceLayout::kSealed);
  } catch (const BuildRefusal& refusal) {
    const std::string what = refusal.what();
    whole = what.substr(0, what.find(';'));
  }
  const std::vector<int> one = {0};
  return {"large_plan.csv",
          MakeTable("A motion where the whole contact space is too much",
                    "By `rrt-connect` with model window, judged again on the "
                    "original solids; and what a full build that is limited "
                    "to " +
                        Rounded(max_seconds) +
                        " s of wall time says, and its CPU time until then.",
                    {"scene", "triangles of A", "triangles of B", "facets",
                     "CPU s", "wall s", "answer", "verified", "points",
                     "clearance", "full build", "its CPU s"},
                    one, [&](int, const auto& add) {
                      add(scene.name,
                          scene.workspace.robot.mesh().triangles.size(),
                          scene.workspace.obstacles[0].mesh().triangles.size(),
                          study.world().Convolution().facets, cpu, wall,
                          result.status, std::string(ToString(judged.verdict)),
                          result.numbers.path.size(), result.numbers.clearance,
                          whole, CpuSeconds() - start);
                    })};
}

}  // namespace phongpd::bench
