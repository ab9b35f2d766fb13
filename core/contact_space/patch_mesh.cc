// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/patch_mesh.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using LongVector = Eigen::Matrix<long double, 3, 1>;

// Sines below this are rounding errors of angles between unit vectors.
constexpr double kSineError = 1e-12;
// A walk through a Delaunay patch cannot loop; through one that rounding
// errors keep from being Delaunay it could.
constexpr int kMaxSteps = 100000;

int Next(int k) { return (k + 1) % 3; }

}  // namespace

PatchMesh::PatchMesh(const ContactSpace& space)
    : points_(space.mesh.vertices),
      places_(points_.size()),
      triangles_(space.mesh.triangles),
      neighbors_(TriangleNeighbors(space.mesh)) {
  for (const auto& around : neighbors_) {
    for (const int o : around) {
      if (o < 0)
        throw std::logic_error("refinement: the surface is not closed");
    }
  }
  int exponent = 0;
  std::frexp(ComputeBounds(space.mesh).Diagonal(), &exponent);
  scale_ = std::ldexp(1.0, 1 - exponent);
  for (Vector3d& p : points_) p *= scale_;
  MakePatches(space);
  frozen_.assign(triangles_.size(), 0);
  for (int t = 0; t < Count(); ++t) {
    frozen_[t] = !Turns(patch_of_[t], Point(t, 0), Point(t, 1), Point(t, 2));
  }
}

void PatchMesh::MakePatches(const ContactSpace& space) {
  patch_of_.assign(triangles_.size(), -1);
  std::vector<int> stack;
  for (int seed = 0; seed < Count(); ++seed) {
    if (patch_of_[seed] >= 0) continue;
    const int id = static_cast<int>(patches_.size());
    std::vector<Vector3d> corners;
    patch_of_[seed] = id;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int t = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) corners.push_back(Point(t, k));
      for (const int o : neighbors_[t]) {
        if (patch_of_[o] >= 0 || space.plane[o] != space.plane[seed] ||
            space.kind[o] != space.kind[seed]) {
          continue;
        }
        patch_of_[o] = id;
        stack.push_back(o);
      }
    }
    patches_.push_back(
        {space.plane[seed], space.kind[seed], PatchPlane(corners)});
  }
}

bool PatchMesh::Turns(int patch, const Vector3d& a, const Vector3d& b,
                      const Vector3d& c) const {
  return patches_[patch].plane.Turn(a, b, c) > 0;
}

PatchMesh::Edge PatchMesh::Opposite(Edge e) const {
  const int o = neighbors_[e.triangle][e.k];
  const int end = triangles_[e.triangle][Next(e.k)];
  int k = 0;
  while (triangles_[o][k] != end) ++k;
  return {o, k};
}

std::vector<std::pair<Vector3d, Vector3d>> PatchMesh::SharpEdges(
    double angle) const {
  std::vector<std::pair<Vector3d, Vector3d>> edges;
  for (int t = 0; t < Count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int o = neighbors_[t][k];
      if (o < t || patch_of_[o] == patch_of_[t]) continue;
      const Vector3d& n = patches_[patch_of_[t]].plane.normal();
      const Vector3d& m = patches_[patch_of_[o]].plane.normal();
      if (std::atan2(n.cross(m).norm(), n.dot(m)) < angle) continue;
      edges.emplace_back(Point(t, k), Point(t, k + 1));
    }
  }
  return edges;
}

PatchMesh::Edge PatchMesh::Walk(int t, const Vector3d& x) const {
  int last = -1;
  for (int step = 0; step < kMaxSteps; ++step) {
    int crossed = -1;
    for (int k = 0; k < 3 && crossed < 0; ++k) {
      const Vector3d &a = Point(t, k), &b = Point(t, k + 1);
      if (neighbors_[t][k] == last) continue;
      if (Plane(t).Turn(a, b, x) < 0) crossed = k;
    }
    if (crossed < 0) return {t, -1};
    if (IsFixed({t, crossed})) return {t, crossed};
    last = t;
    t = neighbors_[t][crossed];
  }
  return {};
}

bool PatchMesh::InCircle(const Vector3d& a, const Vector3d& b,
                         const Vector3d& c, const Vector3d& d) {
  const Vector3d ca = (a - c).normalized(), cb = (b - c).normalized();
  const Vector3d da = (a - d).normalized(), db = (b - d).normalized();
  // sin(∠c + ∠d) < 0: together more than 180°.
  return ca.cross(cb).norm() * da.dot(db) + ca.dot(cb) * da.cross(db).norm() <
         -kSineError;
}

PatchMesh::EdgePlace PatchMesh::MiddleOf(int a, int b) const {
  // A part of an original edge has at least one end that was put there, which
  // knows the edge; the other one was too, or is an original end.
  const EdgePlace &at_a = places_[a], &at_b = places_[b];
  if (at_a.a < 0 && at_b.a < 0) return {a, b, 0.5};
  const EdgePlace& known = at_a.a >= 0 ? at_a : at_b;
  const auto parameter = [&](int vertex, const EdgePlace& place) {
    if (place.a >= 0) return place.t;
    return vertex == known.a ? 0.0 : 1.0;
  };
  return {known.a, known.b, 0.5 * (parameter(a, at_a) + parameter(b, at_b))};
}

int PatchMesh::AddTriangle(int patch) {
  triangles_.push_back({});
  neighbors_.push_back({});
  patch_of_.push_back(patch);
  frozen_.push_back(0);
  return Count() - 1;
}

void PatchMesh::Set(int t, const std::array<int, 3>& vertices,
                    const std::array<int, 3>& neighbors) {
  triangles_[t] = vertices;
  neighbors_[t] = neighbors;
}

// Tells triangle t that beyond its edge from → to there is `neighbor` now.
void PatchMesh::Relink(int t, int from, int to, int neighbor) {
  for (int k = 0; k < 3; ++k) {
    if (triangles_[t][k] == from && triangles_[t][Next(k)] == to) {
      neighbors_[t][k] = neighbor;
    }
  }
}

bool PatchMesh::SplitEdge(Edge e, std::vector<int>* changed) {
  if (!CanSplit(e)) return false;
  const Edge f = Opposite(e);
  const int t = e.triangle, o = f.triangle;
  const int a = triangles_[t][e.k], b = triangles_[t][Next(e.k)];
  const int c = triangles_[t][Next(e.k + 1)], d = triangles_[o][Next(f.k + 1)];
  EdgePlace place;
  Vector3d x;
  if (IsFixed(e)) {
    place = MiddleOf(a, b);
    const LongVector start = points_[place.a].cast<long double>();
    const LongVector end = points_[place.b].cast<long double>();
    const auto part = static_cast<long double>(place.t);
    x = LongVector(start + part * (end - start)).cast<double>();
  } else {
    x = Plane(t).Nearest(0.5 * (points_[a] + points_[b]));
  }
  const int p = patch_of_[t], q = patch_of_[o];
  if (!Turns(p, points_[a], x, points_[c]) ||
      !Turns(p, x, points_[b], points_[c]) ||
      !Turns(q, points_[b], x, points_[d]) ||
      !Turns(q, x, points_[a], points_[d])) {
    return false;
  }
  const int m = static_cast<int>(points_.size());
  points_.push_back(x);
  places_.push_back(place);
  const int bc = neighbors_[t][Next(e.k)], ca = neighbors_[t][Next(e.k + 1)];
  const int ad = neighbors_[o][Next(f.k)], db = neighbors_[o][Next(f.k + 1)];
  const int t2 = AddTriangle(p), o2 = AddTriangle(q);
  Set(t, {a, m, c}, {o2, t2, ca});
  Set(t2, {m, b, c}, {o, bc, t});
  Set(o, {b, m, d}, {t2, o2, db});
  Set(o2, {m, a, d}, {t, ad, o});
  Relink(bc, c, b, t2);
  Relink(ad, d, a, o2);
  changed->insert(changed->end(), {t, t2, o, o2});
  return true;
}

bool PatchMesh::InsertPoint(int t, const Vector3d& x,
                            std::vector<int>* changed) {
  const auto [a, b, c] = triangles_[t];
  const int patch = patch_of_[t];
  if (frozen_[t] || !Turns(patch, points_[a], points_[b], x) ||
      !Turns(patch, points_[b], points_[c], x) ||
      !Turns(patch, points_[c], points_[a], x)) {
    return false;
  }
  const int m = static_cast<int>(points_.size());
  points_.push_back(x);
  places_.push_back({});
  const auto [ab, bc, ca] = neighbors_[t];
  const int t2 = AddTriangle(patch), t3 = AddTriangle(patch);
  Set(t, {a, b, m}, {ab, t2, t3});
  Set(t2, {b, c, m}, {bc, t3, t});
  Set(t3, {c, a, m}, {ca, t, t2});
  Relink(bc, c, b, t2);
  Relink(ca, a, c, t3);
  changed->insert(changed->end(), {t, t2, t3});
  return true;
}

// Does an edge join the start of `at` to `other`?
bool PatchMesh::AreJoined(Edge at, int other) const {
  const int center = triangles_[at.triangle][at.k];
  Edge e = at;
  do {
    if (triangles_[e.triangle][Next(e.k)] == other) return true;
    const int o = neighbors_[e.triangle][e.k];
    int k = 0;
    while (triangles_[o][k] != center) ++k;
    e = {o, k};
  } while (e.triangle != at.triangle);
  return false;
}

bool PatchMesh::Flip(Edge e) {
  const Edge f = Opposite(e);
  const int t = e.triangle, o = f.triangle, patch = patch_of_[t];
  const int a = triangles_[t][e.k], b = triangles_[t][Next(e.k)];
  const int c = triangles_[t][Next(e.k + 1)], d = triangles_[o][Next(f.k + 1)];
  if (!Turns(patch, points_[c], points_[a], points_[d]) ||
      !Turns(patch, points_[d], points_[b], points_[c]) ||
      AreJoined({t, Next(e.k + 1)}, d)) {
    return false;
  }
  const int bc = neighbors_[t][Next(e.k)], ca = neighbors_[t][Next(e.k + 1)];
  const int ad = neighbors_[o][Next(f.k)], db = neighbors_[o][Next(f.k + 1)];
  Set(t, {c, a, d}, {ca, ad, o});
  Set(o, {d, b, c}, {db, bc, t});
  Relink(ad, d, a, t);
  Relink(bc, c, b, o);
  return true;
}

void PatchMesh::Legalize(std::vector<int>* changed) {
  std::vector<int> stack = *changed;
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Edge e{t, k};
      if (IsFixed(e)) continue;
      const Edge f = Opposite(e);
      if (!InCircle(Point(t, k), Point(t, k + 1), Point(t, k + 2),
                    Point(f.triangle, f.k + 2)) ||
          !Flip(e)) {
        continue;
      }
      changed->insert(changed->end(), {t, f.triangle});
      stack.insert(stack.end(), {f.triangle, t});
      break;
    }
  }
}

void PatchMesh::Store(ContactSpace* space) const {
  space->mesh.vertices = points_;
  for (Vector3d& p : space->mesh.vertices) p /= scale_;
  space->mesh.triangles = triangles_;
  space->plane.clear();
  space->kind.clear();
  for (const int patch : patch_of_) {
    space->plane.push_back(patches_[patch].plane_id);
    space->kind.push_back(patches_[patch].kind);
  }
}

}  // namespace phongpd::internal
