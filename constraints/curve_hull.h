// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "constraints/trajectory.h"
#include "constraints/translated_triangles.h"

// Where a part of a curve is, on the user's own coordinates, with every
// rounding outwards.  Shares no code with the judge of curves
// (curve_judge.h), because it is there to judge it.
namespace phongpd::internal {

// A box for each Bézier point of a part of a piece: the part lies in the convex
// hull of the boxes.
class CurveHull {
 public:
  // Of a whole piece: its points, to the last bit.
  explicit CurveHull(const CurvePiece& piece);

  // The parts before and after the middle, by de Casteljau in intervals; the
  // first begins in the same box as this, the second where the first ends.
  std::array<CurveHull, 2> Halves() const;
  // All boxes moved by v.
  CurveHull MovedBy(const Eigen::Vector3d& v) const;

  int size() const { return size_; }  // points: degree + 1
  const Eigen::Vector3d& low(int i) const { return low_[i]; }
  const Eigen::Vector3d& high(int i) const { return high_[i]; }
  // A configuration of box i.
  Eigen::Vector3d At(int i) const {
    return low_[i] + 0.5 * (high_[i] - low_[i]);
  }

 private:
  CurveHull() = default;

  int size_ = 0;
  CurvePiece::Points low_, high_;
};

// The widest gap found between two sets, along a unit axis; negative where they
// overlap along all axes tried, to rounding.
struct HullGap {
  bool is_apart = true;  // proved
  double gap = std::numeric_limits<double>::infinity();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // away from the second
};

// Have A + q and B no point in common for all q of the hull?  Some axis shows
// it, of those that decide for the hull's chord (MeetWhileMoving) and the
// coordinate axes.  "Apart" is proved by intervals along that axis; else the
// hull may be too thick.
HullGap FindHullGap(const Corners& a, const Corners& b, const CurveHull& hull);

}  // namespace phongpd::internal
