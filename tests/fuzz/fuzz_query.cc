// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/global_control.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/promise.h"

namespace phongpd::fuzz {
namespace {

struct Metrics {
  explicit Metrics(const phongpd::ContactSpace& space) : euclidean(space) {
    for (const FieldKind field :
         {FieldKind::kNormal, FieldKind::kTangentPlane}) {
      for (const double smoothing_length : {0.0, 0.2}) {
        PhongMetricOptions options;
        options.field = field;
        options.field_options.smoothing_length = smoothing_length;
        // ℓ/2, the default, makes 1100 triangles of 50.  That finds nothing
        // more, but a query without a branch tries them all.
        options.field_options.max_edge = 1.0;
        phong.emplace_back(space, options);
      }
    }
  }
  EuclideanMetric euclidean;
  std::vector<PhongMetric> phong;
};

const std::vector<std::unique_ptr<Metrics>>& AllMetrics() {
  static const auto all = [] {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                  1);
    std::vector<std::unique_ptr<Metrics>> metrics;
    const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
    for (const TriangleMesh& obstacle :
         {box, MakeCone(1.0, 2.0, 7), MakeU(3.0, 1.0, 1.0)}) {
      metrics.push_back(std::make_unique<Metrics>(
          BuildContactSpace(MakeCone(0.5, 1.0, 3), obstacle)));
    }
    return metrics;
  }();
  return all;
}

Eigen::Vector3d Point(ByteSource* source, const Eigen::Vector3d& last) {
  Eigen::Vector3d q;
  switch (source->Below(4)) {
    case 0:
      for (double& x : q) x = source->Raw<double>();
      return q;
    case 1:  // next to the last one
      q = last;
      q[source->Below(3)] += std::ldexp(1.0, -1 - source->Below(64));
      return q;
    default:
      for (double& x : q) x = source->Coordinate() / 4.0;
      return q;
  }
}

Branch AnyBranch(ByteSource* source, const Branch& last) {
  Branch branch = last;
  switch (source->Below(5)) {
    case 0:
      return Branch();
    case 1:
      branch.triangle = source->Raw<int>();
      return branch;
    case 2:
      for (double& x : branch.lambda) x = source->Raw<double>();
      return branch;
    case 3:
      branch.triangle = source->Below(64);
      branch.s = source->Raw<double>();
      return branch;
    default:
      return branch;
  }
}

void PromiseAnswer(const PenetrationResult& result, const Eigen::Vector3d& q) {
  Promise((result.status == QueryStatus::kInvalid) == !q.allFinite(),
          "invalid means a point that is not finite");
  Promise(std::isfinite(result.signed_distance) && result.contact.allFinite() &&
              result.direction.allFinite() && result.gradient.allFinite() &&
              result.branch.lambda.allFinite() &&
              std::isfinite(result.branch.s),
          "answers are finite");
  if (result.status == QueryStatus::kInvalid) return;
  Promise(std::abs(result.direction.norm() - 1.0) < 1e-9,
          "directions are units");
  Promise(result.triangle >= 0, "an answer has a triangle");
  Promise(result.inside ? result.signed_distance <= 0.0
                        : result.signed_distance >= 0.0,
          "inside is negative");
}

}  // namespace

void Query(const std::uint8_t* data, std::size_t size) {
  ByteSource source(data, size);
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  Branch branch;
  for (int queries = 0; queries < 8 && !source.AtEnd(); ++queries) {
    const Metrics& metrics = *AllMetrics()[static_cast<std::size_t>(
        source.Below(static_cast<int>(AllMetrics().size())))];
    const PhongMetric& phong = metrics.phong[static_cast<std::size_t>(
        source.Below(static_cast<int>(metrics.phong.size())))];
    q = Point(&source, q);
    branch = AnyBranch(&source, branch);
    const PenetrationResult euclidean = metrics.euclidean.Query(q, branch);
    PromiseAnswer(euclidean, q);
    const int kind = source.Below(4);
    const PenetrationResult result =
        kind == 0 ? phong.QueryRing(q, branch, 1) : phong.Query(q, branch);
    PromiseAnswer(result, q);
    Promise(
        result.inside == euclidean.inside && result.inside == phong.IsInside(q),
        "all agree on what is inside");
    if (kind == 1) {
      std::vector<PenetrationResult> all;
      phong.QueryAll(q, source.Raw<double>(), &all);
      for (const PenetrationResult& one : all) PromiseAnswer(one, q);
    }
    branch = result.branch;
  }
}

}  // namespace phongpd::fuzz
