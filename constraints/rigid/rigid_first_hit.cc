// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "constraints/rigid/rigid_search.h"
#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

// A part that begins later than what is open already is of use as a hit alone,
// which need be no finer than this share of how much later it is.
constexpr double kFineShare = 1.0 / 16.0;
// Beyond what is open already, a hit is looked for as long.
constexpr long kFurtherFirstHitTests = 100'000;

// The earliest collision of all that was seen, and the earliest part that was
// not told apart: all of [0, open_from) is proved free.
class FirstHitSearch {
 public:
  FirstHitSearch(const RigidSides& sides, const FramedMotion& motion,
                 long max_tests)
      : sides_(sides),
        descent_(sides.robot.tree, sides.obstacle.tree, motion),
        max_tests_(max_tests) {}

  // The whole way, down to motions of `resolution`.
  void SearchAll(double resolution) {
    descent_.Push({});
    Search(0.0, resolution, 0.0);
  }

  // Again, what lies between the earliest part that is open and the hit, down
  // to parts of `width` of the way; what was known stays known.
  void SearchAgain(double resolution, double width) {
    const double from = open_from_;
    int level = 0;
    while (level < RigidDescent::kMaxHalvings &&
           std::ldexp(1.0, -level - 1) >= hit_time_ - from) {
      ++level;
    }
    RigidPart part;
    part.level = level;
    part.half_width = std::ldexp(0.5, -level);
    part.k = static_cast<long>(std::floor(std::ldexp(from, level)));
    // Two such parts cover it.
    for (long k = part.k + 1; k >= part.k; --k) {
      if (k >= 1L << level) continue;
      RigidPart one = part;
      one.k = k;
      descent_.Push(one);
    }
    open_from_ = 1.0;
    Search(from, resolution, width);
    open_from_ = std::max(from, std::min(open_from_, hit_time_));
  }

  bool has_hit() const { return hit_time_ <= 1.0; }
  bool has_open() const { return has_open_; }
  double hit_time() const { return hit_time_; }
  double open_from() const { return std::min(open_from_, hit_time_); }
  RigidFirstHit& answer() { return answer_; }
  void AllowTests(long max_tests) { max_tests_ = max_tests; }

 private:
  void Search(double from, double resolution, double width) {
    while (!descent_.IsDone()) {
      RigidPart part = descent_.Pop();
      // Nothing that is later matters any more, nor what is proved.
      if (part.From() >= hit_time_ || part.To() <= from) continue;
      if (answer_.tests >= max_tests_) {
        Leave(part);
        continue;
      }
      ++answer_.tests;
      const double finest =
          std::max(width, kFineShare * (part.From() - open_from_));
      const bool may_halve = 2.0 * part.half_width > finest &&
                             part.level < RigidDescent::kMaxHalvings;
      const double coarse = may_halve ? resolution : kInfinity;
      double bound = 0.0;
      const PairSight sight = descent_.Look(&part, 0.0, coarse, &bound);
      if (sight == PairSight::kApart) continue;
      if (sight == PairSight::kMeet && part.Middle() < hit_time_) {
        hit_time_ = part.Middle();
        Name(part);
      }
      if (!(bound > coarse)) {
        Leave(part);
        Allow(part);
      } else if (sight == PairSight::kMeet) {
        descent_.PushFirstHalf(part);
      } else {
        descent_.Halve(part);
      }
    }
  }

  // Not told apart.
  void Leave(const RigidPart& part) {
    open_from_ = std::min(open_from_, part.From());
    if (has_hit()) return;
    answer_.to = has_open_ ? std::max(answer_.to, part.To()) : part.To();
    if (!has_open_ && answer_.tests < max_tests_) Name(part);
    has_open_ = true;
  }

  // The first of them ends the search before long, unless it is at the hit.
  void Allow(const RigidPart& part) {
    if (part.To() >= hit_time_ || is_limited_) return;
    is_limited_ = true;
    max_tests_ =
        std::min(max_tests_, 2 * answer_.tests + kFurtherFirstHitTests);
  }

  void Name(const RigidPart& part) {
    NameTriangles(sides_, descent_.RobotTriangle(part),
                  descent_.ObstacleTriangle(part), &answer_);
  }

  const RigidSides& sides_;
  RigidDescent descent_;
  long max_tests_;
  double hit_time_ = 2.0;   // none yet
  double open_from_ = 2.0;  // nothing is open
  bool has_open_ = false, is_limited_ = false;
  RigidFirstHit answer_;
};

}  // namespace

RigidFirstHit SearchFirstHit(const RigidSides& sides,
                             const FramedMotion& motion, double resolution,
                             long max_tests) {
  FirstHitSearch search(sides, motion, max_tests);
  search.SearchAll(ResolutionOf(sides, motion));
  RigidFirstHit& answer = search.answer();
  if (search.has_hit() && search.hit_time() - search.open_from() > resolution) {
    search.AllowTests(
        std::min(max_tests, 2 * answer.tests + kFurtherRigidTests));
    search.SearchAgain(kRigidSlacks * motion.slack(), 0.25 * resolution);
  }
  answer.outcome = MotionVerdict::kFree;
  answer.from = 0.0;
  if (search.has_hit()) {
    answer.outcome = MotionVerdict::kCollides;
    answer.from = search.open_from();
    answer.to = search.hit_time();
  } else if (search.has_open()) {
    answer.outcome = MotionVerdict::kUndecided;
    answer.from = search.open_from();
  } else {
    answer.to = 1.0;
  }
  // Who is inside at the start has met already.
  const bool is_apart_at_start =
      answer.outcome == MotionVerdict::kFree || answer.from > 0.0;
  if (is_apart_at_start && IsInsideAtStart(sides, motion)) {
    const long tests = answer.tests;
    answer = RigidFirstHit();
    answer.outcome = MotionVerdict::kCollides;
    answer.to = 0.0;
    answer.tests = tests;
  }
  return answer;
}

}  // namespace phongpd::internal
