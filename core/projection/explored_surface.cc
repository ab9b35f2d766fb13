// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/explored_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/projection/window_reach.h"
#include "core/stopwatch.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Has it faces of C_cont?
bool HasContact(const ExploredBoxes::Box& box) {
  const std::vector<int>& patch = box.rooms.patch;
  return std::any_of(patch.begin(), patch.end(), [](int p) { return p < 0; });
}

double Distance(const BoundingBox& box, const Vector3d& x) {
  return (box.min - x).cwiseMax(x - box.max).cwiseMax(0.0).norm();
}

}  // namespace

ExploredSurface::ExploredSurface(const ConvolutionModel& model, double radius)
    : boxes_(model, radius > 0.0 ? kWindowFacets : kNearestFacets,
             ExploredBoxes::Purpose::kContact),
      radius_(radius),
      scale_(std::ldexp(1.0, -std::ilogb(model.bounds().Diagonal()))) {}

void ExploredSurface::Explore(int box) {
  const bool has_contact = HasContact(boxes_.Explore(box));
  use_.boxes = boxes_.explored().size();
  use_.faces = boxes_.faces();
  if (!has_contact) return;
  const ContactSpace space(boxes_.Surface({box}, [](int, int) { return true; }),
                           "window of the contact space");
  Part part;
  part.mesh.vertices = space.mesh().vertices;
  for (std::size_t t = 0; t < space.kind().size(); ++t) {
    if (space.kind()[t] == ContactKind::kNone) continue;
    part.mesh.triangles.push_back(space.mesh().triangles[t]);
    part.normals.push_back(space.normals()[t]);
  }
  if (part.mesh.triangles.empty()) return;
  part.bvh = std::make_shared<const TriangleBvh>(part.mesh);
  if (radius_ > 0.0) part.sums.emplace(part.bvh, part.normals, radius_);
  parts_.push_back(std::move(part));
}

std::vector<std::pair<double, int>> ExploredSurface::Unknown(const Vector3d& x,
                                                             double reach) {
  std::vector<std::pair<double, int>> unknown;
  for (const int box : boxes_.In({x.array() - reach, x.array() + reach})) {
    if (boxes_.Find(box) != nullptr) continue;
    const double distance = Distance(boxes_.window(box).Box(), x);
    if (distance <= reach) unknown.emplace_back(distance, box);
  }
  std::sort(unknown.begin(), unknown.end());
  return unknown;
}

void ExploredSurface::Improve(const Part& part, const Vector3d& q,
                              NearestContact* nearest) const {
  // Rounded, as the distance is: a tie is looked at.
  const double bound =
      kCertainShare * std::sqrt(part.bvh->tree().nodes()[0].SquaredDistance(q));
  if (!(bound < nearest->distance)) return;
  const TriangleBvh::Closest closest = part.bvh->FindClosest(q);
  if (!(closest.distance < nearest->distance)) return;
  nearest->distance = closest.distance;
  nearest->point = PointOn(part.mesh, closest.triangle, closest.lambda);
  nearest->normal = part.normals[static_cast<std::size_t>(closest.triangle)];
  nearest->is_in_facet = closest.lambda.minCoeff() > 0.0;
}

NearestContact ExploredSurface::FindNearest(const Vector3d& q) {
  NearestContact nearest;
  for (const Part& part : parts_) Improve(part, q, &nearest);
  const double step = boxes_.frame().step;
  const Vector3d x = boxes_.frame().ToGrid(q);
  const BoundingBox all = boxes_.bounds();
  double reach = kFirstReach * (all.max - all.min).maxCoeff();
  const Stopwatch stopwatch;
  bool is_extended = false;
  for (;; reach *= kMoreReach) {
    // Nothing beyond a point that is known is of interest.
    const bool is_last = nearest.distance < reach * step;
    if (is_last) reach = nearest.distance / step / kCertainShare;
    for (const auto& [distance, box] : Unknown(x, reach)) {
      if (kCertainShare * distance * step > nearest.distance) break;
      if (!is_extended) boxes_.RestartLimits();
      is_extended = true;
      const std::size_t before = parts_.size();
      Explore(box);
      if (parts_.size() > before) Improve(parts_.back(), q, &nearest);
    }
    if (is_last || nearest.distance <= kCertainShare * reach * step) break;
    if ((x.array() - reach < all.min.array()).all() &&
        (x.array() + reach > all.max.array()).all()) {
      break;
    }
  }
  if (is_extended) {
    ++use_.extensions;
    use_.seconds += stopwatch.Seconds();
  }
  if (!std::isfinite(nearest.distance)) {
    throw std::logic_error("no contact around a position that is not free");
  }
  return nearest;
}

SmoothedNormal ExploredSurface::Sum(const Vector3d& x) {
  const auto unknown = Unknown(boxes_.frame().ToGrid(x),
                               radius_ / boxes_.frame().step / kCertainShare);
  if (!unknown.empty()) {
    const Stopwatch stopwatch;
    boxes_.RestartLimits();
    for (const auto& [distance, box] : unknown) Explore(box);
    ++use_.extensions;
    use_.seconds += stopwatch.Seconds();
  }
  SmoothedNormal sum;
  for (const Part& part : parts_) {
    if (part.bvh->tree().nodes()[0].SquaredDistance(x) <
        radius_ * radius_ / kCertainShare) {
      sum += part.sums->At(x);
    }
  }
  return sum;
}

}  // namespace phongpd::internal
