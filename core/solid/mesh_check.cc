// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/mesh_check.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <tuple>

#include "core/mesh/counted.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_range.h"
#include "core/solid/mesh_defects.h"
#include "core/solid/self_intersection.h"
#include "core/solid/shell_orientation.h"

namespace phongpd {
namespace {

bool UsesVertexTwice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

std::vector<bool> UsedVertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) used[v] = true;
  }
  return used;
}

// Used vertices, equal coordinates next to each other, the earlier first.
std::vector<int> SortedByCoordinates(const TriangleMesh& mesh) {
  const std::vector<bool> used = UsedVertices(mesh);
  std::vector<int> order;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) order.push_back(static_cast<int>(v));
  }
  std::sort(order.begin(), order.end(), [&mesh](int i, int j) {
    const Eigen::Vector3d& p = mesh.vertices[i];
    const Eigen::Vector3d& q = mesh.vertices[j];
    return std::make_tuple(p.x(), p.y(), p.z(), i) <
           std::make_tuple(q.x(), q.y(), q.z(), j);
  });
  return order;
}

void CountVerticesAndIndices(const TriangleMesh& mesh, MeshReport* report) {
  report->triangles = mesh.triangles.size();
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) report->bad_indices += v < 0 || v >= size;
  }
  for (const Eigen::Vector3d& v : mesh.vertices) {
    report->non_finite_vertices += !IsFinite(v);
  }
  if (report->bad_indices > 0) return;
  const std::vector<bool> used = UsedVertices(mesh);
  report->vertices =
      static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

void CountEdges(const TriangleMesh& mesh, MeshReport* report) {
  struct HalfEdge {
    int low, high;
    bool is_forward;
  };
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    if (UsesVertexTwice(t)) continue;
    for (int k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      half_edges.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) {
              return a.low != b.low ? a.low < b.low : a.high < b.high;
            });
  for (std::size_t i = 0, end = 0; i < half_edges.size(); i = end) {
    const HalfEdge& edge = half_edges[i];
    for (end = i; end < half_edges.size(); ++end) {
      const HalfEdge& e = half_edges[end];
      if (e.low != edge.low || e.high != edge.high) break;
    }
    report->boundary_edges += end - i == 1;
    report->non_manifold_edges += end - i > 2;
    report->misoriented_edges +=
        end - i == 2 && edge.is_forward == half_edges[i + 1].is_forward;
  }
}

std::size_t BadEdges(const MeshReport& report) {
  return report.boundary_edges + report.non_manifold_edges +
         report.misoriented_edges;
}

void CountDuplicates(const TriangleMesh& mesh, MeshReport* report) {
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  const auto last = std::unique(sorted.begin(), sorted.end());
  report->duplicate_triangles = static_cast<std::size_t>(sorted.end() - last);
  if (report->non_finite_vertices > 0) return;
  const std::vector<int> order = SortedByCoordinates(mesh);
  for (std::size_t i = 1; i < order.size(); ++i) {
    report->duplicate_vertices +=
        mesh.vertices[order[i - 1]] == mesh.vertices[order[i]];
  }
}

// Everything that needs no geometry beyond equality; cheap.
MeshReport ExamineTopology(const TriangleMesh& mesh) {
  MeshReport report;
  CountVerticesAndIndices(mesh, &report);
  if (report.bad_indices > 0) return report;
  LabelComponents(mesh, &report.components);
  CountEdges(mesh, &report);
  CountDuplicates(mesh, &report);
  return report;
}

void ExamineGeometry(const TriangleMesh& mesh, MeshReport* report) {
  if (report->bad_indices > 0 || report->non_finite_vertices > 0) return;
  for (const Triangle& triangle : mesh.triangles) {
    report->degenerate_triangles += internal::IsDegenerate(mesh, triangle);
  }
  int count = 0;
  report->self_intersections =
      internal::CountSelfIntersections(mesh, LabelComponents(mesh, &count));
  report->volume = SignedVolume(mesh);
}

void AddWarnings(MeshReport* report) {
  const auto warn = [report](std::size_t count, const char* one,
                             const char* many) {
    if (count == 0) return;
    report->warnings.push_back(Counted(count, one, many));
  };
  warn(report->joined_vertices,
       "vertex joined with another of equal coordinates: the surface was open "
       "or not manifold without.",
       "vertices joined with others of equal coordinates: the surface was "
       "open or not manifold without.");
  warn(static_cast<std::size_t>(report->inverted_components),
       "part was inside out and has been turned.",
       "parts were inside out and have been turned.");
  warn(report->degenerate_triangles, "triangle has no area.",
       "triangles have no area.");
  warn(report->duplicate_vertices, "vertex has the coordinates of another one.",
       "vertices have the coordinates of another one.");
  warn(report->duplicate_triangles,
       "triangle has the same corners as another one.",
       "triangles have the same corners as another one.");
}

// The mesh with used vertices only, equal ones joined if asked for, and no
// triangle that uses a vertex twice.
TriangleMesh Cleaned(const TriangleMesh& mesh, bool is_joining) {
  std::vector<int> representative(mesh.vertices.size());
  std::iota(representative.begin(), representative.end(), 0);
  if (is_joining) {
    const std::vector<int> order = SortedByCoordinates(mesh);
    for (std::size_t i = 1; i < order.size(); ++i) {
      const int a = order[i - 1], b = order[i];
      if (mesh.vertices[a] == mesh.vertices[b]) {
        representative[b] = representative[a];
      }
    }
  }
  TriangleMesh clean;
  for (Triangle t : mesh.triangles) {
    for (int& v : t) v = representative[v];
    if (!UsesVertexTwice(t)) clean.triangles.push_back(t);
  }
  clean.vertices = mesh.vertices;
  const std::vector<bool> used = UsedVertices(clean);
  std::vector<int> new_index(used.size(), -1);
  clean.vertices.clear();
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    new_index[v] = static_cast<int>(clean.vertices.size());
    clean.vertices.push_back(mesh.vertices[v]);
  }
  for (Triangle& t : clean.triangles) {
    for (int& v : t) v = new_index[v];
  }
  return clean;
}

[[noreturn]] void Refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

void RequireUsable(const MeshReport& report, const std::string& name) {
  if (report.triangles == 0) {
    Refuse(name, "no surface; expected triangles, found none");
  }
  if (report.bad_indices > 0) {
    Refuse(name, "bad indices; expected existing vertices, found " +
                     std::to_string(report.bad_indices) +
                     " indices out of range");
  }
  if (report.non_finite_vertices > 0) {
    Refuse(name, "bad coordinates; expected finite numbers, found " +
                     std::to_string(report.non_finite_vertices) +
                     " vertices with NaN or infinity");
  }
}

// ", the first near (0, 0.5, 1)"
std::string FirstPlace(const std::vector<MeshDefect>& defects) {
  if (defects.empty()) return "";
  const Eigen::Vector3d& place = defects.front().place;
  std::ostringstream text;
  text << ", the first near (" << place[0] << ", " << place[1] << ", "
       << place[2] << ')';
  return text.str();
}

constexpr char kHowToMend[] =
    "; repair safe or wrap may mend it (flag --repair, key \"repair\" of a "
    "scene), phongpd check marks the places; or ";

void RequireClosed(const TriangleMesh& mesh, const MeshReport& report,
                   const std::string& name) {
  if (BadEdges(report) == 0) return;
  std::ostringstream what;
  const char* separator = " ";
  const auto list = [&](const char* before, std::size_t count, const char* one,
                        const char* many, const char* after) {
    if (count == 0) return;
    what << separator << before << Counted(count, one, many) << after;
    separator = ", ";
  };
  what << "no closed surface; expected every edge between two triangles of "
          "one orientation, found";
  list("open (", report.boundary_edges, "boundary edge", "", ")");
  list("non-manifold (", report.non_manifold_edges,
       "edge of three or more triangles", "edges of three or more triangles",
       ")");
  list("inconsistently oriented (", report.misoriented_edges,
       "edge used twice in one direction", "edges used twice in one direction",
       ")");
  list("", report.duplicate_triangles, "duplicate triangle", "", "");
  if (report.joined_vertices > 0) {
    what << ", after joining "
         << Counted(report.joined_vertices, "equal vertex", "equal vertices");
  }
  what << FirstPlace(FindEdgeDefects(mesh, 1)) << kHowToMend
       << "close, clean or reorient the surface and export it again";
  Refuse(name, what.str());
}

void RequireProper(const TriangleMesh& mesh, const MeshReport& report,
                   const std::string& name) {
  if (report.degenerate_triangles == report.triangles) {
    Refuse(name, "zero volume; expected a solid, found " +
                     Counted(report.triangles, "triangle") +
                     ", none of them with an area");
  }
  const double diagonal = ComputeBounds(mesh).Diagonal();
  if (!(diagonal >= kMinDiagonal && diagonal <= kMaxDiagonal)) {
    std::ostringstream what;
    what << "size out of range; expected a diagonal between " << kMinDiagonal
         << " and " << kMaxDiagonal << ", found " << diagonal
         << "; use another unit";
    Refuse(name, what.str());
  }
  if (report.self_intersections > 0) {
    Refuse(name,
           "self-intersecting; expected no crossing within a part, "
           "found " +
               Counted(report.self_intersections, "pair of triangles",
                       "pairs of triangles") +
               FirstPlace(FindDefects(mesh, 1)) + kHowToMend + "separate them");
  }
}

}  // namespace

void RequireInRange(const TriangleMesh& mesh, const std::string& name) {
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) {
      if (v < 0 || v >= size || !IsFinite(mesh.vertices[v])) continue;
      const double largest = mesh.vertices[v].cwiseAbs().maxCoeff();
      if (largest <= kMaxCoordinate) continue;
      std::ostringstream what;
      what << "size out of range; expected coordinates of at most "
           << kMaxCoordinate << ", found " << largest << " at vertex " << v
           << " (from 0); use another unit";
      Refuse(name, what.str());
    }
  }
}

MeshReport ExamineMesh(const TriangleMesh& mesh) {
  MeshReport report = ExamineTopology(mesh);
  ExamineGeometry(mesh, &report);
  AddWarnings(&report);
  return report;
}

TriangleMesh MakeSolid(const TriangleMesh& mesh, const std::string& name,
                       MeshReport* report) {
  MeshReport unused;
  MeshReport& found = report == nullptr ? unused : *report;
  found = ExamineTopology(mesh);
  RequireUsable(found, name);
  RequireInRange(mesh, name);

  TriangleMesh solid = Cleaned(mesh, false);
  if (BadEdges(found) > 0 && found.duplicate_vertices > 0) {
    TriangleMesh joined = Cleaned(mesh, true);
    MeshReport after = ExamineTopology(joined);
    if (BadEdges(after) < BadEdges(found)) {
      after.joined_vertices = found.duplicate_vertices;
      solid = std::move(joined);
      found = std::move(after);
    }
  }
  found.vertices = solid.vertices.size();
  found.triangles = solid.triangles.size();
  RequireClosed(solid, found, name);
  ExamineGeometry(solid, &found);
  RequireProper(solid, found, name);
  found.degenerate_triangles += mesh.triangles.size() - solid.triangles.size();
  found.inverted_components = internal::TurnOutward(name, &solid);
  found.volume = SignedVolume(solid);
  AddWarnings(&found);
  return solid;
}

std::vector<std::string> NamedWarnings(const MeshReport& report,
                                       const std::string& name) {
  std::vector<std::string> lines;
  for (const std::string& line : report.warnings) {
    const bool is_named = line.find(name) != std::string::npos;
    lines.push_back(is_named ? line : name + ": " + line);
  }
  return lines;
}

}  // namespace phongpd
