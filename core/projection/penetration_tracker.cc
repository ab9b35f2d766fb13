// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/penetration_tracker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/projection/contact_surface.h"
#include "core/projection/near_triangles.h"
#include "core/projection/surface_search.h"
#include "core/projection/surface_walk.h"

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
constexpr double kStepSlack = 1.0 - 1e-12;
// Triangles of a descent: more are rare.
constexpr std::size_t kUsualDescent = 64;

// Where a motion is.  Frame of SurfaceWalk.
struct Position {
  bool inside = false;  // after the last step; only then the rest counts
  Vector3d q = Vector3d::Zero();  // user's frame
  double magnitude = 0.0;         // user's unit
  Vector3d x = Vector3d::Zero();
  double depth = 0.0;
  MeshPoint contact;
  MeshPoint nearest;  // the closest point of all
  NearTriangles near;
  // The last search: where q was, how far it may move until the answer is
  // looked for again, and the way that was found; none: no other place of the
  // piece is better than the end of the descent.
  bool searched = false;
  Vector3d searched_at = Vector3d::Zero();
  double believed = 0.0;
  SurfaceWay way;
  std::size_t on_way = 0;
};

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

struct PenetrationTracker::State::Data {
  std::shared_ptr<const Impl> owner;
  Position position;
  // Memory that steps use again; copies do without.
  SurfaceWay descent;
  SurfaceSearch search;

  Data(std::shared_ptr<const Impl> tracker, Position where)
      : owner(std::move(tracker)), position(std::move(where)) {
    descent.reserve(kUsualDescent);
  }
};

using State = PenetrationTracker::State;

State::State() = default;
State::~State() = default;
State::State(const State& other) {
  if (!other.data_) return;
  data_ = std::make_unique<Data>(other.data_->owner, other.data_->position);
}
State& State::operator=(const State& other) {
  State copy(other);
  data_ = std::move(copy.data_);
  return *this;
}
State::State(State&&) noexcept = default;
State& State::operator=(State&&) noexcept = default;

struct PenetrationTracker::Impl {
  using Data = State::Data;

  Impl(const ContactSpace& space, const PenetrationTrackerOptions& o)
      : surface(space), walk(space), options(o) {}

  // The ball of all depth around an interior point holds no surface.
  Location Locate(const Vector3d& q, const Position& state) const {
    if (state.inside) {
      const double step = (walk.bvh().ToFrame(q) - state.x).norm();
      if (step < 0.999 * state.depth - 1e-12) return Location::kInside;
    }
    return surface.Locate(q);
  }

  // Inside for the first time: the closest point.
  void Enter(const Vector3d& x, Position* state) const {
    const SurfaceFoot nearest = walk.FindClosest(x, {});
    state->contact = nearest.point;
    state->nearest = nearest.point;
    state->depth = std::sqrt(nearest.squared_distance);
    Forget(state);
  }

  static void Forget(Position* state) {
    state->searched = false;
    state->way.clear();
    state->on_way = 0;
  }

  // The way p has to take, from the last search or a new one; empty: none.
  void Choose(const Vector3d& x, const SurfaceFoot& nearest_of_own,
              Data* data) const {
    Position* const state = &data->position;
    double radius = options.ratio * state->depth;
    const double own = std::sqrt(nearest_of_own.squared_distance);
    if (own > radius) radius = options.ratio * own;
    const bool in_ball = (walk.At(state->contact) - x).norm() <= radius;
    const bool on_way = state->on_way < state->way.size();
    if (state->searched && (on_way || in_ball) &&
        (x - state->searched_at).norm() <= state->believed) {
      return;
    }
    Forget(state);
    const SurfaceBall ball{x, radius};
    MeshPoint start = state->contact;
    if (!in_ball && data->search.FindBall(walk, ball, start, &state->way)) {
      start = state->way.back();
    }
    data->search.FindInside(walk, ball, start, nearest_of_own.point,
                            &state->way);
    state->searched = true;
    state->searched_at = x;
    const double length = Length(walk, state->contact, state->way);
    state->believed = std::max(kBelieveWay * own, kBelieveLength * length);
    // The end of the descent may be what the search found.
    const double end = (walk.At(state->way.back()) - x).squaredNorm();
    const double descended = (walk.At(data->descent.back()) - x).squaredNorm();
    if (in_ball && descended <= end * kSame) {
      state->way.clear();
      state->believed = kBelieveNone * own;
    }
  }

  // Moves the contact; true if it is where it wants to be.
  bool Move(const Vector3d& x, Data* data, double* moved) const {
    Position* const state = &data->position;
    const double step = (x - state->x).norm();
    const double budget = kStepSlack * options.speed * step;
    *moved = 0.0;
    SurfaceFoot local = walk.Descend(state->contact, x, &data->descent);
    SurfaceFoot seed = walk.FootOn(state->nearest.triangle, x);
    if (local.squared_distance <= seed.squared_distance) seed = local;
    const SurfaceFoot nearest = state->near.FindClosest(walk, x, seed, step);
    state->nearest = nearest.point;
    state->depth = std::sqrt(nearest.squared_distance);
    const int component = walk.component(state->contact.triangle);
    const SurfaceFoot own = walk.component(nearest.point.triangle) == component
                                ? nearest
                                : walk.FindClosest(x, local, component);
    if (local.squared_distance <= own.squared_distance * kSame) {
      Forget(state);
    } else {
      Choose(x, own, data);
    }
    if (state->on_way < state->way.size()) {
      *moved =
          walk.Advance(state->way, budget, &state->on_way, &state->contact);
      if (state->on_way < state->way.size()) return false;
      Forget(state);
      walk.Descend(state->contact, x, &data->descent);
    }
    std::size_t piece = 0;
    *moved +=
        walk.Advance(data->descent, budget - *moved, &piece, &state->contact);
    return piece == data->descent.size();
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

TrackerResult PenetrationTracker::Step(const Vector3d& q, State* of) const {
  const Impl& impl = *impl_;
  TrackerResult result;
  if (!impl.surface.Accepts(q)) return result;
  if (!of->data_ || of->data_->owner != impl_) {
    of->data_ = std::make_unique<State::Data>(impl_, Position());
  }
  Position* const state = &of->data_->position;
  const Location location = impl.Locate(q, *state);
  if (location != Location::kInside) {
    result.touching = location == Location::kOnSurface;
    result.status = QueryStatus::kOutside;
    if (state->inside && state->magnitude > (impl.options.speed + 1.0) *
                                                (q - state->q).stableNorm()) {
      result.status = QueryStatus::kLeftElsewhere;
    }
    Impl::Forget(state);
    state->inside = false;
    state->q = q;
    state->magnitude = 0.0;
    return result;
  }
  const TriangleBvh& bvh = impl.walk.bvh();
  const Vector3d x = bvh.ToFrame(q);
  result.status = QueryStatus::kFollowing;
  if (!state->inside) {
    impl.Enter(x, state);
  } else {
    double moved = 0.0;
    if (!impl.Move(x, of->data_.get(), &moved)) {
      result.status = QueryStatus::kSliding;
    }
    result.moved = moved / bvh.scale();
  }
  result.inside = true;
  result.triangle = state->contact.triangle;
  result.contact = impl.ContactPoint(state->contact);
  result.pd = result.contact - q;
  result.magnitude = result.pd.stableNorm();
  result.euclidean_depth =
      std::max(state->depth / bvh.scale(), impl.surface.LeastDistance());
  // Overflows where q all but touches C_cont elsewhere; no result is infinite.
  result.ratio = std::min(result.magnitude / result.euclidean_depth,
                          std::numeric_limits<double>::max());
  state->inside = true;
  state->q = q;
  state->x = x;
  state->magnitude = result.magnitude;
  return result;
}

}  // namespace phongpd
