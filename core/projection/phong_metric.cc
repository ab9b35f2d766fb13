// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/phong_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/projection/branch_walk.h"
#include "core/projection/contact_surface.h"
#include "core/projection/field_projector.h"
#include "core/projection/prism_search.h"
#include "core/projection/ring_search.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

// Two hits are one (found by the two triangles of an edge) if both agree to
// this; field frame.
constexpr double kSameHit = 1e-9;
// |s| of a branch, in the field frame, whose diagonal is in [1, 2).  Where n(λ)
// is short, s is a multiple of the depth, but no projection has one like this,
// and its fourth power is still finite.
constexpr double kMaxOffset = 1e50;

}  // namespace

void PhongMetricOptions::Validate() const { field_options.Validate(); }

struct PhongMetric::Impl {
  Impl(const ContactSpace& space, const PhongMetricOptions& options)
      : surface(space),
        projector(BuildPhongField(space, options.field_options), options.field),
        search(projector),
        walk(projector) {
    // Field vertices that are contact vertices keep their exact coordinates.
    const TriangleMesh& mesh = space.mesh();
    const PhongField& field = projector.field();
    for (std::size_t v = 0; v < field.mesh.vertices.size(); ++v) {
      const bool original =
          v < mesh.vertices.size() &&
          field.ToField(mesh.vertices[v]) == field.mesh.vertices[v];
      vertices.push_back(original ? mesh.vertices[v]
                                  : field.FromField(field.mesh.vertices[v]));
    }
  }

  // A branch that comes from this metric or could have.  The comparisons are
  // false for NaN; a sum of λ ≥ 0 that is 1 has no infinite part.
  bool Knows(const Branch& branch) const {
    const Vector3d& lambda = branch.lambda;
    return branch.triangle >= 0 &&
           branch.triangle <
               static_cast<int>(projector.field().mesh.triangles.size()) &&
           std::isgreaterequal(lambda[0], 0.0) &&
           std::isgreaterequal(lambda[1], 0.0) &&
           std::isgreaterequal(lambda[2], 0.0) &&
           std::abs(lambda.sum() - 1.0) < 1e-9 &&
           std::islessequal(std::abs(branch.s * projector.field().scale),
                            kMaxOffset);
  }

  Projection ToProjection(const Branch& branch) const {
    Projection p;
    p.triangle = branch.triangle;
    p.lambda = branch.lambda;
    p.s = branch.s * projector.field().scale;
    return p;
  }

  PenetrationResult ToResult(const Projection& p, QueryStatus status) const {
    const PhongField& field = projector.field();
    PenetrationResult result;
    result.status = status;
    result.inside = true;
    result.signed_distance =
        -std::max(p.depth / field.scale, surface.LeastDistance());
    const Triangle& t = field.mesh.triangles[p.triangle];
    const Vector3d& q0 = vertices[t[0]];
    result.contact = p.lambda[1] == 1.0 ? vertices[t[1]]
                     : p.lambda[2] == 1.0
                         ? vertices[t[2]]
                         : Vector3d(q0 + p.lambda[1] * (vertices[t[1]] - q0) +
                                    p.lambda[2] * (vertices[t[2]] - q0));
    result.direction = projector.UnitNormal(p);
    result.gradient = projector.Gradient(p);
    result.triangle = field.source_triangle[p.triangle];
    result.branch.triangle = p.triangle;
    result.branch.lambda = p.lambda;
    result.branch.s = p.s / field.scale;
    return result;
  }

  PenetrationResult Cold(const Vector3d& q_o, QueryStatus status) const {
    const Projection least =
        search.FindLeastDepth(projector, projector.field().ToField(q_o));
    if (least.IsValid()) return ToResult(least, status);
    PenetrationResult result = surface.Answer(q_o, Location::kInside);
    result.status = QueryStatus::kEuclideanFallback;
    return result;
  }

  Projection Follow(const Projection& previous, const Vector3d& x) const {
    if (projector.kind() == FieldKind::kTangentPlane) {
      return FollowByNewton(projector, walk, x, previous);
    }
    NormalHit hit{previous.lambda, previous.s};
    int triangle = previous.triangle;
    if (!walk.Follow(projector, x, &hit, &triangle)) return {};
    const double depth = -projector.prisms()[triangle].SignedDepth(hit);
    return {triangle, hit.lambda, hit.s, depth};
  }

  ContactSurface surface;
  FieldProjector projector;
  PrismSearch search;
  BranchWalk walk;
  std::vector<Vector3d> vertices;  // of the field mesh, user's frame
};

PhongMetric::PhongMetric(const ContactSpace& space,
                         const PhongMetricOptions& options) {
  options.Validate();
  impl_ = std::make_unique<Impl>(space, options);
}
PhongMetric::~PhongMetric() = default;
PhongMetric::PhongMetric(PhongMetric&&) noexcept = default;
PhongMetric& PhongMetric::operator=(PhongMetric&&) noexcept = default;

PenetrationResult PhongMetric::Query(const Vector3d& q_o,
                                     const Branch& previous) const {
  const Impl& impl = *impl_;
  if (!impl.surface.Accepts(q_o)) return {};
  const Location location = impl.surface.Locate(q_o);
  const bool is_inside = location == Location::kInside;
  if (!impl.Knows(previous)) {
    return is_inside ? impl.Cold(q_o, QueryStatus::kOk)
                     : impl.surface.Answer(q_o, location);
  }
  Projection now = impl.Follow(impl.ToProjection(previous),
                               impl.projector.field().ToField(q_o));
  if (!is_inside) {
    PenetrationResult result = impl.surface.Answer(q_o, location);
    // Out where the branch leads, its depth goes through 0; out elsewhere, PD
    // jumps from the branch's depth to 0.
    if (!now.IsValid() || now.s < -FieldProjector::kOnSurface) {
      result.status = QueryStatus::kBranchEnded;
    }
    return result;
  }
  // Inside, a branch with s > 0 has left C_obj on the way and is another
  // solution's continuation.
  if (!now.IsValid() || now.s > FieldProjector::kOnSurface) {
    return impl.Cold(q_o, QueryStatus::kBranchEnded);
  }
  now.s = std::min(now.s, 0.0);
  now.depth = std::max(now.depth, 0.0);
  return impl.ToResult(now, QueryStatus::kOk);
}

void PhongMetric::QueryAll(const Vector3d& q_o, double depth_bound,
                           std::vector<PenetrationResult>* results) const {
  const Impl& impl = *impl_;
  results->clear();
  if (!impl.surface.Accepts(q_o) || !std::isgreaterequal(depth_bound, 0.0) ||
      impl.surface.Locate(q_o) != Location::kInside) {
    return;
  }
  const PhongField& field = impl.projector.field();
  impl.search.ForEach(impl.projector, field.ToField(q_o),
                      depth_bound * field.scale, [&](const Projection& p) {
                        results->push_back(impl.ToResult(p, QueryStatus::kOk));
                      });
  std::sort(results->begin(), results->end(),
            [](const PenetrationResult& a, const PenetrationResult& b) {
              return a.signed_distance > b.signed_distance;
            });
  // Drop repetitions; equal hits have (nearly) equal depth.
  const double same = kSameHit / field.scale;
  std::size_t kept = 0;
  for (const PenetrationResult& candidate : *results) {
    bool repeated = false;
    for (std::size_t i = kept; i-- > 0 && !repeated;) {
      const PenetrationResult& other = (*results)[i];
      if (other.signed_distance - candidate.signed_distance > same) break;
      repeated = (other.contact - candidate.contact).norm() <= same;
    }
    if (!repeated) (*results)[kept++] = candidate;
  }
  results->resize(kept);
}

PenetrationResult PhongMetric::QueryRing(const Vector3d& q_o,
                                         const Branch& previous, int k) const {
  const Impl& impl = *impl_;
  if (k < 0) {
    throw InputError("rings: expected ≥ 0, found " + std::to_string(k));
  }
  if (!impl.Knows(previous) || !IsInside(q_o)) return Query(q_o);
  const Projection nearest = SearchRings(impl.projector, impl.walk,
                                         impl.projector.field().ToField(q_o),
                                         impl.ToProjection(previous), k);
  if (!nearest.IsValid()) return impl.Cold(q_o, QueryStatus::kBranchEnded);
  return impl.ToResult(nearest, QueryStatus::kOk);
}

bool PhongMetric::IsInside(const Vector3d& q_o) const {
  return impl_->surface.Locate(q_o) == Location::kInside;
}

const PhongField& PhongMetric::field() const {
  return impl_->projector.field();
}

}  // namespace phongpd
