// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"

namespace phongpd {

// The boundary of a part of free space that was explored: closed, of facets of
// C_cont, and of walls (ContactKind::kNone) where free space goes on, or where
// all is free.  What is free of it, and bounded, is free.
//
// It is no contact space.  Behind a wall is free space, and what of C_cont was
// not explored is missing: depths and distances to it are those of nothing.  So
// metrics, rows and trackers do not take it; judges and planners of free space
// may, by AsContactSpace, who thereby says that walls count as contact.
class ExploredSpace {
 public:
  // Throws as ContactSpace.
  explicit ExploredSpace(ContactSpace::Parts parts, const std::string& name)
      : closed_(std::move(parts), name) {}

  const TriangleMesh& mesh() const { return closed_.mesh(); }
  const std::vector<ContactKind>& kind() const { return closed_.kind(); }
  const BoundingBox& bounds() const { return closed_.bounds(); }

  const ContactSpace& AsContactSpace() const { return closed_; }

 private:
  ContactSpace closed_;
};

// Free space explored from two configurations until they meet, or until one is
// known to be enclosed: the exact contact space of what a motion between them
// passes, and nothing else.
//
// Configuration space is halved into boxes until few facets of the convolution
// meet each.  A box that is reached is arranged exactly (as the boxes of
// contact_space_piece.h are): its free space falls into rooms, which go on
// beyond its walls.  From either end the boxes behind the walls of rooms that
// were reached are taken in turn, first those by which the way to the other end
// may be shortest; the two ends take turns by what they have cost.
//
// So a path costs what lies about it, and a proof that there is none the
// smaller of the two cells.
class FreeSpaceFlood {
 public:
  enum class Outcome {
    kOngoing,
    kMet,            // rooms of both are connected, as far as boxes tell
    kStartEnclosed,  // all of the start's cell was reached, not the goal
    kGoalEnclosed,
  };

  // `start` and `goal` free (ConvolutionModel::IsFree); throws InputError
  // otherwise.  Keeps the model.
  FreeSpaceFlood(const ConvolutionModel& model, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& goal);
  ~FreeSpaceFlood();

  // Explores until there is an outcome, or goes on beyond kMet, until `faces`
  // more have been arranged.  Throws BuildRefusal where the model's limits are
  // passed, counted from the flood's beginning, and BuildCancelled.
  Outcome Explore(std::size_t faces);

  // The ends as they are explored from: the configurations, or where they are
  // far away the nearest points of the box of all sums and something around it;
  // the straight way there is free.
  const Eigen::Vector3d& start() const;
  const Eigen::Vector3d& goal() const;

  // The boundary of the free space that was reached.  Throws std::logic_error
  // where rooms do not fit together because cells at their walls are too thin
  // to be judged.
  ExploredSpace Surface() const;
  // Of the cell alone that is enclosed: C_cont around it, no wall is left.
  ExploredSpace EnclosingSurface() const;

  std::size_t boxes() const;  // arranged
  std::size_t faces() const;  // in their arrangements

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
