// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/mesh_repair.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "core/bounds/mesh_approximation.h"
#include "core/mesh/counted.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_range.h"
#include "core/solid/face_pairing.h"
#include "core/solid/mesh_defects.h"
#include "core/solid/self_intersection.h"
#include "core/solid/solid.h"

namespace phongpd {
namespace {

using internal::Faces;

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

Faces Renamed(Faces faces, const std::vector<int>& names) {
  for (Triangle& t : faces) t = Renamed(t, names);
  return faces;
}

// The same with or without joining vertices, whichever is better.
std::size_t LeastUnpairedEdges(const Faces& faces,
                               const std::vector<int>& first) {
  return std::min(internal::CountUnpairedEdges(faces),
                  internal::CountUnpairedEdges(Renamed(faces, first)));
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
                const Faces& faces, RepairReport* report) {
  std::size_t bad = LeastUnpairedEdges(faces, first);
  RepairReport best = *report;
  Faces chosen = faces;
  for (const bool cancel_mirrored : {true, false}) {
    RepairReport trial = *report;
    Faces candidate = WithoutCopies(faces, first, cancel_mirrored, &trial);
    const std::size_t edges = LeastUnpairedEdges(candidate, first);
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
      LeastUnpairedEdges(proper, first) <= bad) {
    report->degenerate_faces += chosen.size() - proper.size();
    chosen = std::move(proper);
  }
  return chosen;
}

// Says what a wrap made of the handles.
void SayGenus(const TriangleMesh& before, const TriangleMesh& after,
              RepairReport* report) {
  const int was = SurfaceGenus(before), is = SurfaceGenus(after);
  if (was == is) return;
  report->actions.push_back(
      "the genus is " + std::to_string(is) + " now" +
      (was < 0 ? ", that of the file is not defined"
               : ", it was " + std::to_string(was) + " with holes closed"));
}

}  // namespace

TriangleMesh RepairSafely(const TriangleMesh& mesh, RepairReport* report) {
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    if (*std::min_element(t.begin(), t.end()) < 0 ||
        *std::max_element(t.begin(), t.end()) >= size) {
      return mesh;
    }
  }
  for (const Eigen::Vector3d& v : mesh.vertices) {
    if (!IsFinite(v)) return mesh;  // MakeSolid refuses it, used or not
  }
  TriangleMesh out = mesh;
  const std::vector<int> first = FirstOfEqual(out);
  TriangleMesh joined = out;
  joined.triangles = Renamed(std::move(joined.triangles), first);
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
    Faces together = Renamed(clean, first);
    if (internal::CountUnpairedEdges(together) <
        internal::CountUnpairedEdges(clean)) {
      std::set<int> moved;
      for (const Triangle& t : clean) {
        for (const int v : t) {
          if (first[v] != v) moved.insert(v);
        }
      }
      done.joined_vertices += moved.size();
      clean = std::move(together);
    }
    done.turned_faces += internal::OrientAlike(&clean);
    out.triangles.insert(out.triangles.end(), clean.begin(), clean.end());
  }
  const auto say = [&done](std::size_t number, const char* one,
                           const char* many) {
    if (number == 0) return;
    done.actions.push_back(Counted(number, one, many));
  };
  say(done.duplicate_faces, "duplicate face removed",
      "duplicate faces removed");
  say(done.mirrored_faces, "face removed that lay back to back with another",
      "faces removed that lay in pairs back to back");
  say(done.degenerate_faces, "face without area removed",
      "faces without area removed");
  say(done.joined_vertices, "vertex joined with another of equal coordinates",
      "vertices joined with others of equal coordinates");
  say(done.turned_faces, "face turned like its neighbours",
      "faces turned like their neighbours");
  if (report != nullptr) *report = done;
  return out;
}

Solid RepairSolid(const TriangleMesh& mesh, const std::string& name,
                  Repair repair, double wrap_alpha, MeshReport* mesh_report,
                  RepairReport* repair_report) {
  MeshReport unused_mesh_report;
  RepairReport unused_repair_report;
  if (mesh_report == nullptr) mesh_report = &unused_mesh_report;
  if (repair_report == nullptr) repair_report = &unused_repair_report;
  *repair_report = {};
  if (repair == Repair::kReject) return MakeSolid(mesh, name, mesh_report);
  const TriangleMesh mended = RepairSafely(mesh, repair_report);
  if (repair == Repair::kSafe) {
    try {
      return MakeSolid(mended, name, mesh_report);
    } catch (const InputError& error) {
      // What was asked for is not proposed again.
      std::string text = error.what();
      const std::string both = "; repair safe or wrap ";
      const std::size_t at = text.find(both);
      if (at == std::string::npos) throw;
      throw InputError(text.replace(at, both.size(), "; repair wrap "));
    }
  }
  std::string reason;
  try {
    return MakeSolid(mended, name, mesh_report);
  } catch (const InputError& error) {
    RequireInRange(mended, name);  // no wrap brings it nearer
    const bool has_area =
        mesh_report->bad_indices + mesh_report->non_finite_vertices == 0 &&
        std::any_of(mended.triangles.begin(), mended.triangles.end(),
                    [&mended](const Triangle& t) {
                      return !internal::IsDegenerate(mended, t);
                    });
    if (!has_area) throw;
    reason = error.what();
    if (reason.rfind(name + ": ", 0) == 0) reason.erase(0, name.size() + 2);
    reason.erase(std::min(reason.find("; repair "), reason.size()));
  }
  const ApproximateMesh wrap = WrapTriangles(mended, wrap_alpha);
  repair_report->is_wrapped = true;
  repair_report->wrap_reason = reason;
  repair_report->wrap_alpha = wrap_alpha;
  repair_report->wrap_bound = wrap.bound;
  repair_report->actions.push_back("wrapped because it is no solid: " + reason);
  Solid solid = MakeSolid(wrap.mesh, name, mesh_report);
  SayGenus(mended, solid, repair_report);
  return solid;
}

}  // namespace phongpd
