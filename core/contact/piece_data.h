// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/contact/contact_space_piece.h"
#include "core/contact/content_hash.h"
#include "core/minkowski/cells/surface_piece.h"
#include "core/minkowski/operands/grid_frame.h"

namespace phongpd {

struct ContactSpacePiece::Data {
  std::string name;             // for errors; not in the file
  internal::ContentHash build;  // operands, options, size of boxes, builder
  PieceNumber number;
  bool outer_shell_only = false;
  internal::GridFrame frame;  // without the operands' vertices
  ContactSpaceReport report;  // what is known of operands and convolution
  std::vector<internal::SurfacePiece> boxes;
};

namespace internal {

// To the last bit, but for the operands' vertices, which no piece keeps.
bool HaveOneFrame(const GridFrame& a, const GridFrame& b);

// BuildContactSpacePiece with boxes of another size.
ContactSpacePiece BuildPiece(const TriangleMesh& robot,
                             const TriangleMesh& obstacle,
                             const ContactSpaceOptions& options,
                             PieceNumber number, std::size_t facets_of_box);

}  // namespace internal
}  // namespace phongpd
