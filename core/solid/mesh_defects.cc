// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/mesh_defects.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/mesh/edge_sides.h"
#include "core/mesh/finite.h"
#include "core/mesh/union_find.h"
#include "core/solid/face_pairing.h"
#include "core/solid/self_intersection.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::UsesVertexTwice;

bool IsReadable(const TriangleMesh& mesh) {
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      if (v < 0 || v >= size || !IsFinite(mesh.vertices[v])) return false;
    }
  }
  return true;
}

// The triangles with the first of equal vertices in place of each.
internal::Faces JoinedFaces(const TriangleMesh& mesh) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&mesh](int v) {
    const Vector3d& p = mesh.vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  // Vertices that no triangle uses may be anything.
  order.erase(
      std::remove_if(order.begin(), order.end(),
                     [&](int v) { return !IsFinite(mesh.vertices[v]); }),
      order.end());
  std::stable_sort(order.begin(), order.end(),
                   [&key](int a, int b) { return key(a) < key(b); });
  std::vector<int> first(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_equal = i > 0 && key(order[i - 1]) == key(order[i]);
    first[order[i]] = is_equal ? first[order[i - 1]] : order[i];
  }
  internal::Faces faces = mesh.triangles;
  for (Triangle& t : faces) {
    for (int& v : t) v = first[v];
  }
  return faces;
}

// The mesh as MakeSolid looks at it, triangles numbered as they were.
TriangleMesh AsSolidSees(const TriangleMesh& mesh) {
  TriangleMesh seen = mesh;
  internal::Faces joined = JoinedFaces(mesh);
  if (internal::CountUnpairedEdges(joined) <
      internal::CountUnpairedEdges(mesh.triangles)) {
    seen.triangles = std::move(joined);
  }
  return seen;
}

std::vector<MeshDefect> BadEdges(const TriangleMesh& mesh) {
  const std::vector<internal::EdgeSide> edges = internal::SortedEdgeSides(
      mesh.triangles, internal::FoldedTriangles::kLeftOut);
  std::vector<MeshDefect> defects;
  internal::ForEachEdge(edges, [&](std::size_t begin, std::size_t end) {
    MeshDefect defect;
    if (end - begin == 1) {
      defect.kind = DefectKind::kOpenEdge;
    } else if (end - begin > 2) {
      defect.kind = DefectKind::kNonManifoldEdge;
    } else if (edges[begin].is_forward == edges[begin + 1].is_forward) {
      defect.kind = DefectKind::kMisorientedEdge;
    } else {
      return;
    }
    defect.place = 0.5 * mesh.vertices[edges[begin].low] +
                   0.5 * mesh.vertices[edges[begin].high];
    for (std::size_t i = begin; i < end; ++i) {
      defect.triangles.push_back(edges[i].triangle);
    }
    defects.push_back(std::move(defect));
  });
  return defects;
}

// Where the edge from p to q goes through the triangle; false if it does not.
// In double: a place to look at.
bool Pierces(const Vector3d& p, const Vector3d& q,
             const std::array<Vector3d, 3>& t, Vector3d* place) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double at_p = normal.dot(p - t[0]), at_q = normal.dot(q - t[0]);
  if (at_p == at_q || at_p * at_q > 0.0) return false;
  const Vector3d x = p + at_p / (at_p - at_q) * (q - p);
  for (int k = 0; k < 3; ++k) {
    const Vector3d edge = t[(k + 1) % 3] - t[k];
    if (edge.cross(x - t[k]).dot(normal) < 0.0) return false;
  }
  *place = x;
  return true;
}

Vector3d CommonPoint(const TriangleMesh& mesh, std::size_t s, std::size_t t) {
  const auto corners = [&mesh](std::size_t f) {
    const Triangle& c = mesh.triangles[f];
    return std::array<Vector3d, 3>{mesh.vertices[c[0]], mesh.vertices[c[1]],
                                   mesh.vertices[c[2]]};
  };
  const std::array<Vector3d, 3> a = corners(s), b = corners(t);
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    Vector3d place;
    if (Pierces(a[k], a[(k + 1) % 3], b, &place)) sum += place, ++count;
    if (Pierces(b[k], b[(k + 1) % 3], a, &place)) sum += place, ++count;
  }
  if (count > 0) return sum / count;
  // In one plane.
  return (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) / 6.0;
}

}  // namespace

const char* ToString(DefectKind kind) {
  switch (kind) {
    case DefectKind::kOpenEdge:
      return "open edge";
    case DefectKind::kNonManifoldEdge:
      return "edge of three or more triangles";
    case DefectKind::kMisorientedEdge:
      return "edge of two triangles of one direction";
    case DefectKind::kSelfIntersection:
      break;
  }
  return "self-intersection";
}

std::vector<MeshDefect> FindEdgeDefects(const TriangleMesh& mesh,
                                        std::size_t limit) {
  if (!IsReadable(mesh)) return {};
  const std::vector<MeshDefect> edges = BadEdges(AsSolidSees(mesh));
  std::vector<MeshDefect> defects;
  for (const DefectKind kind :
       {DefectKind::kOpenEdge, DefectKind::kNonManifoldEdge,
        DefectKind::kMisorientedEdge}) {
    std::size_t count = 0;
    for (const MeshDefect& defect : edges) {
      if (defect.kind == kind && count++ < limit) defects.push_back(defect);
    }
  }
  return defects;
}

std::vector<MeshDefect> FindDefects(const TriangleMesh& mesh,
                                    std::size_t limit) {
  if (!IsReadable(mesh)) return {};
  std::vector<MeshDefect> defects = FindEdgeDefects(mesh, limit);
  const TriangleMesh seen = AsSolidSees(mesh);
  int parts = 0;
  std::vector<internal::TrianglePair> pairs;
  internal::CountSelfIntersections(seen, LabelComponents(seen, &parts), limit,
                                   &pairs);
  for (auto& [s, t] : pairs) {
    if (s > t) std::swap(s, t);
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [s, t] : pairs) {
    defects.push_back({DefectKind::kSelfIntersection,
                       CommonPoint(seen, s, t),
                       {static_cast<int>(s), static_cast<int>(t)}});
  }
  return defects;
}

int SurfaceGenus(const TriangleMesh& mesh) {
  if (mesh.triangles.empty() || !IsReadable(mesh)) return -1;
  TriangleMesh seen = AsSolidSees(mesh);
  auto& faces = seen.triangles;
  faces.erase(std::remove_if(faces.begin(), faces.end(), UsesVertexTwice),
              faces.end());
  const std::vector<internal::EdgeSide> sides =
      internal::SortedEdgeSides(faces, internal::FoldedTriangles::kKept);
  long edges = 0;
  bool is_surface = true;
  internal::UnionFind loops(seen.vertices.size());
  std::map<int, int> boundary;  // of a vertex: how many open edges
  internal::ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
    ++edges;
    is_surface = is_surface && end - begin <= 2;
    if (end - begin != 1) return;
    loops.Join(sides[begin].low, sides[begin].high);
    ++boundary[sides[begin].low];
    ++boundary[sides[begin].high];
  });
  long discs = 0;
  for (const auto& [vertex, count] : boundary) {
    is_surface = is_surface && count == 2;
    discs += loops.Find(vertex) == vertex ? 1 : 0;
  }
  if (!is_surface) return -1;
  std::vector<bool> used(seen.vertices.size(), false);
  for (const Triangle& t : faces) {
    for (const int v : t) used[v] = true;
  }
  int parts = 0;
  LabelComponents(seen, &parts);
  const long euler = std::count(used.begin(), used.end(), true) - edges +
                     static_cast<long>(faces.size()) + discs;
  return static_cast<int>(parts - euler / 2);
}

}  // namespace phongpd
