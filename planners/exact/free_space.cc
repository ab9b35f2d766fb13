// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/free_space.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/bvh/segment_triangle_distance.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Can distances from q be told?  q and q − centre must be finite.
bool Accepts(const TriangleBvh& tree, const Vector3d& q) {
  return IsFinite(q - tree.center());
}

}  // namespace

struct FreeSpace::Impl {
  // Index of the contact space that q touches or is inside of, kBounds where
  // it is not strictly within them, kNone where q is free.
  int Blocker(const Vector3d& q) const {
    if (!IsFinite(q) || !IsWithinBounds(q)) return MotionCheck::kBounds;
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      if (trees[i]->Locate(q) != Location::kOutside) {
        return static_cast<int>(i);
      }
    }
    return MotionCheck::kNone;
  }

  bool IsWithinBounds(const Vector3d& q) const {
    return bounds.IsEmpty() || ((q.array() > bounds.min.array()).all() &&
                                (q.array() < bounds.max.array()).all());
  }

  // Fraction of the way from a to b at which the bounds are reached, if a lies
  // strictly within them and b does not.
  double FractionToBounds(const Vector3d& a, const Vector3d& b) const {
    double fraction = 1.0;
    for (int k = 0; k < 3; ++k) {
      if (b[k] > bounds.min[k] && b[k] < bounds.max[k]) continue;
      const double wall = b[k] > a[k] ? bounds.max[k] : bounds.min[k];
      fraction = std::min(fraction, (wall - a[k]) / (b[k] - a[k]));
    }
    return fraction;
  }

  std::vector<ContactSpace> spaces;
  std::vector<const TriangleBvh*> trees;  // of the spaces
  BoundingBox bounds;
};

FreeSpace::FreeSpace(std::vector<ContactSpace> spaces,
                     const BoundingBox& bounds)
    : impl_(std::make_unique<Impl>()) {
  CheckBounds(bounds);
  impl_->spaces = std::move(spaces);
  for (const ContactSpace& space : impl_->spaces) {
    impl_->trees.push_back(&space.bvh());
  }
  impl_->bounds = bounds;
}

FreeSpace::~FreeSpace() = default;
FreeSpace::FreeSpace(FreeSpace&&) noexcept = default;
FreeSpace& FreeSpace::operator=(FreeSpace&&) noexcept = default;

BoundingBox FreeSpace::NoBounds() {
  return {Vector3d::Constant(1.0), Vector3d::Constant(-1.0)};
}

void FreeSpace::CheckBounds(const BoundingBox& bounds) {
  if (IsFinite(bounds.min) && IsFinite(bounds.max)) return;
  throw InputError(
      "bounds: expected finite numbers, found NaN or Inf; leave the bounds out "
      "where there are none");
}

bool FreeSpace::IsFree(const Vector3d& q) const {
  return impl_->Blocker(q) == MotionCheck::kNone;
}

bool FreeSpace::IsFree(const Vector3d& a, const Vector3d& b) const {
  // The bounds are convex: if the ends are within them, so is the segment.
  if (!IsFree(a) || !IsFree(b)) return false;
  return std::none_of(
      impl_->trees.begin(), impl_->trees.end(),
      [&](const TriangleBvh* tree) { return tree->Meets(a, b); });
}

MotionCheck FreeSpace::Check(const Vector3d& a, const Vector3d& b) const {
  MotionCheck result;
  result.obstacle = impl_->Blocker(a);
  if (result.obstacle != MotionCheck::kNone || !IsFinite(b)) {
    result.free = false;
    result.fraction = 0.0;
    if (result.obstacle == MotionCheck::kNone) {
      result.obstacle = MotionCheck::kBounds;
    }
    return result;
  }
  for (std::size_t i = 0; i < impl_->spaces.size(); ++i) {
    const TriangleBvh::Hit hit = impl_->trees[i]->FirstHit(a, b);
    if (hit.Found() && (result.free || hit.fraction < result.fraction)) {
      result = {false, hit.fraction, static_cast<int>(i), hit.triangle};
    }
  }
  if (!impl_->IsWithinBounds(b)) {
    const double fraction = impl_->FractionToBounds(a, b);
    if (result.free || fraction < result.fraction) {
      result = {false, fraction, MotionCheck::kBounds, -1};
    }
  }
  return result;
}

double FreeSpace::Clearance(const Vector3d& q) const {
  const BoundingBox& bounds = impl_->bounds;
  double clearance = std::numeric_limits<double>::infinity();
  if (!IsFinite(q)) return 0.0;
  if (!bounds.IsEmpty()) {
    clearance = (q - bounds.min)
                    .cwiseAbs()
                    .cwiseMin((bounds.max - q).cwiseAbs())
                    .minCoeff();
  }
  for (const TriangleBvh* tree : impl_->trees) {
    if (!Accepts(*tree, q)) return 0.0;
    clearance = std::min(clearance, tree->FindClosest(q).distance);
  }
  return clearance;
}

std::vector<FreeSpace::NearTriangle> FreeSpace::FindNear(const Vector3d& a,
                                                         const Vector3d& b,
                                                         double radius) const {
  std::vector<NearTriangle> near;
  if (!IsFinite(a) || !IsFinite(b) || !std::isgreaterequal(radius, 0.0)) {
    return near;
  }
  for (const ContactSpace& space : impl_->spaces) {
    if (!Accepts(space.bvh(), a) || !Accepts(space.bvh(), b)) continue;
    const TriangleMesh& mesh = space.mesh();
    space.bvh().ForEachDoubt(a, b, radius, [&](int triangle, double) {
      NearTriangle found;
      std::array<Vector3d, 3> t;
      for (std::size_t k = 0; k < 3; ++k) {
        found.corners[k] = mesh.vertices[mesh.triangles[triangle][k]];
        t[k] = found.corners[k] - a;
      }
      const SegmentTrianglePair pair =
          ClosestPair(Vector3d::Zero(), b - a, t[0], t[1], t[2]);
      found.distance = std::sqrt(pair.squared_distance);
      if (found.distance > radius) return;
      found.normal = (pair.on_segment - pair.on_triangle).stableNormalized();
      // Wherever rounding put the pair, the triangle is below its plane.
      found.level = -std::numeric_limits<double>::infinity();
      for (const Vector3d& q : found.corners) {
        found.level = std::max(found.level, found.normal.dot(q));
      }
      near.push_back(found);
    });
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const NearTriangle& one, const NearTriangle& other) {
                     return one.distance < other.distance;
                   });
  return near;
}

double FreeSpace::Clearance(const Vector3d& a, const Vector3d& b) const {
  double clearance = std::min(Clearance(a), Clearance(b));
  if (!IsFree(a, b)) return 0.0;
  for (const TriangleBvh* tree : impl_->trees) {
    clearance = tree->Distance(a, b, clearance);
  }
  return clearance;
}

const std::vector<ContactSpace>& FreeSpace::spaces() const {
  return impl_->spaces;
}
const BoundingBox& FreeSpace::bounds() const { return impl_->bounds; }

double PathLength(const std::vector<Vector3d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i] - path[i - 1]).norm();
  }
  return length;
}

PathCheck CheckPath(const FreeSpace& space, const std::vector<Vector3d>& path) {
  PathCheck result;
  if (path.empty()) return result;
  if (path.size() == 1) {
    result.motion = space.Check(path[0], path[0]);
    result.segment = result.motion.free ? -1 : 0;
  }
  for (std::size_t k = 0; k + 1 < path.size() && result.motion.free; ++k) {
    result.motion = space.Check(path[k], path[k + 1]);
    if (!result.motion.free) result.segment = static_cast<int>(k);
  }
  result.free = result.motion.free;
  return result;
}

double PathClearance(const FreeSpace& space,
                     const std::vector<Vector3d>& path) {
  if (path.empty()) return 0.0;
  double best = space.Clearance(path.front(), path.front());
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    best = std::min(best, space.Clearance(path[k], path[k + 1]));
  }
  return best;
}

}  // namespace phongpd
