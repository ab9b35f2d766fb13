// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"

namespace phongpd {

// A contact space built by pieces: C_cont in boxes of q-space, each arranged
// for itself, and joined to the surface that BuildContactSpace builds, to the
// last bit of its mesh, planes and kinds.  Memory is that of the boxes in
// flight and of the surface, not of the whole arrangement; the work of n parts
// is independent, so that n processes can do it and any one join them.
//
// Boxes in which the operands surely overlap, or which no facet of the
// convolution meets, are left out.

// i of n, 0 ≤ i < n.  Parts 2i and 2i + 1 of 2n are together what i of n is, so
// that one that takes too much memory can be built in halves, again and again.
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
  // Boxes it was made of, and faces of C_cont found in them.
  std::size_t boxes() const;
  std::size_t faces() const;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

// Throws InputError for a number that is none, for options.merge_coplanar =
// false (what the walls of boxes cut is found again by the planes it is on),
// and what BuildContactSpace throws.
ContactSpacePiece BuildContactSpacePiece(const TriangleMesh& robot,
                                         const TriangleMesh& obstacle,
                                         const ContactSpaceOptions& options,
                                         PieceNumber number);

// All n parts of one build, or some of them in halves, in any order.  Of the
// report, all that is of the operands and of the surface is as in
// BuildContactSpace; faces and cells are those of all boxes together; nothing
// is said of time, memory and prediction, so that the result does not depend on
// n, nor on halves.  Throws InputError naming the part that is missing, there
// twice, or of another build.
//
// The surface is that of BuildContactSpace, mesh, planes and kinds alike; or,
// where a cell beside the border of a box is so thin that no point of it can be
// judged, there is none and InputError says to build the whole: 10 of 2,500
// random pairs, all degenerate (contact_space_piece_test in its long form).
ContactSpace JoinContactSpace(const std::vector<ContactSpacePiece>& pieces);

// A part as a file for machines of one kind, with a checksum (as .pcs files,
// contact_space_file.h), the digest of all that the build depends on and its
// number.  `name` stands in the errors of parsing and of joining.  Throw
// InputError: a file of another kind, version or machine, cut short, changed.
std::string PieceContent(const ContactSpacePiece& piece);
ContactSpacePiece ParsePiece(const std::string& bytes, const std::string& name);

}  // namespace phongpd
