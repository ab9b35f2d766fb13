// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/lazy_cases.h"

#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"

namespace phongpd::bench {
namespace {

using Maker = std::function<TriangleMesh()>;

}  // namespace

std::vector<LazyCase> LazyCases() {
  const auto turned = [](const Maker& make) -> Maker {
    return [make] { return Rotated(make(), GenericRotation()); };
  };
  const Maker knot = [] { return MakeKnot(0.5, 0.225, 96, 8); };
  const Maker wrench = [] { return MakeWrench(); };
  return {
      {"ball + wrench", [] { return MakeUvBall(0.4, 24, 22); }, wrench},
      {"turned wrench + wrench",
       turned([] { return MakeWrench(0.5, 12, 12, 8, 8); }), wrench},
      {"cube + hollow shell", turned([] {
         return MakeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
       }),
       [] { return MakeVessel(4, 3, 0); }},
      {"star + knot", [] { return MakeStar(0.5, 1.2); }, knot},
      {"star + organic body", [] { return MakeStar(0.5, 1.2); },
       [] { return MakeBlob(2, 5, 0.35, 1); }},
      {"turned wrench + scanned torus",
       turned([] { return MakeWrench(0.5, 24, 24, 20, 18); }),
       [] { return MakeScan(MakeTorus(2, 0.7, 60, 30), 0.15, 0.002, 3); }},
      {"knot + scanned body", [] { return MakeKnot(0.3, 0.12, 128, 16); },
       [] { return MakeScan(MakeBlob(2, 4, 0.35, 1), 0.2, 0.001, 3); }},
  };
}

}  // namespace phongpd::bench
