// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/convolution_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bvh/segment_reach.h"
#include "core/bvh/separators.h"
#include "core/mesh/finite.h"
#include "core/mesh/numbers.h"
#include "core/minkowski/convolution/convolution.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Of a radius: what rounding between the frames may take of it.
constexpr double kRadiusSlack = 1.0 + 0x1p-40;

}  // namespace

ConvolutionSpace::ConvolutionSpace(const GridPair& pair,
                                   std::function<double()> max_mib)
    : pair_(pair),
      judge_(pair.obstacle, pair.reflected_robot),
      cells_(pair.obstacle, pair.reflected_robot, std::move(max_mib)) {}

Vector3d ConvolutionSpace::ToGrid(const Vector3d& q) const {
  return RoundedToFractions(pair_.frame.ToGrid(q));
}

bool ConvolutionSpace::IsFree(const Vector3d& q) const {
  const Vector3d x = ToGrid(q);
  if (!IsFinite(x)) return false;
  const BoundingBox& box = cells_.bounds();
  const bool is_within = (x.array() >= box.min.array()).all() &&
                         (x.array() <= box.max.array()).all();
  return !is_within || !judge_.Collide(x);
}

bool ConvolutionSpace::IsFree(const Vector3d& a, const Vector3d& b) const {
  const Vector3d from = ToGrid(a), to = ToGrid(b);
  if (!IsFinite(to) || !IsFree(a)) return false;
  const SegmentReach reach(from, to, cells_.largest());
  bool meets = false;
  cells_.NearestFirst(
      1.0,
      [&](const BoxTree::Node& box) {
        return reach.Meets(box) ? reach.Entry(box) - 1.0 : kInfinity;
      },
      [&](const ConvolutionCells::Leaf& leaf) {
        meets = leaf.bvh.Meets(from, to);
        return meets ? -kInfinity : 1.0;
      });
  return !meets;
}

double ConvolutionSpace::FirstContact(const Vector3d& a,
                                      const Vector3d& b) const {
  const Vector3d from = ToGrid(a), to = ToGrid(b);
  if (!IsFinite(to)) return 0.0;
  const SegmentReach reach(from, to, cells_.largest());
  double first = 2.0;
  cells_.NearestFirst(
      first,
      [&](const BoxTree::Node& box) {
        return reach.Meets(box) ? reach.Entry(box) : kInfinity;
      },
      [&](const ConvolutionCells::Leaf& leaf) {
        const TriangleBvh::Hit hit = leaf.bvh.FirstHit(from, to);
        if (hit.Found()) first = std::min(first, hit.fraction);
        return first;
      });
  return first;
}

ConvolutionSpace::Nearest ConvolutionSpace::FindNearest(
    const Vector3d& q) const {
  const Vector3d x = ToGrid(q);
  double least = kInfinity;
  Vector3d nearest = Vector3d::Zero();
  cells_.NearestFirst(
      kInfinity,
      [&](const BoxTree::Node& box) {
        return std::sqrt(box.SquaredDistance(x));
      },
      [&](const ConvolutionCells::Leaf& leaf) {
        const TriangleBvh::Closest closest = leaf.bvh.FindClosest(x);
        if (closest.distance < least) {
          least = closest.distance;
          const Triangle& t = leaf.mesh.triangles[closest.triangle];
          nearest.setZero();
          for (int k = 0; k < 3; ++k) {
            nearest += closest.lambda[k] * leaf.mesh.vertices[t[k]];
          }
        }
        return least;
      });
  return {pair_.frame.ToUser(nearest), least * pair_.frame.step};
}

double ConvolutionSpace::Distance(const Vector3d& a, const Vector3d& b,
                                  double limit) const {
  const Vector3d from = ToGrid(a), to = ToGrid(b);
  const double step = pair_.frame.step;
  const SegmentReach reach(from, to, cells_.largest());
  double least = limit / step;
  cells_.NearestFirst(
      least,
      [&](const BoxTree::Node& box) {
        return std::isinf(least) || reach.Meets(box, least) ? reach.Gap(box)
                                                            : kInfinity;
      },
      [&](const ConvolutionCells::Leaf& leaf) {
        return least = leaf.bvh.Distance(from, to, least);
      });
  return std::min(limit, step * least);
}

std::vector<TriangleCorners> ConvolutionSpace::FindSeparating(
    const Vector3d& a, const Vector3d& b, double radius, double slack) const {
  const Vector3d from = ToGrid(a), to = ToGrid(b);
  if (!IsFinite(from) || !IsFinite(to)) return {};
  // In grid steps the segment is rounded by less than one.
  const double step = pair_.frame.step;
  SeparatorSearch search(from, to, kRadiusSlack * radius / step + 1.0,
                         slack / step);
  cells_.BestFirst(
      [&](const BoxTree::Node& box) { return search.Gap(box); },
      [&](double gap, const BoxTree::Node& box) {
        search.AdvanceTo(gap);
        return search.Needs(box);
      },
      [&](const ConvolutionCells::Leaf& leaf) { search.Add(leaf.bvh); },
      [&] { search.AdvanceTo(kInfinity); });
  std::vector<TriangleCorners> facets;
  for (const Separator& found : search.found()) {
    TriangleCorners& t = facets.emplace_back(found.corners);
    for (Vector3d& q : t) q = pair_.frame.ToUser(q);
  }
  return facets;
}

BoundingBox ConvolutionSpace::Bounds() const {
  // A box of sums is the sum of boxes in any frame; one of the grid's corners
  // is no corner of it where the grid is turned.
  const Vector3d origin = pair_.frame.ToUser(Vector3d::Zero());
  BoundingBox sum{origin, origin};
  for (const GridSolid* solid : {&pair_.obstacle, &pair_.reflected_robot}) {
    BoundingBox box{Vector3d::Constant(kInfinity),
                    Vector3d::Constant(-kInfinity)};
    for (const Triangle& t : solid->facets) {
      for (const int v : t) {
        const Vector3d q = pair_.frame.ToUser(ToDouble(solid->vertices[v]));
        box.min = box.min.cwiseMin(q);
        box.max = box.max.cwiseMax(q);
      }
    }
    sum.min += box.min - origin;
    sum.max += box.max - origin;
  }
  return sum;
}

TriangleMesh ConvolutionSpace::Mesh() const {
  const Convolution all =
      ReducedConvolution(pair_.obstacle, pair_.reflected_robot);
  TriangleMesh mesh;
  mesh.vertices.reserve(all.points.size());
  for (const GridPoint& p : all.points) {
    mesh.vertices.push_back(pair_.frame.ToUser(ToDouble(p)));
  }
  mesh.triangles.reserve(all.facets.size());
  for (const ConvolutionFacet& f : all.facets) {
    mesh.triangles.push_back(f.corners);
  }
  return mesh;
}

}  // namespace phongpd::internal
