// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/surface_piece.h"

namespace phongpd::internal {

PointDefinition DefinitionOf(const SurfacePiece& piece,
                             const SurfacePiece::Point& point) {
  PointDefinition out;
  out.kind = point.kind;
  out.a = point.a;
  out.b = point.b;
  out.side_a = point.side_a;
  out.side_b = point.side_b;
  if (point.kind == PointDefinition::kPlanes) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.planes[k] = piece.planes[point.planes[k]];
    }
  }
  return out;
}

int SurfacePieceWriter::AddPlane(const GridPlane& plane) {
  const auto [it, is_new] =
      planes_.emplace(plane, static_cast<int>(piece.planes.size()));
  if (is_new) piece.planes.push_back(plane);
  return it->second;
}

int SurfacePieceWriter::AddSide(const GridPlane& plane, bool is_reversed,
                                ContactKind kind) {
  const int number = AddPlane(plane);
  const auto [it, is_new] = sides_.emplace(
      2 * number + (is_reversed ? 1 : 0), static_cast<int>(piece.sides.size()));
  if (is_new) piece.sides.push_back({number, is_reversed, kind});
  return it->second;
}

int SurfacePieceWriter::AddPoint(int id, const PointDefinition& point) {
  const auto [it, is_new] =
      points_.emplace(id, static_cast<int>(piece.points.size()));
  if (!is_new) return it->second;
  SurfacePiece::Point out;
  out.kind = point.kind;
  out.a = point.a;
  out.b = point.b;
  out.side_a = point.side_a;
  out.side_b = point.side_b;
  if (point.kind == PointDefinition::kPlanes) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.planes[k] = AddPlane(point.planes[k]);
    }
  }
  piece.points.push_back(out);
  return it->second;
}

}  // namespace phongpd::internal
