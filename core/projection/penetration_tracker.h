// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/contact_space.h"
#include "core/projection/query_status.h"

namespace phongpd {

struct Depth;  // core/contact/depth.h

struct PenetrationTrackerOptions {
  // c ≥ 1: the contact seeks a place where the depth is at most c times the
  // Euclidean depth.  The smaller c is, the more rarely can it slide there
  // without leaving such places on its way.
  double ratio = 3.0;
  // κ > 0: in one step the contact moves along the surface by at most κ times
  // the robot's own step.
  double speed = 10.0;

  void Validate() const;  // throws InputError unless finite and in range
};

using TrackerStatus = QueryStatus;  // old name, removed in 0.3

// The answer to one step of a motion.  Lengths in the user's unit.
struct TrackerResult {
  QueryStatus status = QueryStatus::kInvalid;
  bool inside = false;    // exact: q strictly inside C_obj
  bool touching = false;  // exact: q on C_cont
  Eigen::Vector3d pd = Eigen::Vector3d::Zero();  // p − q inside, else zero
  double magnitude = 0.0;                        // |pd|
  double euclidean_depth = 0.0;  // d: distance of q to C_cont inside, else 0
  double ratio = 0.0;            // |pd|/d ≥ 1 inside (to rounding), else 0
  double moved = 0.0;  // how far the contact moved along the surface, ≤ κ|Δq|
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  // p on C_cont inside
  int triangle = -1;  // of the contact-space mesh, holds p; −1 outside

  // The same in the words of all depths, without witnesses: the depth is
  // |pd|, the least one (explored_radius) d.  Outside nothing was measured:
  // the clearance is 0, and not certified.
  Depth ToDepth() const;
};

// Penetration depth of a robot that moves, without a jump: the contact is a
// point p that slides over C_cont, like the proxy of haptic rendering (Zilles
// and Salisbury 1995; Ruspini, Kolarov and Khatib 1997), at a bounded speed.
// For the next q:
//
//   1. d = distance of q to C_cont; S = {x ∈ C_cont : |x − q| ≤ c·d}.
//   2. The goal of p is the point closest to q in the connected piece of S that
//      holds p; if p is outside S, in the piece to which a short way leads.
//   3. p moves to it along the surface, by at most κ·|Δq|; PD = p − q.
//
// So while q is inside, |ΔPD| ≤ (κ + 1)·|Δq| (to rounding: some 1e-14 of the
// diagonal) whatever the shape.  Entering C_obj, p starts at the closest point
// and |PD| ≤ |Δq|.  Leaving it, PD becomes zero: within the bound, or counted
// as kLeftElsewhere.  The price is depth: usually |PD| ≤ c·d, but there is no
// bound while p is on its way, nor if C_cont has several components.  p cannot
// leave the component through which it entered; if all of that is farther than
// c·d, its own distance takes the place of d.
//
// Most steps are a descent over the triangles next to p.  If the closest point
// of all is elsewhere, a way to another place is searched for, and again at the
// latest when q has moved by a few hundredths of d; between searches p keeps
// the last goal, and the way while it is on it.  Ways are short, not shortest.
//
// It is a state along a motion, not a field: two motions to the same q may
// have different contacts, there is no gradient, and what happens between two
// steps is not seen.  For solvers: PhongMetric.
//
// Deterministic.  The tracker is immutable, copies share everything, any
// number of threads may step their own states.
class PenetrationTracker {
 public:
  // Where a motion is.  A value: a copy is a motion of its own.  A new state
  // has not begun; a state of another tracker, or one that was moved from,
  // counts as new.
  class State {
   public:
    State();
    ~State();
    State(const State& other);
    State& operator=(const State& other);
    State(State&&) noexcept;
    State& operator=(State&&) noexcept;

   private:
    friend class PenetrationTracker;
    struct Data;
    std::unique_ptr<Data> data_;
  };

  // Throws InputError for options.
  explicit PenetrationTracker(const ContactSpace& space,
                              const PenetrationTrackerOptions& options = {});

  // The answer at q, the next position of the motion that *state belongs to.
  // Allocates only when a way or a search is longer than all before.
  TrackerResult Step(const Eigen::Vector3d& q, State* state) const;

  const PenetrationTrackerOptions& options() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace phongpd
