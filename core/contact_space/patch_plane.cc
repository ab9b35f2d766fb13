// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/patch_plane.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/mesh/unit_normal.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using LongVector = Eigen::Matrix<long double, 3, 1>;

Vector3d Farthest(const std::vector<Vector3d>& points, const Vector3d& x) {
  Vector3d best = points.front();
  for (const Vector3d& p : points) {
    if ((p - x).squaredNorm() > (best - x).squaredNorm()) best = p;
  }
  return best;
}

}  // namespace

PatchPlane::PatchPlane(const std::vector<Vector3d>& corners) {
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    normal_ += (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]);
  }
  int axis = 0;
  normal_.cwiseAbs().maxCoeff(&axis);
  u_ = (axis + 1) % 3;
  v_ = (axis + 2) % 3;
  if (normal_[axis] < 0.0) std::swap(u_, v_);
  normal_ = Unit(normal_);

  origin_ = Farthest(corners, corners.front());
  e1_ = Farthest(corners, origin_) - origin_;
  double height = 0.0;
  for (const Vector3d& p : corners) {
    const double h = (p - origin_).cross(e1_).squaredNorm();
    if (!(h > height)) continue;
    height = h;
    e2_ = p - origin_;
  }
}

Vector3d PatchPlane::Nearest(const Vector3d& x) const {
  const double length = e1_.squaredNorm();
  const Vector3d across = e2_ - (e2_.dot(e1_) / length) * e1_;
  const Vector3d to = x - origin_;
  // An error of t, large where the patch is thin, is made up for by s:
  // together they name a point of the plane near x.
  const double t = to.dot(across) / across.squaredNorm();
  const double s = (to - t * e2_).dot(e1_) / length;
  const LongVector exact =
      origin_.cast<long double>() +
      static_cast<long double>(s) * e1_.cast<long double>() +
      static_cast<long double>(t) * e2_.cast<long double>();
  return exact.cast<double>();
}

}  // namespace phongpd::internal
