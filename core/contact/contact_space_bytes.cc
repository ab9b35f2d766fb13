// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_bytes.h"

#include <cstdint>

#include "core/contact/builder_digest.h"
#include "core/contact/byte_stream.h"
#include "core/contact/content_hash.h"
#include "core/mesh/finite.h"

namespace phongpd {
namespace {

// To be raised when the meaning of the bytes changes without their source,
// which kBuilderDigest tells.
constexpr std::uint32_t kCacheFormat = 1;

// What a kind is whose name nobody knows: IsValid refuses it.
constexpr auto kNoApproximation = static_cast<ApproximationKind>(-1);

}  // namespace

// Beside the structs, where the streams find them.

template <typename Stream>
void Fields(Stream* io, TriangleMesh& mesh) {
  auto& [vertices, triangles] = mesh;
  (*io)(vertices, triangles);
}

template <typename Stream>
void Fields(Stream* io, ContactSpaceOptions& options) {
  auto& [merge_coplanar, outer_shell_only, repair, wrap_alpha, robot_hull,
         target_faces, max_seconds, max_mib, robot_name, obstacle_name] =
      options;
  (*io)(merge_coplanar, outer_shell_only, repair, wrap_alpha, robot_hull,
        target_faces, max_seconds, max_mib, robot_name, obstacle_name);
}

template <typename Stream>
void Fields(Stream* io, PredictedCost& cost) {
  auto& [meetings, arrangement_faces, seconds, mib] = cost;
  (*io)(meetings, arrangement_faces, seconds, mib);
}

template <typename Stream>
void Fields(Stream* io, MeshReport& report) {
  auto& [vertices, triangles, components, non_finite, bad_indices, boundary,
         non_manifold, misoriented, degenerate, duplicate_vertices,
         duplicate_triangles, self_intersections, joined, inverted, volume,
         warnings] = report;
  (*io)(vertices, triangles, components, non_finite, bad_indices, boundary,
        non_manifold, misoriented, degenerate, duplicate_vertices,
        duplicate_triangles, self_intersections, joined, inverted, volume,
        warnings);
}

template <typename Stream>
void Fields(Stream* io, RepairReport& report) {
  auto& [duplicate, mirrored, degenerate, turned, joined, is_wrapped,
         wrap_reason, wrap_alpha, wrap_bound, actions] = report;
  (*io)(duplicate, mirrored, degenerate, turned, joined, is_wrapped,
        wrap_reason, wrap_alpha, wrap_bound, actions);
}

// Kinds are their names in the bytes, as files have them since the first
// version.
template <typename Stream>
void Fields(Stream* io, ApproximationStep& step) {
  auto& [operand, kind, bound, lower_bound, is_surface_bound, is_conservative,
         before, after, dropped_cavities] = step;
  std::string name = ApproximationName(kind);
  (*io)(operand, name, bound, lower_bound, is_surface_bound, is_conservative,
        before, after, dropped_cavities);
  // Read; a writer's step is const.
  if (name != ApproximationName(kind)) {
    kind = FindApproximation(name).value_or(kNoApproximation);
  }
}

template <typename Stream>
void Fields(Stream* io, Approximation& approximation) {
  auto& [bound, is_conservative, steps] = approximation;
  std::string kinds = KindsOf(approximation);  // of the steps, read anyhow
  (*io)(kinds, bound, is_conservative, steps);
}

template <typename Stream>
void Fields(Stream* io, ContactSpaceReport& report) {
  auto& [triangles, vertices, closed, manifold, components, genus, cavities,
         volume, self_intersections, degenerate, worst_quality, median_quality,
         from_cache, seconds, peak_mib, predicted, method, convolution, faces,
         cells, judged, canonical_frame, grid_step, approximation, robot,
         obstacle, robot_repair, obstacle_repair, warnings] = report;
  (*io)(triangles, vertices, closed, manifold, components, genus, cavities,
        volume, self_intersections, degenerate, worst_quality, median_quality,
        from_cache, seconds, peak_mib, predicted, method, convolution, faces,
        cells, judged, canonical_frame, grid_step, approximation, robot,
        obstacle, robot_repair, obstacle_repair, warnings);
}

template <typename Stream>
void Fields(Stream* io, ContactSpace::Parts& space) {
  auto& [mesh, plane, kind, report] = space;
  (*io)(mesh, plane, kind, report);
}

namespace internal {

std::string KeyBytes(const TriangleMesh& robot, const TriangleMesh& obstacle,
                     const ContactSpaceOptions& options) {
  ByteWriter writer;
  writer(kCacheFormat, std::string(internal::kBuilderDigest), robot, obstacle,
         options);
  return writer.Take();
}

std::string ToBytes(const ContactSpace::Parts& space) {
  ByteWriter writer;
  writer(space);
  return writer.Take();
}

namespace {

// Is it what others rely on without looking again?
bool IsValid(const ContactSpace::Parts& space) {
  const std::size_t triangles = space.mesh.triangles.size();
  for (const std::size_t size : {space.plane.size(), space.kind.size()}) {
    if (size != triangles && size != 0) return false;
  }
  for (const int plane : space.plane) {
    if (plane < 0 || static_cast<std::size_t>(plane) >= triangles) return false;
  }
  for (const Eigen::Vector3d& v : space.mesh.vertices) {
    if (!IsFinite(v)) return false;
  }
  const auto size = static_cast<int>(space.mesh.vertices.size());
  for (const Triangle& triangle : space.mesh.triangles) {
    for (const int v : triangle) {
      if (v < 0 || v >= size) return false;
    }
  }
  for (const ContactKind kind : space.kind) {
    if (kind < ContactKind::kObstacleFacet || kind > ContactKind::kNone) {
      return false;
    }
  }
  for (const ApproximationStep& step : space.report.approximation.steps) {
    if (step.kind == kNoApproximation) return false;
  }
  return true;
}

}  // namespace

bool FromBytes(std::string_view bytes, ContactSpace::Parts* space) {
  ByteReader reader(bytes);
  reader(*space);
  return reader.Done() && IsValid(*space);
}

std::string Seal(std::string_view content) {
  ByteWriter writer;
  writer(static_cast<std::uint64_t>(content.size()), HashContent(content));
  return writer.Take();
}

}  // namespace internal
}  // namespace phongpd
