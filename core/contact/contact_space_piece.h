// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"

namespace phongpd {

// A contact space built in pieces.  Space is divided into boxes; C_cont is
// found in each box by itself, and the parts are joined to the surface that
// BuildContactSpace builds, the same to the last bit in mesh, planes and kinds.
// Memory is needed for the boxes at work and for the surface, not for the whole
// arrangement.  The n parts do not depend on each other: n processes can build
// them, and any process can join them.
//
// Boxes are left out if the operands overlap everywhere in them, or if no facet
// of the convolution meets them.

// i of n, 0 ≤ i < n.  Parts 2i and 2i + 1 of 2n together are part i of n, so a
// part that takes too much memory can be built in halves, and these again.
struct PieceNumber {
  int index = 0;
  int count = 1;
};

// One of n parts of a build.  An immutable handle: copies are cheap.
class ContactSpacePiece {
 public:
  struct Data;
  explicit ContactSpacePiece(std::shared_ptr<const Data> data)
      : data_(std::move(data)) {}

  PieceNumber number() const;
  // How many boxes it was made of, and how many faces of C_cont they hold.
  std::size_t boxes() const;
  std::size_t faces() const;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

// Throws InputError unless 0 ≤ index < count, and for options.merge_coplanar =
// false (faces that a wall cuts are joined again by their planes); and what
// BuildContactSpace throws.
ContactSpacePiece BuildContactSpacePiece(const TriangleMesh& robot,
                                         const TriangleMesh& obstacle,
                                         const ContactSpaceOptions& options,
                                         PieceNumber number);

// Joins all n parts of one build, in any order; some of them may be in halves.
// The report tells of operands and surface what BuildContactSpace tells; faces
// and cells are counted over all boxes.  It says nothing of time, memory and
// prediction, so the result depends neither on n nor on halves.  Throws
// InputError naming the part that is missing, is there twice, or is of another
// build.
//
// Mesh, planes and kinds are those of BuildContactSpace.  The exception: a cell
// at the border of a box can be so thin that no point of it can be judged. Then
// InputError says to build the whole (10 of 2,500 random pairs, all degenerate:
// contact_space_piece_test in its long form).
ContactSpace JoinContactSpace(const std::vector<ContactSpacePiece>& pieces);

// A part as a file for machines of one kind, with a checksum (as .pcs files,
// contact_space_file.h), the digest of all that the build depends on and its
// number.  `name` stands in the errors of parsing and of joining.  Throw
// InputError: a file of another kind, version or machine, cut short, changed.
std::string PieceContent(const ContactSpacePiece& piece);
ContactSpacePiece ParsePiece(const std::string& bytes, const std::string& name);

}  // namespace phongpd
