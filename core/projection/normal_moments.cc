// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/normal_moments.h"

#include <Eigen/Geometry>
#include <cstddef>

namespace phongpd::internal {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Six points and their weights, exact for polynomials of degree 4 on a
// triangle (Dunavant 1985): each stands at λ = (1 − 2λ, λ, λ) in turn.
struct Orbit {
  double lambda, weight;
};
constexpr std::array<Orbit, 2> kOrbits{
    {{0.44594849091596486, 0.22338158967801147},
     {0.09157621350977074, 0.10995174365532187}}};

}  // namespace

NormalMoments::NormalMoments(const TriangleCorners& corners,
                             const Vector3d& normal) {
  area_ = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  Of whole;
  for (const Orbit& orbit : kOrbits) {
    const double weight = orbit.weight * area_;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d r =
          (1.0 - 2.0 * orbit.lambda) * corners[i] +
          orbit.lambda * (corners[(i + 1) % 3] + corners[(i + 2) % 3]);
      const double rr = r.squaredNorm();
      whole.one += weight;
      whole.r += weight * r;
      whole.rr += weight * r * r.transpose();
      whole.rrr += weight * rr * r;
      whole.rrrr += weight * rr * rr;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double n = normal[static_cast<int>(i)];
    of_[i] = {n * whole.one, n * whole.r, n * whole.rr, n * whole.rrr,
              n * whole.rrrr};
  }
}

NormalMoments NormalMoments::Shifted(const Vector3d& t) const {
  NormalMoments out;
  out.area_ = area_;
  const double tt = t.squaredNorm();
  for (std::size_t i = 0; i < 3; ++i) {
    const Of& m = of_[i];
    Of& to = out.of_[i];
    const Matrix3d rt = m.r * t.transpose();
    to.one = m.one;
    to.r = m.r + m.one * t;
    to.rr = m.rr + rt + rt.transpose() + m.one * t * t.transpose();
    // |r + t|² (r + t)
    to.rrr = m.rrr + 2.0 * m.rr * t + tt * m.r +
             (m.rr.trace() + 2.0 * m.r.dot(t) + tt * m.one) * t;
    to.rrrr = m.Fourth(t);
  }
  return out;
}

NormalMoments& NormalMoments::operator+=(const NormalMoments& other) {
  area_ += other.area_;
  for (std::size_t i = 0; i < 3; ++i) {
    Of& m = of_[i];
    const Of& o = other.of_[i];
    m.one += o.one;
    m.r += o.r;
    m.rr += o.rr;
    m.rrr += o.rrr;
    m.rrrr += o.rrrr;
  }
  return *this;
}

}  // namespace phongpd::internal
