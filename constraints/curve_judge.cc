// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/curve_judge.h"

#include <algorithm>
#include <vector>

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Shares of the largest coordinate: of a distance or a height above a plane;
// and of a point that a split has moved, for each degree.
constexpr double kDistanceRounding = 0x1p-44;
constexpr double kSplitRounding = 0x1p-52;
// And of a part that is not split further.
constexpr double kResolution = 0x1p-40;

double FarthestCoordinate(const BoundingBox& box) {
  return box.IsEmpty()
             ? 0.0
             : box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
}

// Of what is in contact, one for each contact space or convolution.
std::vector<BoundingBox> ContactBoxes(const FreeSpace& space) {
  std::vector<BoundingBox> boxes;
  for (const ContactSpace& one : space.spaces()) boxes.push_back(one.bounds());
  for (const ConvolutionModel& one : space.convolutions()) {
    boxes.push_back(one.bounds());
  }
  return boxes;
}

double FarthestCoordinate(const FreeSpace& space, const Trajectory& curve) {
  double largest = FarthestCoordinate(space.bounds());
  for (const ContactSpace& one : space.spaces()) {
    largest = std::max(largest, FarthestCoordinate(one.bounds()));
  }
  for (const ConvolutionModel& one : space.convolutions()) {
    largest = std::max(largest, FarthestCoordinate(one.bounds()));
  }
  for (const CurvePiece& piece : curve.pieces()) {
    for (int i = 0; i <= piece.degree(); ++i) {
      largest = std::max(largest, piece.point(i).cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

// One piece after the other, each from its start: the first part that is not
// free ends it.
class Judge {
 public:
  Judge(const FreeSpace& space, const Trajectory& curve, long max_tests,
        double blur)
      : space_(space),
        max_tests_(max_tests),
        blur_(blur),
        boxes_(ContactBoxes(space)),
        largest_(FarthestCoordinate(space, curve)) {}

  CurveCheck Run(const Trajectory& curve) {
    bool free = !curve.empty();
    for (std::size_t i = 0; free && i < curve.pieces().size(); ++i) {
      piece_ = static_cast<int>(i);
      const CurvePiece& piece = curve.pieces()[i];
      const double start = curve.StartOf(i);
      free = piece.degree() == 1 && blur_ == 0.0 ? CheckStraight(piece, start)
                                                 : CheckCurved(piece, start);
      if (free) check_.free_until = curve.StartOf(i + 1);
    }
    if (free) {
      check_.verdict = MotionVerdict::kFree;
      check_.time = check_.free_until;
    }
    return check_;
  }

 private:
  bool CheckStraight(const CurvePiece& piece, double start) {
    ++check_.tests;
    if (space_.IsFree(piece.front(), piece.back())) return true;
    const MotionCheck motion = space_.Check(piece.front(), piece.back());
    const double fraction = std::clamp(motion.fraction, 0.0, 1.0);
    const double time = start + fraction * piece.duration();
    check_.free_until = time;
    return Fail(MotionVerdict::kCollides, time, piece.At(fraction));
  }

  bool CheckCurved(const CurvePiece& piece, double start) {
    collides_ = false;
    const double end = start + piece.duration();
    const double rounding = kDistanceRounding * largest_ + blur_;
    // Far from all, which is true of most pieces where few things are.
    if (IsWithinBounds(piece, rounding) && IsBesideAll(piece, rounding)) {
      ++check_.tests;
      return true;
    }
    if (!LooksFree(piece.front(), start)) return FailWhereItCollides();
    LooksFree(piece.back(), end);
    if (!CheckPart(piece, start, blur_)) return false;
    return !collides_ || FailWhereItCollides();
  }

  // Of a part that starts free, of a curve that may collide at its end, or
  // after it; `moved`: how far its points may be from those of the curve, by
  // rounding.
  bool CheckPart(const CurvePiece& part, double start, double moved) {
    ++check_.tests;
    if (IsHullFree(part, moved)) {
      check_.free_until = start + part.duration();
      return true;
    }
    const double middle = start + 0.5 * part.duration();
    if (check_.tests >= max_tests_ || Size(part) <= Resolution()) {
      return collides_ ? FailWhereItCollides()
                       : Fail(MotionVerdict::kUndecided, middle, part.At(0.5));
    }
    const auto half = part.Split(0.5);
    moved += part.degree() * kSplitRounding * largest_;
    // What is known to collide later tells a collision from a doubt before.
    const bool is_middle_free = LooksFree(half[1].front(), middle);
    if (!CheckPart(half[0], start, moved)) return false;
    return is_middle_free ? CheckPart(half[1], middle, moved)
                          : FailWhereItCollides();
  }

  // Of a configuration of the curve; remembers the last that is not free, which
  // is the earliest, as parts are halved.
  bool LooksFree(const Vector3d& q, double time) {
    if (space_.IsFree(q)) return true;
    collides_ = true;
    collision_time_ = time;
    collision_ = q;
    return false;
  }

  bool FailWhereItCollides() {
    return Fail(MotionVerdict::kCollides, collision_time_, collision_);
  }

  bool Fail(MotionVerdict verdict, double time, const Vector3d& configuration) {
    check_.verdict = verdict;
    check_.time = time;
    check_.piece = piece_;
    check_.configuration = configuration;
    return false;
  }

  bool IsHullFree(const CurvePiece& part, double moved) {
    const double rounding = kDistanceRounding * largest_ + moved;
    if (!IsWithinBounds(part, rounding)) return false;
    if (IsBesideAll(part, rounding)) return true;
    if (!space_.IsFree(part.front(), part.back())) return false;
    const double reach = part.Bend() * (1.0 + kDistanceRounding) + rounding;
    const auto separators =
        space_.FindSeparators(part.front(), part.back(), reach, 0.0);
    return std::all_of(
        separators.begin(), separators.end(), [&](const Separator& plane) {
          for (int i = 0; i <= part.degree(); ++i) {
            // From a corner, not from the origin: few digits are lost.
            double height = plane.normal.dot(part.point(i) - plane.corners[0]);
            for (const Vector3d& corner : plane.corners) {
              height =
                  std::min(height, plane.normal.dot(part.point(i) - corner));
            }
            if (!(height > rounding)) return false;
          }
          return true;
        });
  }

  // Is there an axis along which all points are beyond the box, of each box?
  bool IsBesideAll(const CurvePiece& part, double rounding) const {
    Vector3d low = part.front(), high = low;
    for (int i = 1; i <= part.degree(); ++i) {
      low = low.cwiseMin(part.point(i));
      high = high.cwiseMax(part.point(i));
    }
    return std::all_of(boxes_.begin(), boxes_.end(),
                       [&](const BoundingBox& box) {
                         return ((low - box.max).array() > rounding).any() ||
                                ((box.min - high).array() > rounding).any();
                       });
  }

  bool IsWithinBounds(const CurvePiece& part, double rounding) const {
    const BoundingBox& bounds = space_.bounds();
    if (bounds.IsEmpty()) return true;
    for (int i = 0; i <= part.degree(); ++i) {
      const auto q = part.point(i).array();
      if (!((q - bounds.min.array() > rounding).all() &&
            (bounds.max.array() - q > rounding).all())) {
        return false;
      }
    }
    return true;
  }

  double Resolution() const { return std::max(kResolution * largest_, blur_); }

  static double Size(const CurvePiece& part) {
    Vector3d low = part.front(), high = low;
    for (int i = 1; i <= part.degree(); ++i) {
      low = low.cwiseMin(part.point(i));
      high = high.cwiseMax(part.point(i));
    }
    return (high - low).maxCoeff();
  }
  const FreeSpace& space_;
  const long max_tests_;
  const double blur_;
  const std::vector<BoundingBox> boxes_;
  const double largest_;
  int piece_ = 0;
  bool collides_ = false;  // so, after what is looked at:
  double collision_time_ = 0.0;
  Vector3d collision_ = Vector3d::Zero();
  CurveCheck check_;
};

}  // namespace

CurveCheck CheckCurve(const FreeSpace& space, const Trajectory& curve,
                      long max_tests, double blur) {
  return Judge(space, curve, max_tests, blur).Run(curve);
}

}  // namespace phongpd
