// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/tracked_motions.h"

#include <cmath>

#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"

namespace phongpd::testing {

using Eigen::Vector3d;

std::vector<TrackedSpace> TrackedSpaces(std::size_t count) {
  const TriangleMesh cube =
      MakeBox(Vector3d::Constant(-0.2), Vector3d::Constant(0.2));
  const TriangleMesh turned = Rotated(cube, GenericRotation());
  const TriangleMesh ball = MakeIcoBall(0.25, 1);
  std::vector<TrackedSpace> spaces;
  const auto add = [&](const std::string& name, const TriangleMesh& a,
                       const TriangleMesh& b, bool is_hard = false) {
    if (spaces.size() < count) {
      spaces.push_back({name, BuildContactSpace(a, b), is_hard});
    }
  };
  add("cube + box", cube, MakeBox({-1, -0.7, -0.4}, {1, 0.7, 0.4}));
  add("cube + L", cube, MakeL(2.0, 0.5, 0.6));
  add("turned cube + U", turned, MakeU(2.0, 0.3, 0.6));
  add("cube + plate with hole", cube, MakePlateWithHole(3.0, 0.2, 1.0));
  add("ball + thin plate with round hole", ball,
      MakePlateWithRoundHole(3.0, 0.02, 0.6, 24), true);
  add("cube + hollow box", cube, MakeVessel(3.0, 2.0, 0.0), true);
  add("ball + wrench", MakeUvBall(0.3, 12, 10), MakeWrench(1, 12, 12, 8, 8));
  add("ball + torus", ball, MakeTorus(1.5, 0.4, 24, 10));
  add("star + organic body", MakeStar(0.2, 0.4), MakeBlob(1.5, 2, 0.35, 1));
  add("cubes that touch in an edge", cube,
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}),
             MakeBox({1.4, 1.4, 0}, {2.4, 2.4, 1})));
  add("turned cube + box with a window", turned, MakeVessel(3.0, 2.0, 0.8),
      true);
  add("cone + axes", MakeCone(0.5, 1.0, 20), MakeAxes(2.0, 0.3));
  add("ball + cone", ball, MakeCone(1.0, 2.0, 40));
  add("ball + knot", ball, MakeKnot(0.5, 0.2, 64, 8));
  add("ball + scanned U", ball, MakeScan(MakeU(2.0, 0.3, 0.6), 0.2, 0.002, 3));
  add("prism + star", MakePrism(0.2, 0.5, 7), MakeStar(0.5, 1.3));
  add("needle + L", MakeBox({-0.01, -0.01, -1}, {0.01, 0.01, 1}),
      MakeL(2.0, 0.5, 0.6), true);
  add("cube + axes", turned, MakeAxes(2.0, 0.4));
  add("organic bodies", MakeBlob(0.4, 1, 0.3, 2), MakeBlob(1.2, 2, 0.3, 3));
  add("wrench + plate", MakeWrench(0.3, 8, 8, 6, 5),
      MakePlateWithHole(3.0, 0.1, 1.2), true);
  return spaces;
}

Vector3d InnerPoint(const ContactSpace& contact, std::mt19937_64* random) {
  for (;;) {
    const Vector3d q = RandomPoint(contact.bounds(), random);
    if (contact.bvh().Locate(q) == Location::kInside) return q;
  }
}

Motion MakeMotion(const ContactSpace& contact, int kind, int frames,
                  std::mt19937_64* random) {
  const Vector3d from = InnerPoint(contact, random),
                 to = InnerPoint(contact, random);
  const double diagonal = contact.length();
  std::normal_distribution<double> normal;
  const auto any = [&] { return RandomVector(&normal, random); };
  const Vector3d bend =
      kind == 1 ? Vector3d(0.1 * diagonal * any()) : Vector3d::Zero();
  Motion motion;
  Vector3d q = from;
  for (int i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / (frames - 1);
    if (kind < 2) {
      q = from + t * (to - from) + 4.0 * t * (1.0 - t) * bend;
    } else {
      const double length =
          std::pow(10.0, -1.5 - 2.0 * std::abs(normal(*random)));
      q += length * diagonal * any() / 10.0;
      if (i % 50 == 49) q = InnerPoint(contact, random);
    }
    motion.push_back(q);
  }
  return motion;
}

}  // namespace phongpd::testing
