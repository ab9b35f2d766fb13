// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/solid.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/mesh/counted.h"
#include "core/mesh/edge_sides.h"
#include "core/mesh/mesh_io.h"
#include "core/mesh/mesh_range.h"
#include "core/solid/mesh_defects.h"
#include "core/solid/mesh_examination.h"
#include "core/solid/shell_orientation.h"

namespace phongpd {
namespace {

using internal::BadEdges;
using internal::ExamineTopology;

// The mesh with used vertices only, equal ones joined if asked for, and no
// triangle that uses a vertex twice.
TriangleMesh Cleaned(const TriangleMesh& mesh, bool is_joining) {
  std::vector<int> representative(mesh.vertices.size());
  std::iota(representative.begin(), representative.end(), 0);
  if (is_joining) {
    const std::vector<int> order = internal::SortedByCoordinates(mesh);
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
    if (!internal::UsesVertexTwice(t)) clean.triangles.push_back(t);
  }
  clean.vertices = mesh.vertices;
  const std::vector<bool> used = internal::UsedVertices(clean);
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

Solid::Solid() : Solid(Data(), "") {}

Solid::Solid(Data data, std::string name)
    : data_(std::make_shared<const Data>(std::move(data))),
      name_(std::move(name)) {}

Solid Solid::Named(std::string name) const {
  Solid other = *this;
  other.name_ = std::move(name);
  return other;
}

bool Solid::HasSameMesh(const Solid& other) const {
  return data_ == other.data_ || (mesh().vertices == other.mesh().vertices &&
                                  mesh().triangles == other.mesh().triangles);
}

Solid MakeSolid(const TriangleMesh& mesh, const std::string& name,
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
  internal::ExamineGeometry(solid, &found);
  RequireProper(solid, found, name);
  found.degenerate_triangles += mesh.triangles.size() - solid.triangles.size();
  found.inverted_components = internal::TurnOutward(name, &solid);
  found.volume = SignedVolume(solid);
  internal::AddWarnings(&found);
  return Solid({std::move(solid), found}, name);
}

Solid ReadSolid(const std::string& path) {
  return MakeSolid(ReadMesh(path), path);
}

void RequireNotEmpty(const Solid& solid, const std::string& what) {
  if (!solid.IsEmpty()) return;
  throw InputError((solid.name().empty() ? what : solid.name()) +
                   ": expected a solid, found no triangle");
}

Solid JoinedSolids(const std::vector<Solid>& solids, const std::string& name) {
  if (solids.size() == 1) return solids.front().Named(name);
  Solid::Data joined;
  MeshReport& sum = joined.report;
  for (const Solid& solid : solids) {
    const int first = static_cast<int>(joined.mesh.vertices.size());
    joined.mesh.vertices.insert(joined.mesh.vertices.end(),
                                solid.mesh().vertices.begin(),
                                solid.mesh().vertices.end());
    for (const Triangle& t : solid.mesh().triangles) {
      joined.mesh.triangles.push_back(
          {t[0] + first, t[1] + first, t[2] + first});
    }
    const MeshReport& one = solid.report();
    internal::AddCounts(one, &sum);
    for (const std::string& line : NamedWarnings(one, solid.name())) {
      sum.warnings.push_back(line);
    }
  }
  return Solid(std::move(joined), name);
}

}  // namespace phongpd
