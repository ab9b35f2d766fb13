// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>

#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"

namespace phongpd {

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

  // The boundary of the free space that was reached: C_cont there, and walls
  // (ContactKind::kNone) where it goes on, or where all is free.  To be taken
  // for a contact space: what is free of it, and bounded, is free.  Throws
  // std::logic_error where rooms do not fit together because cells at their
  // walls are too thin to be judged.
  ContactSpace Surface() const;
  // Of the cell alone that is enclosed: C_cont, no wall is left.
  ContactSpace EnclosingSurface() const;

  std::size_t boxes() const;  // arranged
  std::size_t faces() const;  // in their arrangements

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
