// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/contact/byte_stream.h"
#include "core/contact/contact_space_bytes.h"
#include "core/contact/piece_data.h"
#include "core/contact/sealed_file.h"
#include "core/mesh/mesh_error.h"

namespace phongpd::internal {
namespace {

const char kWritePieceAnew[] =
    "; write it anew by phongpd contact-space --piece";

constexpr SealedFormat kPieceFormat = {
    "phongpd piece of a contact space\n", 1,
    "a piece written by phongpd contact-space --piece", kWritePieceAnew};

// Either way: what is written is put together again as it was.
template <typename Stream>
void Wide128(Stream* io, Int128& value) {
  auto low = static_cast<std::uint64_t>(value);
  auto high = static_cast<std::int64_t>(value >> 64);
  (*io)(low, high);
  value = Int128(high) * (Int128(1) << 64) + Int128(low);
}

}  // namespace

template <typename Stream>
void Fields(Stream* io, GridPlane& plane) {
  auto& [normal, offset] = plane;
  for (Int128& x : normal) Wide128(io, x);
  Wide128(io, offset);
}

template <typename Stream>
void Fields(Stream* io, SurfacePiece::Side& side) {
  auto& [plane, is_reversed, kind] = side;
  (*io)(plane, is_reversed, kind);
}

template <typename Stream>
void Fields(Stream* io, SurfacePiece::Point& point) {
  auto& [kind, a, b, side_a, side_b, planes] = point;
  (*io)(kind);
  if (kind == PointDefinition::kPlanes) {
    (*io)(planes);
    return;
  }
  (*io)(a);
  if (kind == PointDefinition::kVertex) return;
  (*io)(b);
  Wide128(io, side_a);
  Wide128(io, side_b);
}

template <typename Stream>
void Fields(Stream* io, SurfacePiece::Edge& edge) {
  auto& [from, to, next, walls] = edge;
  (*io)(from, to, next, walls);
}

template <typename Stream>
void Fields(Stream* io, SurfacePiece::Face& face) {
  auto& [side, begin, end, cell] = face;
  (*io)(side, begin, end, cell);
}

template <typename Stream>
void Fields(Stream* io, SurfacePiece& piece) {
  auto& [planes, sides, points, edges, faces, arranged, cells, judged] = piece;
  (*io)(planes, sides, points, edges, faces, arranged, cells, judged);
}

template <typename Stream>
void Fields(Stream* io, LatticeUnit& unit) {
  auto& [scale, divides, exponent] = unit;
  (*io)(scale, divides, exponent);
}

template <typename Stream>
void Fields(Stream* io, GridFrame& frame) {
  auto& [robot, obstacle, step, rounding, is_turned, rotation, origin, unit,
         shift, stride] = frame;
  (*io)(step, rounding, is_turned);
  for (int k = 0; k < 9; ++k) (*io)(rotation.data()[k]);
  (*io)(origin, unit, shift, stride);
}

namespace {

bool IsIndex(int i, std::size_t size) {
  return i >= 0 && static_cast<std::size_t>(i) < size;
}

// Can it be joined without looking again?
bool IsValidPiece(const SurfacePiece& piece) {
  const std::size_t planes = piece.planes.size(), edges = piece.edges.size();
  for (const SurfacePiece::Side& side : piece.sides) {
    if (!IsIndex(side.plane, planes)) return false;
    if (side.kind < ContactKind::kObstacleFacet ||
        side.kind > ContactKind::kEdges) {
      return false;
    }
  }
  for (const SurfacePiece::Point& point : piece.points) {
    if (point.kind < PointDefinition::kVertex ||
        point.kind > PointDefinition::kPlanes) {
      return false;
    }
    for (const int plane : point.planes) {
      if (point.kind == PointDefinition::kPlanes && !IsIndex(plane, planes)) {
        return false;
      }
    }
  }
  for (const SurfacePiece::Edge& e : piece.edges) {
    if (!IsIndex(e.from, piece.points.size()) ||
        !IsIndex(e.to, piece.points.size()) || !IsIndex(e.next, edges)) {
      return false;
    }
  }
  std::vector<bool> follows(edges, false);
  std::size_t at = 0;  // faces follow each other
  for (const SurfacePiece::Face& f : piece.faces) {
    if (!IsIndex(f.side, piece.sides.size()) ||
        f.begin != static_cast<int>(at) || f.end <= f.begin) {
      return false;
    }
    // And their borders close.
    for (int e = f.begin; e < f.end; ++e) {
      const int next = IsIndex(e, edges) ? piece.edges[e].next : -1;
      if (next < f.begin || next >= f.end || follows[next]) return false;
      if (piece.edges[next].from != piece.edges[e].to) return false;
      follows[next] = true;
    }
    at = static_cast<std::size_t>(f.end);
  }
  return at == edges;
}

}  // namespace
}  // namespace phongpd::internal

namespace phongpd {

std::string PieceContent(const ContactSpacePiece& piece) {
  const ContactSpacePiece::Data& data = piece.data();
  ContactSpace::Parts about;
  about.report = data.report;
  internal::ByteWriter writer;
  writer(data.build, data.number.index, data.number.count,
         data.outer_shell_only, data.frame, internal::ToBytes(about),
         data.boxes);
  return internal::SealedFile(internal::kPieceFormat, writer.Take());
}

ContactSpacePiece ParsePiece(const std::string& bytes,
                             const std::string& name) {
  auto data = std::make_shared<ContactSpacePiece::Data>();
  data->name = name;
  std::string about;
  internal::ByteReader reader(
      internal::ContentOf(internal::kPieceFormat, bytes, name));
  reader(data->build, data->number.index, data->number.count,
         data->outer_shell_only, data->frame, about, data->boxes);
  ContactSpace::Parts parts;
  if (!reader.Done() || !internal::FromBytes(about, &parts) ||
      data->number.index < 0 || data->number.index >= data->number.count ||
      !std::all_of(data->boxes.begin(), data->boxes.end(),
                   internal::IsValidPiece)) {
    throw InputError(name +
                     ": expected a piece of a contact space behind a valid "
                     "checksum, found none" +
                     internal::kWritePieceAnew);
  }
  data->report = std::move(parts.report);
  return ContactSpacePiece(std::move(data));
}

}  // namespace phongpd
