// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
    for (std::size_t i = 0; i < models.size(); ++i) {
      if (!models[i].IsFree(q)) return static_cast<int>(i);
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

  // Either of these is empty.
  std::vector<ContactSpace> spaces;
  std::vector<const TriangleBvh*> trees;  // of the spaces
  std::vector<ConvolutionModel> models;
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

FreeSpace::FreeSpace(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

FreeSpace FreeSpace::OfConvolutions(std::vector<ConvolutionModel> models,
                                    const BoundingBox& bounds) {
  CheckBounds(bounds);
  auto impl = std::make_unique<Impl>();
  impl->models = std::move(models);
  impl->bounds = bounds;
  return FreeSpace(std::move(impl));
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
  if (!impl_->models.empty()) {
    return IsFinite(a) && IsFinite(b) && impl_->IsWithinBounds(a) &&
           impl_->IsWithinBounds(b) &&
           std::all_of(impl_->models.begin(), impl_->models.end(),
                       [&](const ConvolutionModel& model) {
                         return model.IsFree(a, b);
                       });
  }
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
  for (std::size_t i = 0; i < impl_->models.size(); ++i) {
    const double fraction = impl_->models[i].FirstContact(a, b);
    if (fraction <= 1.0 && (result.free || fraction < result.fraction)) {
      result = {false, fraction, static_cast<int>(i), -1};
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
  for (const ConvolutionModel& model : impl_->models) {
    clearance = std::min(clearance, model.FindNearest(q).distance);
  }
  return clearance;
}

std::vector<Separator> FreeSpace::FindSeparators(const Vector3d& a,
                                                 const Vector3d& b,
                                                 double radius,
                                                 double slack) const {
  std::vector<Separator> found;
  if (!IsFinite(a) || !IsFinite(b) || !std::isgreaterequal(radius, 0.0) ||
      !std::isgreaterequal(slack, 0.0)) {
    return found;
  }
  SeparatorSearch search(a, b, radius, slack);
  for (const TriangleBvh* tree : impl_->trees) {
    if (Accepts(*tree, a) && Accepts(*tree, b)) search.Add(*tree);
  }
  search.AdvanceTo(std::numeric_limits<double>::infinity());
  found = search.found();
  for (const ConvolutionModel& model : impl_->models) {
    for (const Separator& one : model.FindSeparators(a, b, radius, slack)) {
      found.push_back(one);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Separator& one, const Separator& other) {
                     return one.distance < other.distance;
                   });
  return found;
}

double FreeSpace::Clearance(const Vector3d& a, const Vector3d& b) const {
  double clearance = std::min(Clearance(a), Clearance(b));
  if (!IsFree(a, b)) return 0.0;
  for (const TriangleBvh* tree : impl_->trees) {
    clearance = tree->Distance(a, b, clearance);
  }
  for (const ConvolutionModel& model : impl_->models) {
    clearance = model.Clearance(a, b, clearance);
  }
  return clearance;
}

const std::vector<ContactSpace>& FreeSpace::spaces() const {
  return impl_->spaces;
}
const std::vector<ConvolutionModel>& FreeSpace::convolutions() const {
  return impl_->models;
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
