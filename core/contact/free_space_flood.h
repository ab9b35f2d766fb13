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

// The boundary of a part of free space that was explored.  It is closed, made
// of facets of C_cont and of walls (ContactKind::kNone), behind which free
// space goes on.  What lies on its free side, and is bounded, is free.
//
// It is no contact space.  Behind a wall there is free space, and the part of
// C_cont that was not explored is missing: depths and distances to walls mean
// nothing.  So metrics, rows and trackers do not take it.  Judges and planners
// of free space may, by AsContactSpace, which says that walls count as contact.
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

// Explores free space from two configurations until the explored parts meet, or
// until one configuration is known to be enclosed.  Only that part of the
// contact space is built, exactly, which a motion between the two passes.
//
// Configuration space is halved into boxes until few facets of the convolution
// meet each box.  A box that is reached is arranged exactly, like the boxes of
// contact_space_piece.h.  Its free space consists of rooms, which go on behind
// the walls of the box.  From each end, the boxes behind the walls of rooms
// that were reached come next, first those through which the way to the other
// end may be shortest.  The two ends take turns, so that both cost about the
// same.
//
// So a path costs as much as what lies about it, and a proof that there is none
// as much as the smaller of the two cells.
class FreeSpaceFlood {
 public:
  enum class Outcome {
    kOngoing,
    kMet,            // rooms of both are connected, as far as boxes tell
    kStartEnclosed,  // all of the start's cell was reached, not the goal
    kGoalEnclosed,
  };

  // Throws InputError unless `start` and `goal` are free
  // (ConvolutionModel::IsFree).  Keeps the model.
  FreeSpaceFlood(const ConvolutionModel& model, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& goal);
  ~FreeSpaceFlood();

  // Explores until there is an outcome (after kMet: goes on), or until `faces`
  // more faces have been arranged.  Throws BuildRefusal if the model's limits
  // are passed, counted from the flood's beginning, and BuildCancelled.
  Outcome Explore(std::size_t faces);

  // Where exploring begins: at the two configurations, or, if these are far
  // away, at the nearest points of a box that is somewhat larger than that of
  // all sums; the straight way there is free.
  const Eigen::Vector3d& start() const;
  const Eigen::Vector3d& goal() const;

  // The boundary of the free space that was reached.  Throws std::logic_error
  // where rooms do not fit together because cells at their walls are too thin
  // to be judged.
  ExploredSpace Surface() const;
  // C_cont around the enclosed cell alone, without any wall.
  ExploredSpace EnclosingSurface() const;

  std::size_t boxes() const;  // arranged
  std::size_t faces() const;  // in their arrangements

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
