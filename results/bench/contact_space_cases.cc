// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/contact_space_cases.h"

#include "problems/shapes/shapes.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Maker = std::function<TriangleMesh()>;

TriangleMesh Cube(double side) {
  const Vector3d half = Vector3d::Constant(side / 2);
  return MakeBox(-half, half);
}
TriangleMesh Star() { return MakeStar(0.5, 1.2); }
TriangleMesh SmallWrench() { return MakeWrench(0.5, 12, 12, 8, 8); }
TriangleMesh Torus() { return MakeTorus(2, 0.6, 24, 12); }
TriangleMesh Peg(double side) {
  return MakeBox({-side / 2, -side / 2, -1}, {side / 2, side / 2, 1});
}
TriangleMesh Plate() { return MakePlateWithHole(4, 1, 1); }
// A brick with no side along an axis.
TriangleMesh Brick() {
  return Rotated(MakeBox({-0.1, -0.15, -0.05}, {0.1, 0.15, 0.05}),
                 GenericRotation());
}
Maker SmoothObstacle(int around, int across) {
  return [=] { return MakeTorus(2, 0.8, around, across); };
}

}  // namespace

std::vector<BuildCase> BuildCases() {
  const auto turned = [](const Maker& make) -> Maker {
    return [make] { return Rotated(make(), GenericRotation()); };
  };
  const Maker wrench = [] { return MakeWrench(); };
  const Maker cone = [] { return MakeCone(0.8, 1.6, 40); };
  const Maker ball = [] { return MakeUvBall(1, 24, 22); };
  const Maker small_ball = [] { return MakeUvBall(0.4, 24, 22); };
  const Maker axes = [] { return MakeAxes(2, 0.2); };
  const Maker blob = [] { return MakeBlob(2, 4, 0.35, 1); };
  const Maker knot = [] { return MakeKnot(0.5, 0.225, 64, 6); };
  const Maker fine_knot = [] { return MakeKnot(0.5, 0.225, 96, 8); };
  const Maker vessel = [] { return MakeVessel(3.6, 3, 0.6); };
  const Maker shell = [] { return MakeVessel(4, 3, 0); };
  const Maker cube = [] { return Cube(1); };
  return {
      {"ball 1008 + cone 78", ball, cone, 0, 0, 0, true},
      {"cone 78 + axes 60", cone, axes, 0, 0, 0, true},
      {"ball 1008 + wrench 772", small_ball, wrench, 0.15, 0, 0, true},
      {"wrench 192 + wrench 772, aligned", SmallWrench, wrench, 0.3, 0, 1000,
       true},
      {"the same, both turned alike", turned(SmallWrench), turned(wrench)},
      {"wrench 192 turned + wrench 772", turned(SmallWrench), wrench, 0, 0, 0,
       true},
      {"star 60 + torus 576", Star, Torus, 0, 0, 0, true},
      {"knot 768 + torus 576", knot, Torus},
      {"star 60 + knot 1536", Star, fine_knot},
      {"star 60 + organic 5120", Star, blob, 3.0, 250, 0, true},
      {"square peg + plate, exact fit", [] { return Peg(1.0); }, Plate, 0, 0, 0,
       true},
      {"square peg + plate, 1 % clearance", [] { return Peg(0.99); }, Plate, 0,
       0, 0, true},
      {"round peg + plate, 4 % clearance", [] { return MakePrism(0.5, 2, 32); },
       [] { return MakePlateWithRoundHole(4, 1, 0.52, 32); }, 0, 0, 0, true},
      {"cube + vessel with a window", cube, vessel, 0, 0, 0, true},
      {"cube + hollow shell", cube, shell, 0, 0, 0, true},
  };
}

std::vector<GrowthSeries> GrowthCases() {
  const auto series = [](const std::string& name, const Maker& robot) {
    return GrowthSeries{name,
                        {{"10^4", robot, SmoothObstacle(100, 50)},
                         {"10^5", robot, SmoothObstacle(400, 125)},
                         {"10^6", robot, SmoothObstacle(1000, 500)}}};
  };
  return {series("brick 12", Brick),
          series("ball 80", [] { return MakeIcoBall(0.3, 1); })};
}

}  // namespace phongpd::bench
