// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/free_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/bvh/exact_sign.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/unit_normal.h"
#include "core/solid/shell_orientation.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Directions without any relation to each other, to axes or to diagonals.  The
// first one decides nearly always: the others are for pieces whose ray meets an
// edge, and a dozen costs nothing where they are not asked.
constexpr int kDirections = 12;
Vector3d Direction(int k) {
  // Spherical Fibonacci points, turned so that none is special.
  const double z = 1.0 - (2.0 * k + 0.937) / kDirections;
  const double angle = 2.39996322972865332 * k + 0.7310585786300049;
  const double r = std::sqrt(1.0 - z * z);
  const Vector3d d(r * std::cos(angle), r * std::sin(angle), z);
  return Eigen::AngleAxisd(1.1180339887, Vector3d(0.36, 0.48, 0.8)) * d;
}

// Triangles at a piece's extreme corner that a ray may begin on, roomiest
// first, and the roomiest of all: of slivers around one corner more would fail
// alike.
constexpr int kTriesPerDirection = 4;

}  // namespace

FreeCells::FreeCells(const TriangleMesh& mesh,
                     const std::vector<std::array<int, 3>>& neighbors,
                     const TriangleBvh& segments)
    : mesh_(mesh), segments_(segments), bounds_(ComputeBounds(mesh)) {
  const double largest = std::max(bounds_.min.cwiseAbs().maxCoeff(),
                                  bounds_.max.cwiseAbs().maxCoeff());
  rounding_ = std::ldexp(largest, -46);
  int pieces = 0;
  piece_ = internal::LabelShells(neighbors, &pieces);
  rays_.resize(pieces);
  std::vector<std::vector<int>> triangles(rays_.size());
  for (std::size_t t = 0; t < piece_.size(); ++t) {
    triangles[piece_[t]].push_back(static_cast<int>(t));
  }
  // One direction for all, so that chains climb.
  while (direction_ < kDirections && !CastRays(triangles, direction_)) {
    ++direction_;
  }
  if (direction_ == kDirections) {
    // There is none: pieces for which the first is not generic take another.
    direction_ = 0;
    CastRays(triangles, direction_);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      for (int k = 1; k < kDirections; ++k) {
        if (rays_[i].end != CellRay::End::kUndecided) break;
        rays_[i] = RayOfPiece(triangles[i], Direction(k));
      }
    }
  }
  FollowChains();
}

// True if all are decided.
bool FreeCells::CastRays(const std::vector<std::vector<int>>& triangles,
                         int direction) {
  bool decided = true;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    rays_[i] = RayOfPiece(triangles[i], Direction(direction));
    decided = decided && rays_[i].end != CellRay::End::kUndecided;
  }
  return decided;
}

// Where the segment crosses triangles, in order; false if it comes within
// rounding of an edge, or its ends of a triangle.
bool FreeCells::Cast(const Vector3d& a, const Vector3d& b,
                     std::vector<Crossing>* crossings) const {
  bool clear = true;
  segments_.ForEachDoubt(a, b, rounding_, [&](int, double distance) {
    clear = clear && distance > rounding_;
  });
  if (!clear) return false;
  crossings->clear();
  const Vector3d along = b - a;
  segments_.ForEachHit(a, b, [&](int triangle, double fraction) {
    const Vector3d normal = UnitNormal(mesh_, mesh_.triangles[triangle]);
    crossings->push_back(
        {triangle, fraction, 2.0 * rounding_ / std::abs(normal.dot(along))});
  });
  std::sort(crossings->begin(), crossings->end(),
            [](const Crossing& x, const Crossing& y) {
              return x.fraction < y.fraction;
            });
  return true;
}

double FreeCells::Top(const Vector3d& direction) const {
  return bounds_.max.dot(direction.cwiseMax(0.0)) +
         bounds_.min.dot(direction.cwiseMin(0.0));
}

bool FreeCells::IsAbove(const Vector3d& p) const {
  const Vector3d direction = Direction(direction_);
  return p.dot(direction) > Top(direction) + 0.01 * bounds_.Diagonal();
}

Vector3d FreeCells::Beyond(const Vector3d& from,
                           const Vector3d& direction) const {
  // All rays of a direction end in one plane, which nothing reaches.
  const double top = Top(direction) + 0.05 * bounds_.Diagonal();
  return from + std::max(top - from.dot(direction), 0.05 * bounds_.Diagonal()) *
                    direction;
}

CellRay FreeCells::RayOfPiece(const std::vector<int>& triangles,
                              const Vector3d& direction) const {
  // Near the extreme vertex; of its triangles those with most room first.
  double top = -std::numeric_limits<double>::infinity();
  int extreme = -1;
  for (const int t : triangles) {
    for (const int v : mesh_.triangles[t]) {
      const double height = mesh_.vertices[v].dot(direction);
      if (height > top) {
        top = height;
        extreme = v;
      }
    }
  }
  const auto room = [&](int triangle) {
    const Triangle& t = mesh_.triangles[triangle];
    const Vector3d u = mesh_.vertices[t[1]] - mesh_.vertices[t[0]];
    const Vector3d v = mesh_.vertices[t[2]] - mesh_.vertices[t[0]];
    const double perimeter = u.norm() + v.norm() + (u - v).norm();
    return perimeter > 0.0 ? std::abs(u.cross(v).dot(direction)) / perimeter
                           : 0.0;
  };
  std::vector<std::pair<double, int>> candidates;
  std::pair<double, int> roomiest = {0.0, -1};
  for (const int triangle : triangles) {
    const Triangle& t = mesh_.triangles[triangle];
    const std::pair<double, int> candidate = {-room(triangle), triangle};
    roomiest = std::min(roomiest, candidate);
    if (std::find(t.begin(), t.end(), extreme) != t.end()) {
      candidates.push_back(candidate);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  if (candidates.size() > kTriesPerDirection) {
    candidates.resize(kTriesPerDirection);
  }
  if (roomiest.second >= 0) candidates.push_back(roomiest);
  for (const auto& [minus_room, triangle] : candidates) {
    if (!(-minus_room > 4.0 * rounding_)) continue;
    const CellRay ray = RayThrough(triangle, direction);
    if (ray.end != CellRay::End::kUndecided) return ray;
  }
  return {};
}

CellRay FreeCells::RayThrough(int triangle, const Vector3d& direction) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vector3d& p = mesh_.vertices[t[0]];
  const Vector3d& q = mesh_.vertices[t[1]];
  const Vector3d& r = mesh_.vertices[t[2]];
  // The incentre, and a start behind it by the size of the triangle.
  const double pq = (q - p).norm(), qr = (r - q).norm(), rp = (p - r).norm();
  const Vector3d center = p + (rp * (q - p) + pq * (r - p)) / (pq + qr + rp);
  const Vector3d a = center - (pq + qr + rp) * direction;
  const Vector3d b = Beyond(center, direction);
  std::vector<Crossing> crossings;
  CellRay ray;
  if (!Cast(a, b, &crossings)) return ray;
  const int piece = piece_[triangle];
  int last = -1;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (piece_[crossings[i].triangle] == piece) last = static_cast<int>(i);
  }
  if (last < 0) return ray;
  // Its order must be certain, and that of what comes next.
  const auto certain = [&](int i) {
    for (std::size_t j = 0; j < crossings.size(); ++j) {
      if (static_cast<int>(j) != i &&
          std::abs(crossings[j].fraction - crossings[i].fraction) <=
              crossings[j].slack + crossings[i].slack) {
        return false;
      }
    }
    return true;
  };
  const auto in_front = [&](int i, const Vector3d& x) {
    const Triangle& s = mesh_.triangles[crossings[i].triangle];
    return Orient3d(mesh_.vertices[s[0]].data(), mesh_.vertices[s[1]].data(),
                    mesh_.vertices[s[2]].data(), x.data()) > 0;
  };
  if (!certain(last)) return ray;
  const Vector3d along = b - a;
  ray.from_triangle = crossings[last].triangle;
  ray.from = a + crossings[last].fraction * along;
  ray.to = b;
  if (!in_front(last, b)) {
    ray.end = CellRay::End::kShell;
    ray.to = ray.from;
  } else if (last + 1 == static_cast<int>(crossings.size())) {
    ray.end = CellRay::End::kOutside;
  } else if (certain(last + 1) && in_front(last + 1, a)) {
    ray.end = CellRay::End::kSurface;
    ray.to_triangle = crossings[last + 1].triangle;
    ray.to = a + crossings[last + 1].fraction * along;
  }
  return ray;
}

CellRay FreeCells::RayFrom(const Vector3d& q, const Vector3d& direction) const {
  const Vector3d b = Beyond(q, direction);
  std::vector<Crossing> crossings;
  CellRay ray;
  if (!Cast(q, b, &crossings)) return ray;
  ray.from = q;
  ray.to = b;
  if (crossings.empty()) {
    ray.end = CellRay::End::kOutside;
    return ray;
  }
  const Crossing& first = crossings.front();
  for (std::size_t j = 1; j < crossings.size(); ++j) {
    if (crossings[j].fraction - crossings[j].slack <=
        first.fraction + first.slack) {
      return ray;
    }
  }
  const Triangle& t = mesh_.triangles[first.triangle];
  if (Orient3d(mesh_.vertices[t[0]].data(), mesh_.vertices[t[1]].data(),
               mesh_.vertices[t[2]].data(), q.data()) > 0) {
    ray.end = CellRay::End::kSurface;
    ray.to_triangle = first.triangle;
    ray.to = q + first.fraction * (b - q);
  }
  return ray;
}

void FreeCells::FollowChains() {
  constexpr int kUnknown = -3, kOnTheWay = -4;
  cell_.assign(rays_.size(), kUnknown);
  std::vector<int> chain;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    int piece = static_cast<int>(i);
    chain.clear();
    while (cell_[piece] == kUnknown &&
           rays_[piece].end == CellRay::End::kSurface) {
      cell_[piece] = kOnTheWay;
      chain.push_back(piece);
      piece = piece_[rays_[piece].to_triangle];
    }
    int cell = cell_[piece];
    if (cell == kUnknown) {
      const CellRay::End end = rays_[piece].end;
      cell = end == CellRay::End::kShell     ? piece
             : end == CellRay::End::kOutside ? kOutside
                                             : kUndecided;
      cell_[piece] = cell;
    }
    // Back to where it came by: a circle, which takes pieces that needed
    // different directions.
    if (cell == kOnTheWay) cell = kUndecided;
    for (const int link : chain) cell_[link] = cell;
  }
}

std::vector<int> FreeCells::Chain(int piece) const {
  std::vector<int> chain = {piece};
  while (rays_[chain.back()].end == CellRay::End::kSurface &&
         chain.size() <= rays_.size()) {
    chain.push_back(piece_[rays_[chain.back()].to_triangle]);
  }
  return chain;
}

int FreeCells::CellOf(const Vector3d& q, CellRay* ray) const {
  for (int k = 0; k < kDirections; ++k) {
    *ray = RayFrom(q, Direction((direction_ + k) % kDirections));
    if (ray->end == CellRay::End::kOutside) return kOutside;
    if (ray->end != CellRay::End::kSurface) continue;
    const int cell = cell_[piece_[ray->to_triangle]];
    if (cell != kUndecided) return cell;
  }
  return kUndecided;
}

}  // namespace phongpd
