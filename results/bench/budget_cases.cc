// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "results/bench/budget_measure.h"

namespace phongpd::bench {
namespace {

constexpr std::size_t kDecades[] = {1000, 10000, 100000, 1000000};

// Longest edges for which the obstacle comes near each decade; noise is 0.02 of
// them.
TriangleMesh Scanned(const TriangleMesh& solid, double edge) {
  return MakeScan(solid, edge, 0.02 * edge, 3);
}

}  // namespace

std::vector<BudgetCase> BudgetCases() {
  constexpr int kAround[] = {40, 200, 700, 2400};
  constexpr int kAcross[] = {12, 25, 70, 210};
  constexpr int kLevels[] = {3, 5, 6, 8};
  constexpr double kTorusEdges[] = {0.6, 0.15, 0.05, 0.0125};
  constexpr double kTrapEdges[] = {0.3, 0.09, 0.025, 0.0065};
  std::vector<BudgetCase> cases;
  for (int i = 0; i < 4; ++i) {
    const std::size_t decade = kDecades[i];
    cases.push_back({"ball + knot", decade, [] { return MakeIcoBall(0.25, 1); },
                     [around = kAround[i], across = kAcross[i]] {
                       return MakeKnot(0.5, 0.2, around, across);
                     }});
    cases.push_back(
        {"star + organic body", decade, [] { return MakeStar(0.5, 1.2); },
         [levels = kLevels[i]] { return MakeBlob(2.0, levels, 0.35, 1); }});
    cases.push_back({"wrench + scanned torus", decade,
                     [] {
                       return Rotated(MakeWrench(0.5, 12, 12, 8, 8),
                                      GenericRotation());
                     },
                     [edge = kTorusEdges[i]] {
                       return Scanned(MakeTorus(2.0, 0.7, 20, 10), edge);
                     }});
    cases.push_back({"box + scanned U", decade,
                     [] {
                       return Rotated(
                           MakeBox({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}),
                           GenericRotation());
                     },
                     [edge = kTrapEdges[i]] {
                       return Scanned(MakeU(2.0, 0.3, 0.6), edge);
                     }});
  }
  return cases;
}

}  // namespace phongpd::bench
