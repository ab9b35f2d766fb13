// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/touching_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/minkowski/convolution/symbolic_turn.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Relative bound on a double dot product of a rounded normal with an exact
// vector: three products and two sums of terms rounded once, with room.
constexpr double kDotError = 1e-14;

}  // namespace

VertexStars::VertexStars(const GridSolid& s) {
  begin.reserve(s.vertices.size() + 1);
  for (std::size_t v = 0; v < s.vertices.size(); ++v) {
    begin.push_back(static_cast<int>(rays.size()));
    for (const int w : s.neighbors[v]) {
      exact.push_back(s.vertices[w] - s.vertices[v]);
      rays.push_back(ToDouble(exact.back()));
    }
  }
  begin.push_back(static_cast<int>(rays.size()));
}

std::vector<GaussCap> VertexCaps(const GridSolid& s) {
  std::vector<std::vector<Vector3d>> normals(s.vertices.size());
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    const Vector3d n = ToDouble(s.normals[f]).normalized();
    for (const int v : s.facets[f]) normals[v].push_back(n);
  }
  std::vector<GaussCap> caps;
  caps.reserve(normals.size());
  for (const std::vector<Vector3d>& around : normals) {
    caps.push_back(CapAround(around.data(), around.size()));
  }
  return caps;
}

TouchingFacet::TouchingFacet(const GridNormal& normal, int turn)
    : exact_(normal),
      rounded_(ToDouble(normal)),
      unit_(rounded_.normalized()),
      bound_(rounded_.lpNorm<1>() * kDotError),
      turn_(turn) {}

bool TouchingFacet::Touches(const VertexStars& stars, int v) const {
  const int begin = stars.begin[v], end = stars.begin[v + 1];
  if (begin == end) return false;
  bool is_clear = true;
  for (int k = begin; k < end; ++k) {
    const Vector3d& d = stars.rays[k];
    const double side = rounded_.dot(d);
    const double error = bound_ * d.lpNorm<1>();
    if (side > error) return false;
    if (side >= -error) is_clear = false;
  }
  if (is_clear) return true;
  // Exact arithmetic only where no clear sign has decided.
  for (int k = begin; k < end; ++k) {
    const Vector3d& d = stars.rays[k];
    if (rounded_.dot(d) < -bound_ * d.lpNorm<1>()) continue;
    int sign = Sign(Dot(exact_, stars.exact[k]));
    if (sign == 0) sign = turn_ * TurnedSign(exact_, stars.exact[k]);
    if (sign >= 0) return false;
  }
  return true;
}

std::vector<ConvexEdge> ConvexEdges(const GridSolid& s) {
  std::vector<ConvexEdge> edges;
  for (const GridEdge& e : s.edges) {
    const GridPoint& a = s.vertices[e.a];
    if (Dot(s.normals[e.left], s.vertices[e.right_apex] - a) >= 0) continue;
    ConvexEdge c;
    c.a = e.a;
    c.b = e.b;
    c.exact[0] = s.vertices[e.b] - a;
    c.exact[1] = s.vertices[e.left_apex] - a;
    c.exact[2] = s.vertices[e.right_apex] - a;
    for (int k = 0; k < 3; ++k) c.rounded[k] = ToDouble(c.exact[k]);
    c.left_normal = ToDouble(s.normals[e.left]).normalized();
    c.right_normal = ToDouble(s.normals[e.right]).normalized();
    edges.push_back(c);
  }
  return edges;
}

GaussCap ArcCap(const ConvexEdge& e) {
  const Vector3d normals[2] = {e.left_normal, e.right_normal};
  return CapAround(normals, 2);
}

std::vector<GaussCap> ArcCaps(const std::vector<ConvexEdge>& edges) {
  std::vector<GaussCap> caps;
  caps.reserve(edges.size());
  for (const ConvexEdge& e : edges) caps.push_back(ArcCap(e));
  return caps;
}

int CommonSide(const ConvexEdge& e, const ConvexEdge& g) {
  const Vector3d n = e.rounded[0].cross(g.rounded[0]);
  const double error =
      (n.lpNorm<1>() + e.rounded[0].lpNorm<Eigen::Infinity>() *
                           g.rounded[0].lpNorm<Eigen::Infinity>()) *
      kDotError;
  const Vector3d* apices[4] = {&e.rounded[1], &e.rounded[2], &g.rounded[1],
                               &g.rounded[2]};
  int signs[4], common = 0;
  for (int k = 0; k < 4; ++k) {
    const double side = n.dot(*apices[k]);
    const bool clear = std::abs(side) > error * apices[k]->lpNorm<1>();
    signs[k] = clear ? Sign(side) : 0;
    if (signs[k] == 0) continue;
    if (common != 0 && signs[k] != common) return 0;
    common = signs[k];
  }
  // Exact arithmetic only where no clear sign has decided.
  const GridNormal exact = Cross(e.exact[0], g.exact[0]);
  if (IsZero(exact)) return 0;  // parallel: a parallelogram without area
  for (int k = 0; k < 4; ++k) {
    if (signs[k] != 0) continue;
    const bool of_q = k >= 2;
    const GridPoint& apex = (of_q ? g : e).exact[1 + k % 2];
    int sign = Sign(Dot(exact, apex));
    // (e × g)·o = g·(o × e) = e·(g × o): the other edge against the normal of
    // the apex's facet, with P or Q turned.
    if (sign == 0) {
      sign = of_q ? -TurnedSign(Cross(g.exact[0], apex), e.exact[0])
                  : TurnedSign(Cross(apex, e.exact[0]), g.exact[0]);
    }
    if (common != 0 && sign != common) return 0;
    common = sign;
  }
  return common;
}

}  // namespace phongpd::internal
