// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_repair.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/mesh/mesh_approximation.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/self_intersection.h"

namespace phongpd {
namespace {

using Faces = std::vector<Triangle>;

// For every vertex the first one of equal coordinates.
std::vector<int> FirstOfEqual(const TriangleMesh& mesh) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&mesh](int v) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::stable_sort(order.begin(), order.end(),
                   [&key](int a, int b) { return key(a) < key(b); });
  std::vector<int> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_equal = i > 0 && key(order[i - 1]) == key(order[i]);
    first[order[i]] = is_equal ? first[order[i - 1]] : order[i];
  }
  return first;
}

Triangle Renamed(const Triangle& t, const std::vector<int>& names) {
  return {names[t[0]], names[t[1]], names[t[2]]};
}

bool UsesVertexTwice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

struct HalfEdge {
  int low, high;
  int face;
  bool is_forward;
};

std::vector<HalfEdge> SortedHalfEdges(const Faces& faces) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (UsesVertexTwice(faces[f])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces[f][k], b = faces[f][(k + 1) % 3];
      edges.push_back(
          {std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) {
              return std::tie(a.low, a.high, a.face) <
                     std::tie(b.low, b.high, b.face);
            });
  return edges;
}

// Calls visit(first, last) for the half-edges of every edge.
template <typename Visit>
void ForEachEdge(const std::vector<HalfEdge>& edges, const Visit& visit) {
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].low == edges[i].low &&
           edges[end].high == edges[i].high) {
      ++end;
    }
    visit(i, end);
  }
}

// Edges that do not have two faces.
std::size_t BadEdges(const Faces& faces) {
  const std::vector<HalfEdge> edges = SortedHalfEdges(faces);
  std::size_t bad = 0;
  ForEachEdge(edges, [&bad](std::size_t begin, std::size_t end) {
    bad += end - begin != 2;
  });
  return bad;
}

// The same with or without joining vertices, whichever is better.
std::size_t LeastBadEdges(const Faces& faces, const std::vector<int>& first) {
  const std::size_t apart = BadEdges(faces);
  Faces joined;
  joined.reserve(faces.size());
  for (const Triangle& t : faces) joined.push_back(Renamed(t, first));
  return std::min(apart, BadEdges(joined));
}

// Does the triangle run through its sorted corners cyclically?
bool IsEven(const Triangle& t) {
  const auto low = std::min_element(t.begin(), t.end()) - t.begin();
  return t[(low + 1) % 3] < t[(low + 2) % 3];
}

// The faces with every group of equal corners reduced to one or none.
Faces WithoutCopies(const Faces& faces, const std::vector<int>& first,
                    bool cancel_mirrored, RepairReport* report) {
  std::vector<std::pair<Triangle, int>> sorted;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Triangle t = Renamed(faces[f], first);
    std::sort(t.begin(), t.end());
    sorted.emplace_back(t, static_cast<int>(f));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> kept(faces.size(), false);
  for (std::size_t i = 0, end = 0; i < sorted.size(); i = end) {
    std::array<std::vector<int>, 2> copies;
    for (end = i; end < sorted.size() && sorted[end].first == sorted[i].first;
         ++end) {
      const int f = sorted[end].second;
      copies[IsEven(Renamed(faces[f], first)) ? 1 : 0].push_back(f);
    }
    const std::size_t pairs =
        cancel_mirrored ? std::min(copies[0].size(), copies[1].size()) : 0;
    report->mirrored_faces += 2 * pairs;
    std::size_t left = end - i - 2 * pairs;
    if (left == 0) continue;
    kept[copies[copies[0].size() < copies[1].size() ? 1 : 0].front()] = true;
    report->duplicate_faces += left - 1;
  }
  Faces out;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (kept[f]) out.push_back(faces[f]);
  }
  return out;
}

// Removes copies and faces without area from one part.
Faces CleanPart(const TriangleMesh& mesh, const std::vector<int>& first,
                Faces faces, RepairReport* report) {
  std::size_t bad = LeastBadEdges(faces, first);
  RepairReport best = *report;
  Faces chosen = faces;
  for (const bool cancel_mirrored : {true, false}) {
    RepairReport trial = *report;
    Faces candidate = WithoutCopies(faces, first, cancel_mirrored, &trial);
    const std::size_t edges = LeastBadEdges(candidate, first);
    const bool is_first = best.duplicate_faces == report->duplicate_faces &&
                          best.mirrored_faces == report->mirrored_faces;
    if (candidate.empty() || candidate.size() == faces.size()) continue;
    if (edges > bad || (edges == bad && !is_first)) continue;
    bad = edges;
    best = trial;
    chosen = std::move(candidate);
  }
  *report = best;

  Faces proper;
  for (const Triangle& t : chosen) {
    if (!internal::IsDegenerate(mesh, t)) proper.push_back(t);
  }
  // Without area but needed: the faces beside it would be open.
  if (proper.size() < chosen.size() && !proper.empty() &&
      LeastBadEdges(proper, first) <= bad) {
    report->degenerate_faces += chosen.size() - proper.size();
    chosen = std::move(proper);
  }
  return chosen;
}

// Turns faces like the majority of those they are connected to through edges
// of two faces.  A surface of one side stays as it is.
void OrientAlike(Faces* faces, RepairReport* report) {
  struct Link {
    int face;
    bool is_turned;  // runs through the edge in the same direction
  };
  std::vector<std::vector<Link>> links(faces->size());
  const std::vector<HalfEdge> edges = SortedHalfEdges(*faces);
  ForEachEdge(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const HalfEdge &a = edges[begin], &b = edges[begin + 1];
    const bool is_turned = a.is_forward == b.is_forward;
    links[a.face].push_back({b.face, is_turned});
    links[b.face].push_back({a.face, is_turned});
  });
  std::vector<int> side(faces->size(), -1);
  for (std::size_t seed = 0; seed < faces->size(); ++seed) {
    if (side[seed] >= 0) continue;
    std::vector<int> part = {static_cast<int>(seed)};
    side[seed] = 0;
    bool is_orientable = true;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const Link& link : links[part[i]]) {
        const int expected = side[part[i]] ^ (link.is_turned ? 1 : 0);
        if (side[link.face] < 0) {
          side[link.face] = expected;
          turned += static_cast<std::size_t>(expected);
          part.push_back(link.face);
        }
        is_orientable = is_orientable && side[link.face] == expected;
      }
    }
    if (!is_orientable) continue;
    const int minority = 2 * turned > part.size() ? 0 : 1;
    for (const int f : part) {
      if (side[f] != minority) continue;
      std::swap((*faces)[f][1], (*faces)[f][2]);
      ++report->turned_faces;
    }
  }
}

}  // namespace

TriangleMesh RepairSafely(const TriangleMesh& mesh, RepairReport* report) {
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      if (v < 0 || v >= size || !mesh.vertices[v].allFinite()) return mesh;
    }
  }
  TriangleMesh out = mesh;
  for (Eigen::Vector3d& v : out.vertices) {
    if (!v.allFinite()) v.setZero();  // unused
  }
  const std::vector<int> first = FirstOfEqual(out);
  TriangleMesh joined = out;
  for (Triangle& t : joined.triangles) t = Renamed(t, first);
  int count = 0;
  const std::vector<int> part = LabelComponents(joined, &count);
  std::vector<Faces> parts(static_cast<std::size_t>(count));
  for (std::size_t t = 0; t < part.size(); ++t) {
    parts[part[t]].push_back(out.triangles[t]);
  }
  out.triangles.clear();
  RepairReport done;
  for (const Faces& faces : parts) {
    Faces clean = CleanPart(out, first, faces, &done);
    Faces together;
    for (const Triangle& t : clean) together.push_back(Renamed(t, first));
    if (BadEdges(together) < BadEdges(clean)) {
      std::vector<int> moved;
      for (const Triangle& t : clean) {
        for (const int v : t) {
          if (first[v] != v) moved.push_back(v);
        }
      }
      std::sort(moved.begin(), moved.end());
      moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
      done.joined_vertices += moved.size();
      clean = std::move(together);
    }
    OrientAlike(&clean, &done);
    out.triangles.insert(out.triangles.end(), clean.begin(), clean.end());
  }
  const auto say = [&done](std::size_t number, const char* what) {
    if (number == 0) return;
    done.actions.push_back(std::to_string(number) + " " + what);
  };
  say(done.duplicate_faces, "duplicate faces removed");
  say(done.mirrored_faces, "faces removed that lay in pairs back to back");
  say(done.degenerate_faces, "faces without area removed");
  say(done.joined_vertices, "vertices joined with others of equal coordinates");
  say(done.turned_faces, "faces turned like their neighbours");
  if (report != nullptr) *report = done;
  return out;
}

TriangleMesh RepairSolid(const TriangleMesh& mesh, const std::string& name,
                         Repair repair, double wrap_alpha,
                         MeshReport* mesh_report, RepairReport* repair_report) {
  MeshReport unused_mesh_report;
  RepairReport unused_repair_report;
  if (mesh_report == nullptr) mesh_report = &unused_mesh_report;
  if (repair_report == nullptr) repair_report = &unused_repair_report;
  *repair_report = {};
  if (repair == Repair::kReject) return MakeSolid(mesh, name, mesh_report);
  const TriangleMesh mended = RepairSafely(mesh, repair_report);
  if (repair == Repair::kSafe) return MakeSolid(mended, name, mesh_report);
  std::string reason;
  try {
    return MakeSolid(mended, name, mesh_report);
  } catch (const InputError& error) {
    const bool has_area =
        mesh_report->bad_indices == 0 &&
        mesh_report->non_finite_vertices == 0 &&
        std::any_of(mended.triangles.begin(), mended.triangles.end(),
                    [&mended](const Triangle& t) {
                      return !internal::IsDegenerate(mended, t);
                    });
    if (!has_area) throw;
    reason = error.what();
  }
  const ApproximateMesh wrap = WrapTriangles(mended, wrap_alpha);
  repair_report->is_wrapped = true;
  repair_report->wrap_reason = reason;
  repair_report->wrap_alpha = wrap_alpha;
  repair_report->wrap_bound = wrap.bound;
  repair_report->actions.push_back("wrapped, at most " +
                                   std::to_string(wrap.bound) +
                                   " from its surface, because of: " + reason);
  return MakeSolid(wrap.mesh, name, mesh_report);
}

}  // namespace phongpd
