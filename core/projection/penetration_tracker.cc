// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/penetration_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/projection/contact_surface.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// How far q may move before a search's answer is looked for again: where no
// other place was reachable, in depths; on a way, in depths or lengths of it.
constexpr double kBelieveNone = 0.03;
constexpr double kBelieveWay = 0.1;
constexpr double kBelieveLength = 0.03;
// Squared distances that agree to this are of one place, or as good.
constexpr double kSame = 1.0 + 1e-12;
// Of a step, so that rounding does not exceed its bound.
constexpr double kSlack = 1.0 - 1e-12;

double Length(const SurfaceWalk& walk, const MeshPoint& start,
              const SurfaceWay& way) {
  double length = 0.0;
  Vector3d at = walk.At(start);
  for (const MeshPoint& p : way) {
    const Vector3d next = walk.At(p);
    length += (next - at).norm();
    at = next;
  }
  return length;
}

}  // namespace

void PenetrationTrackerOptions::Validate() const {
  if (!(ratio >= 1.0 && std::isfinite(ratio))) {
    throw InputError("slide ratio: expected finite and >= 1, found " +
                     std::to_string(ratio));
  }
  if (!(speed > 0.0 && speed <= 1e6)) {
    throw InputError("slide speed: expected > 0 and at most 1e6, found " +
                     std::to_string(speed));
  }
}

const char* Name(TrackerStatus status) {
  switch (status) {
    case TrackerStatus::kFollowing:
      return "following";
    case TrackerStatus::kSliding:
      return "sliding";
    case TrackerStatus::kLeftElsewhere:
      return "left_elsewhere";
    case TrackerStatus::kOutside:
      return "outside";
    case TrackerStatus::kInvalid:
      break;
  }
  return "invalid";
}

struct PenetrationTracker::Impl {
  Impl(const ContactSpace& space, const PenetrationTrackerOptions& o)
      : surface(space), walk(space), options(o) {}

  // The ball of all depth around an interior point holds no surface.
  bool IsInside(const Vector3d& q, const State& state) const {
    if (state.inside_) {
      const double step = (walk.bvh().ToFrame(q) - state.x_).norm();
      if (step < 0.999 * state.depth_ - 1e-12) return true;
    }
    return surface.Locate(q) == Location::kInside;
  }

  // Inside for the first time: the closest point.
  void Enter(const Vector3d& x, State* state) const {
    const SurfaceFoot nearest = walk.FindClosest(x, {});
    state->contact_ = nearest.point;
    state->nearest_ = nearest.point;
    state->depth_ = std::sqrt(nearest.squared_distance);
    Forget(state);
  }

  static void Forget(State* state) {
    state->searched_ = false;
    state->way_.clear();
    state->on_way_ = 0;
  }

  // The way p has to take, from the last search or a new one; empty: none.
  void Choose(const Vector3d& x, const SurfaceFoot& nearest_of_own,
              State* state) const {
    double radius = options.ratio * state->depth_;
    const double own = std::sqrt(nearest_of_own.squared_distance);
    if (own > radius) radius = options.ratio * own;
    const bool in_ball = (walk.At(state->contact_) - x).norm() <= radius;
    const bool on_way = state->on_way_ < state->way_.size();
    if (state->searched_ && (on_way || in_ball) &&
        (x - state->searched_at_).norm() <= state->believed_) {
      return;
    }
    Forget(state);
    const SurfaceBall ball{x, radius};
    MeshPoint start = state->contact_;
    if (!in_ball && state->search_.FindBall(walk, ball, start, &state->way_)) {
      start = state->way_.back();
    }
    state->search_.FindInside(walk, ball, start, nearest_of_own.point,
                              &state->way_);
    state->searched_ = true;
    state->searched_at_ = x;
    const double length = Length(walk, state->contact_, state->way_);
    state->believed_ = std::max(kBelieveWay * own, kBelieveLength * length);
    // The end of the descent may be what the search found.
    const double end = (walk.At(state->way_.back()) - x).squaredNorm();
    const double descended =
        (walk.At(state->descent_.back()) - x).squaredNorm();
    if (in_ball && descended <= end * kSame) {
      state->way_.clear();
      state->believed_ = kBelieveNone * own;
    }
  }

  // Moves the contact; true if it is where it wants to be.
  bool Move(const Vector3d& x, State* state, double* moved) const {
    const double step = (x - state->x_).norm();
    const double budget = kSlack * options.speed * step;
    *moved = 0.0;
    SurfaceFoot local = walk.Descend(state->contact_, x, &state->descent_);
    SurfaceFoot seed = walk.FootOn(state->nearest_.triangle, x);
    if (local.squared_distance <= seed.squared_distance) seed = local;
    const SurfaceFoot nearest = state->near_.FindClosest(walk, x, seed, step);
    state->nearest_ = nearest.point;
    state->depth_ = std::sqrt(nearest.squared_distance);
    const int component = walk.component(state->contact_.triangle);
    const SurfaceFoot own = walk.component(nearest.point.triangle) == component
                                ? nearest
                                : walk.FindClosest(x, local, component);
    if (local.squared_distance <= own.squared_distance * kSame) {
      Forget(state);
    } else {
      Choose(x, own, state);
    }
    if (state->on_way_ < state->way_.size()) {
      *moved =
          walk.Advance(state->way_, budget, &state->on_way_, &state->contact_);
      if (state->on_way_ < state->way_.size()) return false;
      Forget(state);
      walk.Descend(state->contact_, x, &state->descent_);
    }
    std::size_t piece = 0;
    *moved += walk.Advance(state->descent_, budget - *moved, &piece,
                           &state->contact_);
    return piece == state->descent_.size();
  }

  Vector3d ContactPoint(const MeshPoint& p) const {
    return surface.Point(p.triangle, p.lambda);
  }

  ContactSurface surface;
  SurfaceWalk walk;
  PenetrationTrackerOptions options;
};

PenetrationTracker::PenetrationTracker(const ContactSpace& space,
                                       const PenetrationTrackerOptions& options)
    : impl_((options.Validate(), std::make_shared<Impl>(space, options))) {}

const PenetrationTrackerOptions& PenetrationTracker::options() const {
  return impl_->options;
}

TrackerResult PenetrationTracker::Step(const Vector3d& q, State* state) const {
  const Impl& impl = *impl_;
  TrackerResult result;
  if (!impl.surface.Accepts(q)) return result;
  if (state->owner_ != impl_) {
    *state = State();
    state->owner_ = impl_;
  }
  if (!impl.IsInside(q, *state)) {
    const double bound =
        (impl.options.speed + 1.0) * (q - state->q_).stableNorm();
    result.status = state->inside_ && state->magnitude_ > bound
                        ? TrackerStatus::kLeftElsewhere
                        : TrackerStatus::kOutside;
    Impl::Forget(state);
    state->inside_ = false;
    state->q_ = q;
    state->magnitude_ = 0.0;
    return result;
  }
  const TriangleBvh& bvh = impl.walk.bvh();
  const Vector3d x = bvh.ToFrame(q);
  result.status = TrackerStatus::kFollowing;
  if (!state->inside_) {
    impl.Enter(x, state);
  } else {
    double moved = 0.0;
    if (!impl.Move(x, state, &moved)) {
      result.status = TrackerStatus::kSliding;
    }
    result.moved = moved / bvh.scale();
  }
  result.inside = true;
  result.triangle = state->contact_.triangle;
  result.contact = impl.ContactPoint(state->contact_);
  result.pd = result.contact - q;
  result.magnitude = result.pd.stableNorm();
  result.euclidean_depth =
      std::max(state->depth_ / bvh.scale(), impl.surface.LeastDistance());
  // Overflows where q all but touches C_cont elsewhere; no result is infinite.
  result.ratio = std::min(result.magnitude / result.euclidean_depth,
                          std::numeric_limits<double>::max());
  state->inside_ = true;
  state->q_ = q;
  state->x_ = x;
  state->magnitude_ = result.magnitude;
  return result;
}

}  // namespace phongpd
