// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/joined_contact_spaces.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_quality.h"
#include "core/solid/mesh_examination.h"

namespace phongpd {
namespace {

// Appends a mesh, planes and kinds; planes of different spaces are different
// ones, even where they lie in one.
void Append(const ContactSpace& space, ContactSpace::Parts* all) {
  TriangleMesh& mesh = all->mesh;
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), space.mesh().vertices.begin(),
                       space.mesh().vertices.end());
  for (const Triangle& t : space.mesh().triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const int planes =
      all->plane.empty()
          ? 0
          : 1 + *std::max_element(all->plane.begin(), all->plane.end());
  for (const int plane : space.plane()) all->plane.push_back(planes + plane);
  all->kind.insert(all->kind.end(), space.kind().begin(), space.kind().end());
}

void AddSeconds(const ContactSpaceReport& one, ContactSpaceReport* sum) {
  for (const auto& [stage, seconds] : one.seconds) {
    const std::string& name = stage;
    const auto same =
        std::find_if(sum->seconds.begin(), sum->seconds.end(),
                     [&name](const auto& s) { return s.first == name; });
    if (same == sum->seconds.end()) {
      sum->seconds.emplace_back(stage, seconds);
    } else {
      same->second += seconds;
    }
  }
}

void Add(const ContactSpaceReport& one, ContactSpaceReport* sum) {
  sum->triangles += one.triangles;
  sum->vertices += one.vertices;
  sum->closed = sum->closed && one.closed;
  sum->manifold = sum->manifold && one.manifold;
  sum->components += one.components;
  sum->genus += one.genus;
  // Of disjoint solids: what is left of space has one unbounded part, and the
  // bounded ones of each, whatever lies in them.
  sum->cavities += one.cavities;
  sum->volume += one.volume;
  sum->self_intersections += one.self_intersections;
  sum->degenerate_triangles += one.degenerate_triangles;
  sum->from_cache = sum->from_cache && one.from_cache;
  AddSeconds(one, sum);
  sum->peak_mib = std::max(sum->peak_mib, one.peak_mib);
  sum->predicted.meetings += one.predicted.meetings;
  sum->predicted.arrangement_faces += one.predicted.arrangement_faces;
  sum->predicted.seconds += one.predicted.seconds;
  sum->predicted.mib = std::max(sum->predicted.mib, one.predicted.mib);
  sum->convolution_triangles += one.convolution_triangles;
  sum->arrangement_faces += one.arrangement_faces;
  sum->cells += one.cells;
  sum->judged_cells += one.judged_cells;
  sum->canonical_frame = sum->canonical_frame || one.canonical_frame;
  sum->grid_step = std::max(sum->grid_step, one.grid_step);
  sum->approximation.bound =
      std::max(sum->approximation.bound, one.approximation.bound);
  sum->approximation.is_conservative =
      sum->approximation.is_conservative && one.approximation.is_conservative;
  sum->approximation.steps.insert(sum->approximation.steps.end(),
                                  one.approximation.steps.begin(),
                                  one.approximation.steps.end());
  internal::AddCounts(one.obstacle, &sum->obstacle);
  sum->obstacle.warnings.insert(sum->obstacle.warnings.end(),
                                one.obstacle.warnings.begin(),
                                one.obstacle.warnings.end());
  sum->warnings.insert(sum->warnings.end(), one.warnings.begin(),
                       one.warnings.end());
}

}  // namespace

ContactSpace JoinedContactSpaces(const std::vector<ContactSpace>& spaces) {
  if (spaces.empty()) {
    throw InputError("contact spaces to join: expected at least one, found 0");
  }
  if (spaces.size() == 1) return spaces.front();
  ContactSpace::Parts all = spaces.front().parts();
  bool has_planes = !all.plane.empty(), has_kinds = !all.kind.empty();
  for (std::size_t i = 1; i < spaces.size(); ++i) {
    Append(spaces[i], &all);
    Add(spaces[i].report(), &all.report);
    has_planes = has_planes && !spaces[i].plane().empty();
    has_kinds = has_kinds && !spaces[i].kind().empty();
  }
  if (!has_planes) all.plane.clear();
  if (!has_kinds) all.kind.clear();
  const QualityFigures quality = MeasureQuality(all.mesh);
  all.report.worst_quality = quality.worst;
  all.report.median_quality = quality.median;
  return ContactSpace(std::move(all));
}

}  // namespace phongpd
