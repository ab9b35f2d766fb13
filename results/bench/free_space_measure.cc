// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/free_space_measure.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "constraints/free_space.h"
#include "problems/shapes/random_solids.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

double MicrosecondsPer(std::size_t count, double start) {
  return 1e6 * (CpuSeconds() - start) /
         static_cast<double>(std::max<std::size_t>(1, count));
}

using AskedMotion = std::pair<Vector3d, Vector3d>;

// From points of the space's box, a fifth of the way to others.
std::vector<AskedMotion> RandomMotions(const ContactSpace& space, int count,
                                       std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<AskedMotion> motions;
  for (int i = 0; i < count; ++i) {
    const Vector3d a = RandomPoint(space.bounds(), &random);
    motions.emplace_back(a,
                         a + 0.2 * (RandomPoint(space.bounds(), &random) - a));
  }
  return motions;
}

// Asks free space of all motions; microseconds of each.  Counts in the row how
// many are free, and how many answers are not those given.
double CompareMotions(const FreeSpace& found,
                      const std::vector<AskedMotion>& motions,
                      const std::vector<char>& is_free, FreeSpaceRow* row) {
  row->free = row->disagreements = 0;
  const double start = CpuSeconds();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const bool free = found.IsFree(motions[i].first, motions[i].second);
    row->free += free ? 1 : 0;
    row->disagreements += free != (is_free[i] != 0) ? 1 : 0;
  }
  return MicrosecondsPer(motions.size(), start);
}

// Largest difference of clearances, of the free ones of the first thousand.
double WorstClearance(const FreeSpace& found, const FreeSpace& truth,
                      const std::vector<AskedMotion>& motions,
                      const std::vector<char>& is_free) {
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min<std::size_t>(1000, motions.size());
       ++i) {
    const auto& [a, b] = motions[i];
    if (is_free[i] == 0) continue;
    worst = std::max(worst,
                     std::abs(found.Clearance(a, b) - truth.Clearance(a, b)));
  }
  return worst;
}

}  // namespace

double MedianCpuSeconds(const std::function<void()>& work) {
  constexpr int kRuns = 5;
  std::vector<double> seconds;
  for (int i = 0; i < kRuns; ++i) {
    const double start = CpuSeconds();
    work();
    seconds.push_back(CpuSeconds() - start);
  }
  return Quantile(seconds, 0.5);
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
  row.seconds =
      MedianCpuSeconds([&] { ConvolutionModel asked(robot, obstacle); });
  const ConvolutionModel model(robot, obstacle);
  const FreeSpace found = FreeSpace::OfConvolutions({model});
  const FreeSpace truth({space});
  const std::vector<AskedMotion> motions = RandomMotions(space, segments, seed);

  std::vector<char> is_free;
  double start = CpuSeconds();
  for (const auto& [a, b] : motions) is_free.push_back(truth.IsFree(a, b));
  row.full_microseconds = MicrosecondsPer(motions.size(), start);
  row.segments = segments;
  // One that has to look: a motion through all of C_cont's box, from outside.
  const Vector3d outside =
      space.bounds().min - 0.01 * space.length() * Vector3d::Ones();
  start = CpuSeconds();
  found.IsFree(outside, 2.0 * space.bounds().Center() - outside);
  row.first_milliseconds = 1e3 * (CpuSeconds() - start);
  row.microseconds = CompareMotions(found, motions, is_free, &row);
  row.modelled = model.facets();
  row.again_microseconds = CompareMotions(found, motions, is_free, &row);
  row.facets = model.Mesh().triangles.size();
  row.worst_clearance =
      WorstClearance(found, truth, motions, is_free) / space.length();
  return row;
}

NamedTable FreeSpaceTable(const std::vector<FreeSpaceRow>& rows) {
  return {"free_space.csv",
          MakeTable({"pair", "triangles of A", "triangles of B",
                     "full build, CPU s", "ready, CPU s", "share",
                     "first check, CPU ms", "segments", "free", "disagreements",
                     "worst clearance error / D", "facets of the convolution",
                     "facets modelled", "check in full, CPU us",
                     "in free space alone, CPU us", "once more, CPU us"},
                    rows, [](const FreeSpaceRow& r, const auto& add) {
                      add(r.name, r.robot, r.obstacle, r.full_seconds,
                          r.seconds, r.seconds / r.full_seconds,
                          r.first_milliseconds, r.segments, r.free,
                          r.disagreements, r.worst_clearance, r.facets,
                          r.modelled, r.full_microseconds, r.microseconds,
                          r.again_microseconds);
                    })};
}

}  // namespace phongpd::bench
