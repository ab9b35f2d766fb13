// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/exact_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace phongpd::internal {
namespace {

// Side of a hash cell, grid steps; far above kPointError, so that a point
// rarely needs to look into a second cell.
constexpr double kCell = 4.0;

std::uint64_t Mix(std::uint64_t h, std::uint64_t value) {
  h = (h ^ value) * 0x9E3779B97F4A7C15ULL;
  return h ^ (h >> 31);
}

int SignOf(const Wide& value) { return value.sign(); }

// The double nearest to x/w, w > 0.
double NearestDouble(const Wide& x, const Wide& w) {
  if (x.is_zero()) return 0.0;
  // A quotient of two bits more than a double has, and a last one that says
  // whether anything is left: converting it rounds as the quotient itself.
  constexpr int kBits = 55;
  const Wide magnitude = abs(x);
  const int shift =
      kBits - (static_cast<int>(msb(magnitude)) - static_cast<int>(msb(w)));
  Wide quotient, rest;
  divide_qr(shift > 0 ? Wide(magnitude << shift) : magnitude,
            shift < 0 ? Wide(w << -shift) : w, quotient, rest);
  std::uint64_t digits = 2 * quotient.convert_to<std::uint64_t>();
  if (!rest.is_zero()) digits |= 1;
  const double value = std::ldexp(static_cast<double>(digits), -shift - 1);
  return x < 0 ? -value : value;
}

Wide WideDot(const GridNormal& n, const std::array<Wide, 3>& x) {
  return Wide(n[0]) * x[0] + Wide(n[1]) * x[1] + Wide(n[2]) * x[2];
}

}  // namespace

std::array<Wide, 3> WideCross(const GridNormal& a, const GridNormal& b) {
  return {Wide(a[1]) * Wide(b[2]) - Wide(a[2]) * Wide(b[1]),
          Wide(a[2]) * Wide(b[0]) - Wide(a[0]) * Wide(b[2]),
          Wide(a[0]) * Wide(b[1]) - Wide(a[1]) * Wide(b[0])};
}

GridPoint HomeCell(const Eigen::Vector3d& approximate) {
  GridPoint cell;
  for (int k = 0; k < 3; ++k) {
    cell[k] = std::llround(std::floor(approximate[k] / kCell));
  }
  return cell;
}

std::size_t GridPlaneHash::operator()(const GridPlane& plane) const {
  std::uint64_t h = 0;
  for (const Int128 x :
       {plane.normal[0], plane.normal[1], plane.normal[2], plane.offset}) {
    h = Mix(Mix(h, static_cast<std::uint64_t>(x)),
            static_cast<std::uint64_t>(x >> 64));
  }
  return static_cast<std::size_t>(h);
}

Homogeneous Evaluate(const PointDefinition& point) {
  Homogeneous h;
  switch (point.kind) {
    case PointDefinition::kVertex:
      h.w = 1;
      for (int k = 0; k < 3; ++k) h.x[k] = point.a[k];
      return h;
    case PointDefinition::kEdge:
      h.w = point.side_a - point.side_b;
      for (int k = 0; k < 3; ++k) {
        h.x[k] =
            h.w * point.a[k] + Wide(point.side_a) * (point.b[k] - point.a[k]);
      }
      break;
    case PointDefinition::kPlanes: {
      // Cramer: x = Σ d_i (n_j × n_k) / n_0·(n_1 × n_2).
      for (int i = 0; i < 3; ++i) {
        const auto cross = WideCross(point.planes[(i + 1) % 3].normal,
                                     point.planes[(i + 2) % 3].normal);
        if (i == 0) h.w = WideDot(point.planes[0].normal, cross);
        for (int k = 0; k < 3; ++k) {
          h.x[k] += Wide(point.planes[i].offset) * cross[k];
        }
      }
      break;
    }
  }
  assert(h.w != 0);  // neither parallel planes nor an edge along its plane
  if (h.w < 0) {
    h.w = -h.w;
    for (Wide& x : h.x) x = -x;
  }
  return h;
}

Eigen::Vector3d Approximate(const PointDefinition& point) {
  switch (point.kind) {
    case PointDefinition::kVertex:
      return ToDouble(point.a);
    case PointDefinition::kEdge: {
      // Strictly on both sides, or else t is no fraction.
      assert(Sign(point.side_a) * Sign(point.side_b) < 0);
      const double t = static_cast<double>(point.side_a) /
                       static_cast<double>(point.side_a - point.side_b);
      return ToDouble(point.a) + t * ToDouble(point.b - point.a);
    }
    default: {
      const Homogeneous h = Evaluate(point);
      const double w = h.w.convert_to<double>();
      return {h.x[0].convert_to<double>() / w, h.x[1].convert_to<double>() / w,
              h.x[2].convert_to<double>() / w};
    }
  }
}

LocatedPoint Locate(const PointDefinition& definition) {
  return {definition, Approximate(definition)};
}

Eigen::Vector3d NearestDoubles(const PointDefinition& point, int units) {
  const Homogeneous h = Evaluate(point);
  Eigen::Vector3d nearest;
  for (int k = 0; k < 3; ++k) nearest[k] = NearestDouble(h.x[k], h.w * units);
  return nearest;
}

int CompareCoordinate(const LocatedPoint& p, const LocatedPoint& q, int axis) {
  const double difference = p.approximate[axis] - q.approximate[axis];
  if (std::abs(difference) > 2 * kPointError) return Sign(difference);
  if (p.definition.kind == PointDefinition::kVertex &&
      q.definition.kind == PointDefinition::kVertex) {
    return Sign(p.definition.a[axis] - q.definition.a[axis]);
  }
  const Homogeneous h = Evaluate(p.definition), g = Evaluate(q.definition);
  return SignOf(h.x[axis] * g.w - g.x[axis] * h.w);
}

RoundedPlane::RoundedPlane(const GridPlane& plane)
    : normal_(ToDouble(plane.normal)),
      offset_(static_cast<double>(plane.offset)),
      // kPointError in each coordinate, and rounding of products below
      // 2^39·|n| and of the offset, which is of that size.
      error_(normal_.lpNorm<1>() * 2 * kPointError) {}

int SideOf(const GridPlane& plane, const LocatedPoint& p) {
  const int side = RoundedPlane(plane).Side(p.approximate);
  return side != 0 ? side : ExactSideOf(plane, p.definition);
}

int ExactSideOf(const GridPlane& plane, const PointDefinition& d) {
  switch (d.kind) {
    case PointDefinition::kVertex:
      return Sign(Dot(plane.normal, d.a) - plane.offset);
    case PointDefinition::kEdge: {
      const Int128 va = Dot(plane.normal, d.a) - plane.offset;
      const Int128 vb = Dot(plane.normal, d.b) - plane.offset;
      const int sign =
          SignOf(Wide(d.side_a) * Wide(vb) - Wide(d.side_b) * Wide(va));
      return d.side_a > d.side_b ? sign : -sign;
    }
    default: {
      const Homogeneous h = Evaluate(d);
      return SignOf(WideDot(plane.normal, h.x) - Wide(plane.offset) * h.w);
    }
  }
}

bool SamePoint(const LocatedPoint& p, const LocatedPoint& q) {
  if ((p.approximate - q.approximate).lpNorm<Eigen::Infinity>() >
      2 * kPointError) {
    return false;
  }
  if (p.definition.kind == PointDefinition::kVertex &&
      q.definition.kind == PointDefinition::kVertex) {
    return p.definition.a == q.definition.a;
  }
  if (p.definition.kind == PointDefinition::kPlanes &&
      q.definition.kind == PointDefinition::kPlanes &&
      p.definition.planes == q.definition.planes) {
    return true;  // the usual way to meet a point again
  }
  const Homogeneous h = Evaluate(p.definition), g = Evaluate(q.definition);
  for (int k = 0; k < 3; ++k) {
    if (h.x[k] * g.w != g.x[k] * h.w) return false;
  }
  return true;
}

int ExactPoints::Find(const LocatedPoint& p) const {
  int found = -1;
  ForEachNearCell(p.approximate, [&](const GridPoint& cell) {
    const auto range = cells_.equal_range(cell);
    for (auto it = range.first; it != range.second && found < 0; ++it) {
      const Eigen::Vector3d& other = approximate_[it->second];
      if ((other - p.approximate).lpNorm<Eigen::Infinity>() > 2 * kPointError) {
        continue;
      }
      if (SamePoint((*this)[it->second], p)) found = it->second;
    }
  });
  return found;
}

int ExactPoints::Add(const LocatedPoint& p) {
  const int known = Find(p);
  if (known >= 0) return known;
  const int id = size();
  approximate_.push_back(p.approximate);
  const PointDefinition& d = p.definition;
  const auto enter = [&](std::size_t index) {
    entries_.push_back({d.kind, static_cast<int>(index)});
  };
  switch (d.kind) {
    case PointDefinition::kVertex:
      enter(vertex_points_.size());
      vertex_points_.push_back(d.a);
      break;
    case PointDefinition::kEdge:
      enter(edge_points_.size());
      edge_points_.push_back({d.a, d.b, d.side_a, d.side_b});
      break;
    case PointDefinition::kPlanes: {
      enter(plane_points_.size());
      std::array<int, 3> ids;
      for (int k = 0; k < 3; ++k) {
        const auto [it, is_new] =
            plane_ids_.emplace(d.planes[k], static_cast<int>(planes_.size()));
        if (is_new) planes_.push_back(d.planes[k]);
        ids[k] = it->second;
      }
      plane_points_.push_back(ids);
      break;
    }
  }
  cells_.emplace(HomeCell(p.approximate), id);
  return id;
}

LocatedPoint ExactPoints::operator[](int id) const {
  assert(0 <= id && id < size());
  LocatedPoint p;
  p.approximate = approximate_[id];
  PointDefinition& d = p.definition;
  const Entry& entry = entries_[id];
  d.kind = entry.kind;
  switch (d.kind) {
    case PointDefinition::kVertex:
      d.a = vertex_points_[entry.index];
      break;
    case PointDefinition::kEdge: {
      const EdgePoint& edge = edge_points_[entry.index];
      d.a = edge.a;
      d.b = edge.b;
      d.side_a = edge.side_a;
      d.side_b = edge.side_b;
      break;
    }
    case PointDefinition::kPlanes:
      for (int k = 0; k < 3; ++k) {
        d.planes[k] = planes_[plane_points_[entry.index][k]];
      }
      break;
  }
  return p;
}

}  // namespace phongpd::internal
