// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/curve_pieces.h"

#include <Eigen/Geometry>
#include <vector>

#include "tests/support/solid_tools.h"

namespace phongpd::testing {

using Eigen::Vector3d;

Trajectory Arch(double gap) {
  return Trajectory({CurvePiece(
      {{-1.5, 0.0, 2.0 + gap}, {0.0, 0.0, gap}, {1.5, 0.0, 2.0 + gap}}, 2.0)});
}

CurvePiece RandomPiece(const FreeSpace& space, const ContactSpace& contact,
                       double spread, std::mt19937_64* random) {
  std::uniform_int_distribution<int> degree(2, CurvePiece::kMaxDegree);
  std::vector<Vector3d> points;
  do {
    points = {RandomPoint(contact.bounds(), random)};
  } while (!space.IsFree(points[0]));
  std::normal_distribution<double> normal(0.0, spread);
  const double length = (contact.bounds().max - contact.bounds().min).norm();
  for (int i = degree(*random); i > 0; --i) {
    points.push_back(points.back() + length * Vector3d(normal(*random),
                                                       normal(*random),
                                                       normal(*random)));
  }
  return CurvePiece(points, 1.0);
}

CurvePiece GrazingPiece(const ContactSpace& contact, double gap,
                        std::mt19937_64* random) {
  const SurfacePoint at = RandomSurfacePoint(contact.mesh(), random);
  std::uniform_real_distribution<double> unit(0.02, 0.3);
  const Vector3d along = at.normal.unitOrthogonal() * unit(*random);
  const double rise = unit(*random);
  const Vector3d foot = at.position + gap * at.normal;
  const Vector3d high = foot + rise * at.normal;
  return CurvePiece({high - along, foot - rise * at.normal, high + along}, 1.0);
}

}  // namespace phongpd::testing
