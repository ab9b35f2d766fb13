// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/collide_and_slide.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/mesh/finite.h"
#include "planners/exact/check_option.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxMoves = 100;  // of one slide
constexpr double kStep = 2e-2;  // of StepRetract, of the region's diagonal

// A body that moves towards a target, and what it last ran into.
class Slider {
 public:
  Slider(const ContactModel& model, double clearance, const Vector3d& start,
         std::vector<Vector3d>* path, SlideCounters* counters)
      : model_(model),
        clearance_(clearance * model.diagonal()),
        at_(start),
        path_(*path),
        counters_(*counters) {}

  enum class Outcome { kDone, kMoved, kBlocked };

  // Moves by `motion`, or as far as the first contact allows.  kDone: all the
  // way; otherwise *normal is the facet's that stopped it, zero if none did.
  Outcome Move(const Vector3d& motion, bool to_target, Vector3d* normal) {
    *normal = Vector3d::Zero();
    const double length = motion.norm();
    if (!(length >= ShortestMove())) return Outcome::kBlocked;
    const Vector3d end = at_ + motion;
    ++counters_.segment_checks;
    const MotionCheck check = model_.free_space().Check(at_, end);
    // The target is the caller's; points in between keep the floor.
    if (check.free && (to_target || KeepsFloor(end))) {
      Accept(end);
      return Outcome::kDone;
    }
    if (check.free) return MoveShorter(motion, 1.0);
    if (check.fraction <= 0.0) return Outcome::kBlocked;
    const ContactModel::Facet met = model_.FacetMet(at_, end, check);
    *normal = met.normal;
    const double opposed = -met.normal.dot(motion) / length;
    if (!(opposed > 0.0)) return Outcome::kBlocked;
    ++counters_.rays;
    const double standoff = model_.Standoff(met, clearance_);
    const double fraction = check.fraction - standoff / (opposed * length);
    // Advances that are short beside the standoff would go on for ever.
    if (fraction * length < std::max(ShortestMove(), 0.02 * standoff)) {
      return Outcome::kBlocked;
    }
    return MoveShorter(motion, fraction);
  }

  const Vector3d& at() const { return at_; }

 private:
  double ShortestMove() const { return 4.0 * model_.floor(); }

  bool KeepsFloor(const Vector3d& q) const {
    return model_.free_space().Clearance(q) >= model_.floor();
  }

  // Up to `fraction` of a motion that is free that far, halved where the end
  // would come too close to something the motion passes.
  Outcome MoveShorter(const Vector3d& motion, double fraction) {
    for (int halving = 0; halving < 3; ++halving, fraction *= 0.5) {
      if (fraction * motion.norm() < ShortestMove()) break;
      const Vector3d end = at_ + fraction * motion;
      if (!KeepsFloor(end)) continue;
      ++counters_.segment_checks;
      if (!model_.free_space().IsFree(at_, end)) continue;
      Accept(end);
      return Outcome::kMoved;
    }
    return Outcome::kBlocked;
  }

  void Accept(const Vector3d& q) {
    at_ = q;
    path_.push_back(q);
    ++counters_.moves;
  }

  const ContactModel& model_;
  const double clearance_;
  Vector3d at_;
  std::vector<Vector3d>& path_;
  SlideCounters& counters_;
};

Vector3d Without(const Vector3d& motion, const Vector3d& normal) {
  return motion - motion.dot(normal) * normal;
}

// The part of the motion along the line both planes share; zero if they are
// (nearly) parallel.
Vector3d AlongCrease(const Vector3d& motion, const Vector3d& n_1,
                     const Vector3d& n_2) {
  Vector3d crease = n_1.cross(n_2);
  const double sine = crease.norm();
  if (sine < 1e-6) return Vector3d::Zero();
  crease /= sine;
  return motion.dot(crease) * crease;
}

}  // namespace

SlideStatus CollideAndSlide(const ContactModel& model, double clearance,
                            const Vector3d& a, const Vector3d& b,
                            std::vector<Vector3d>* path,
                            SlideCounters* counters) {
  using Outcome = Slider::Outcome;
  CheckOption(clearance > 0.0 && clearance <= 1.0, "slide", "clearance",
              "in (0, 1]", clearance);
  path->clear();
  ++counters->slides;
  if (!IsFinite(b) || !model.free_space().IsFree(a)) {
    return SlideStatus::kInvalid;
  }
  path->push_back(a);
  if (a == b) return SlideStatus::kReached;
  Slider slider(model, clearance, a, path, counters);
  while (path->size() <= kMaxMoves) {
    const std::size_t before = path->size();
    Vector3d n_1, n_2, n_3;
    Outcome outcome = slider.Move(b - slider.at(), true, &n_1);
    if (outcome == Outcome::kDone) return SlideStatus::kReached;
    if (!n_1.isZero()) {
      outcome = slider.Move(Without(b - slider.at(), n_1), false, &n_2);
      if (outcome != Outcome::kDone && !n_2.isZero()) {
        slider.Move(AlongCrease(b - slider.at(), n_1, n_2), false, &n_3);
      }
    }
    if (path->size() == before) return SlideStatus::kStopped;
  }
  return SlideStatus::kMoveLimit;
}

SlideStatus StepRetract(const Retraction& retraction, const Vector3d& a,
                        const Vector3d& b, std::mt19937_64* random,
                        RetractionScratch* scratch, std::vector<Vector3d>* path,
                        SlideCounters* counters) {
  const ContactModel& model = retraction.model();
  const FreeSpace& space = model.free_space();
  path->clear();
  ++counters->slides;
  if (!IsFinite(b) || !space.IsFree(a)) return SlideStatus::kInvalid;
  path->push_back(a);
  if (a == b) return SlideStatus::kReached;
  const double longest = kStep * model.diagonal();
  double step = longest;
  while (path->size() <= kMaxMoves) {
    const Vector3d at = path->back();
    const double left = (b - at).norm();
    const bool last = left <= step;
    Vector3d next = last ? b : Vector3d(at + (step / left) * (b - at));
    if (!last || !space.IsFree(b)) {
      retraction.Retract(next, random, scratch);
      double nearest = std::numeric_limits<double>::infinity();
      const Vector3d wanted = next;
      for (const RetractedPoint& point : scratch->points) {
        const double distance = (point.q - wanted).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        next = point.q;
      }
    }
    ++counters->segment_checks;
    const bool closer = (b - next).norm() < left - 1e-2 * step;
    const bool keeps = next == b || space.Clearance(next) >= model.floor();
    if ((next == b || closer) && keeps && space.IsFree(at, next)) {
      path->push_back(next);
      ++counters->moves;
      if (next == b) return SlideStatus::kReached;
      step = std::min(longest, 2.0 * step);
      continue;
    }
    step *= 0.5;
    if (step < longest / 16.0) return SlideStatus::kStopped;
  }
  return SlideStatus::kMoveLimit;
}

}  // namespace phongpd
