// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/control_metrics.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/bvh/closest_on_triangle.h"
#include "core/pi.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_field.h"
#include "core/projection/smoothed_metric.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Euclid's answer with that direction.
PenetrationResult Directed(PenetrationResult result, const Vector3d& n) {
  result.direction = result.gradient = n;
  return result;
}

class DiffusedMetric final : public PenetrationMetric {
 public:
  DiffusedMetric(const ContactSpace& space, const PhongFieldOptions& options)
      : euclidean_(space),
        field_(BuildPhongField(space, options)),
        pieces_(space.mesh().triangles.size()) {
    for (std::size_t i = 0; i < field_.source_triangle.size(); ++i) {
      pieces_[static_cast<std::size_t>(field_.source_triangle[i])].push_back(
          static_cast<int>(i));
    }
  }

  using PenetrationMetric::Query;
  PenetrationResult Query(const Vector3d& q, const Branch&) const override {
    const PenetrationResult nearest = euclidean_.Query(q);
    if (!nearest.inside) return nearest;
    const Vector3d n = NormalAt(nearest.triangle, nearest.contact);
    if (n.isZero(0.0)) return nearest;
    return Directed(nearest, n);
  }

 private:
  // On the piece of that triangle that is nearest to it.
  Vector3d NormalAt(int triangle, const Vector3d& contact) const {
    const Vector3d x = field_.ToField(contact);
    TrianglePoint best;
    int found = -1;
    for (const int i : pieces_[static_cast<std::size_t>(triangle)]) {
      const Triangle& t = field_.mesh.triangles[static_cast<std::size_t>(i)];
      const TrianglePoint here = ClosestOnTriangle(
          field_.mesh.vertices[static_cast<std::size_t>(t[0])],
          field_.mesh.vertices[static_cast<std::size_t>(t[1])],
          field_.mesh.vertices[static_cast<std::size_t>(t[2])], x);
      if (found >= 0 && here.squared_distance >= best.squared_distance)
        continue;
      best = here;
      found = i;
    }
    if (found < 0) return Vector3d::Zero();
    const Triangle& t = field_.mesh.triangles[static_cast<std::size_t>(found)];
    Vector3d n = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      n += best.lambda[k] * field_.normals[static_cast<std::size_t>(
                                t[static_cast<std::size_t>(k)])];
    }
    return n.stableNormalized();
  }

  EuclideanMetric euclidean_;
  PhongField field_;
  std::vector<std::vector<int>> pieces_;  // of the field, of each triangle
};

// In [0, 2π), of the bits of q (the finaliser of MurmurHash3).
double LotOf(const Vector3d& q) {
  std::uint64_t bits = 0;
  for (const double x : q) {
    std::uint64_t word = 0;
    std::memcpy(&word, &x, sizeof word);
    bits ^= word;
    bits ^= bits >> 33;
    bits *= 0xff51afd7ed558ccdULL;
    bits ^= bits >> 33;
    bits *= 0xc4ceb9fe1a85ec53ULL;
    bits ^= bits >> 33;
  }
  return 2.0 * kPi * static_cast<double>(bits >> 11) * 0x1p-53;
}

class PlaceboMetric final : public PenetrationMetric {
 public:
  PlaceboMetric(const ContactSpace& space, double smoothing_length)
      : smoothed_(space, smoothing_length), euclidean_(space) {}

  using PenetrationMetric::Query;
  PenetrationResult Query(const Vector3d& q, const Branch&) const override {
    const PenetrationResult nearest = euclidean_.Query(q);
    if (!nearest.inside) return nearest;
    const Vector3d& n = nearest.direction;
    const Vector3d other = smoothed_.Query(q).direction;
    const double angle = std::atan2(n.cross(other).norm(), n.dot(other));
    const Vector3d side = Eigen::AngleAxisd(LotOf(q), n) * n.unitOrthogonal();
    return Directed(nearest, std::cos(angle) * n + std::sin(angle) * side);
  }

 private:
  SmoothedMetric smoothed_;
  EuclideanMetric euclidean_;
};

}  // namespace

std::shared_ptr<const PenetrationMetric> MakeDiffusedMetric(
    const ContactSpace& space, double smoothing_length) {
  PhongFieldOptions options;
  options.smoothing_length = smoothing_length;
  return std::make_shared<DiffusedMetric>(space, options);
}

std::shared_ptr<const PenetrationMetric> MakePlaceboMetric(
    const ContactSpace& space, double smoothing_length) {
  return std::make_shared<PlaceboMetric>(space, smoothing_length);
}

}  // namespace phongpd
