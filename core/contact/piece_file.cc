// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/contact/byte_stream.h"
#include "core/contact/contact_space_bytes.h"
#include "core/contact/piece_cover.h"
#include "core/contact/piece_data.h"
#include "core/contact/sealed_file.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/cells/piece_check.h"

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

// Would it place what is joined somewhere?  Turned by a rotation, up to
// rounding, and with all numbers where a mesh's may be.
bool IsValidFrame(const GridFrame& frame) {
  constexpr double kLeast = 1e-160, kMost = 1e150;
  const auto is_length = [](double x) { return kLeast <= x && x <= kMost; };
  if (!is_length(frame.step) || !is_length(frame.unit.scale) ||
      !is_length(frame.stride) || std::abs(frame.unit.exponent) > 1100 ||
      !is_length(std::abs(frame.unit.Length(frame.stride))) ||
      !(frame.rounding >= 0.0 && frame.rounding <= kMost)) {
    return false;
  }
  const Eigen::Matrix3d& turn = frame.rotation;
  return (turn * turn.transpose() - Eigen::Matrix3d::Identity())
                 .lpNorm<Eigen::Infinity>() < 1e-9 &&
         frame.origin.lpNorm<Eigen::Infinity>() <= kMost &&
         frame.shift.lpNorm<Eigen::Infinity>() <= kMost;
}

}  // namespace

bool HaveOneFrame(const GridFrame& a, const GridFrame& b) {
  ByteWriter of_a, of_b;
  of_a(a);
  of_b(b);
  return of_a.Take() == of_b.Take();
}

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
  const auto require = [&](bool is_met, const std::string& defect) {
    if (!is_met) {
      throw InputError(name + ": " + defect + internal::kWritePieceAnew);
    }
  };
  std::string about;
  internal::ByteReader reader(
      internal::ContentOf(internal::kPieceFormat, bytes, name));
  reader(data->build, data->number.index, data->number.count,
         data->outer_shell_only, data->frame, about, data->boxes);
  ContactSpace::Parts parts;
  require(reader.Done() && internal::FromBytes(about, &parts) &&
              parts.mesh.triangles.empty(),
          "expected a piece of a contact space behind a valid checksum, found "
          "none");
  require(data->number.index >= 0 && data->number.index < data->number.count,
          "expected the number i/n of a piece with 0 <= i < n, found " +
              internal::ToText(data->number));
  require(internal::IsValidFrame(data->frame),
          "expected a step > 0, a rotation and finite lengths of the grid, "
          "found others");
  for (std::size_t i = 0; i < data->boxes.size(); ++i) {
    const std::string defect = internal::PieceDefect(data->boxes[i]);
    require(defect.empty(), "box " + std::to_string(i) + ": " + defect);
  }
  data->report = std::move(parts.report);
  return ContactSpacePiece(std::move(data));
}

}  // namespace phongpd
