// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/global_control.h>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_bytes.h"
#include "core/contact/contact_space_piece.h"
#include "problems/shapes/shapes.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/resealed.h"

namespace phongpd::fuzz {
namespace {

const std::vector<TriangleMesh>& Seeds() {
  static const std::vector<TriangleMesh> seeds = {
      {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
       {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}},
      MakeBox({-1, -1, -1}, {1, 1, 1}),
      MakeCone(1.0, 2.0, 5),
      MakeL(2.0, 1.0, 1.0),
      Joined(MakeBox({-1, -1, -1}, {0, 0, 0}), MakeBox({0, 0, 0}, {1, 1, 1})),
      MakeBoxShell({-1, -1, -1}, {1, 1, 1}, 0.5)};
  return seeds;
}

void Change(ByteSource* source, TriangleMesh* mesh) {
  const auto vertex = [&]() -> Eigen::Vector3d& {
    return mesh->vertices[static_cast<std::size_t>(
        source->Below(static_cast<int>(mesh->vertices.size())))];
  };
  const auto triangle = [&] {
    return static_cast<std::size_t>(
        source->Below(static_cast<int>(mesh->triangles.size())));
  };
  const int kind = source->Below(8);
  Eigen::Vector3d& v = vertex();
  const int axis = source->Below(3);
  switch (kind) {
    case 0:
      v[axis] = source->Coordinate();
      return;
    case 1:  // by 2^-1 ... 2^-64
      v[axis] += std::ldexp(1.0, -1 - source->Below(64));
      return;
    case 2:
      v = vertex();
      return;
    case 3:  // next to another one
      v = vertex();
      v[axis] += std::ldexp(1.0, -30 - source->Below(34));
      return;
    case 4:  // into the middle of two
      v = 0.5 * (vertex() + vertex());
      return;
    case 5:
      std::swap(mesh->triangles[triangle()][0], mesh->triangles[triangle()][1]);
      return;
    case 6:
      mesh->triangles.push_back(mesh->triangles[triangle()]);
      return;
    default:
      *mesh = Translated(
          Scaled(std::move(*mesh), std::ldexp(1.0, source->Below(256) - 128)),
          {source->Coordinate(), 0, 0});
  }
}

TriangleMesh Changed(ByteSource* source) {
  TriangleMesh mesh = Seeds()[static_cast<std::size_t>(
      source->Below(static_cast<int>(Seeds().size())))];
  for (int changes = source->Below(5); changes > 0; --changes) {
    Change(source, &mesh);
  }
  return mesh;
}

}  // namespace

void Cache(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  phongpd::ContactSpace::Parts space, again;
  if (!internal::FromBytes(bytes, &space)) return;
  const std::string written = internal::ToBytes(space);
  Promise(internal::FromBytes(written, &again), "what is written is read");
  Promise(internal::ToBytes(again) == written, "and is the same");
}

void Piece(const std::uint8_t* data, std::size_t size) {
  static const tbb::global_control one(
      tbb::global_control::max_allowed_parallelism, 1);
  static const std::string file =
      PieceContent(BuildContactSpacePiece(Seeds()[0], Seeds()[0], {}, {0, 1}));
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const ContactSpacePiece piece = ParsePiece(Resealed(file, bytes), "fuzz");
    const phongpd::ContactSpace space = JoinContactSpace({piece});
    Promise(space.report().closed, "a contact space is closed");
    for (const Eigen::Vector3d& v : space.mesh().vertices) {
      Promise(v.allFinite(), "its vertices are finite");
    }
  } catch (const InputError& error) {
    // Or that other parts are missing.
    const bool is_of_join = std::string(error.what()).rfind("join", 0) == 0;
    PromiseReadable(error, is_of_join ? "join" : "fuzz");
  }
}

void ContactSpace(const std::uint8_t* data, std::size_t size) {
  static const tbb::global_control one(
      tbb::global_control::max_allowed_parallelism, 1);
  ByteSource source(data, size);
  const TriangleMesh robot = Changed(&source), obstacle = Changed(&source);
  try {
    const phongpd::ContactSpace space = BuildContactSpace(robot, obstacle);
    Promise(space.report().closed, "a contact space is closed");
    Promise(std::isfinite(space.report().volume), "its volume is finite");
    for (const Eigen::Vector3d& v : space.mesh().vertices) {
      Promise(v.allFinite(), "its vertices are finite");
    }
  } catch (const InputError& error) {
    PromiseReadable(error, "");
  }
}

}  // namespace phongpd::fuzz
