// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/wrench_tracker.h"

#include <algorithm>
#include <cmath>

#include "constraints/gap_lever.h"
#include "constraints/gyration.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/smoothed_metric.h"
#include "core/projection/smoothed_normal.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr double kReach = 1.0 / 8;         // of the robot's diagonal
constexpr double kLeastRadius = 1.0 / 20;  // ρ, of L
constexpr double kRatio = 1.5;             // of the ways out that n keeps to
constexpr double kDamping = 0.5;           // of what is wanted, a step

double Angle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

DepthStatus StatusOf(const PenetrationResult& result, const RobotPose& pose) {
  if (result.status == QueryStatus::kInvalid ||
      !pose.orientation.coeffs().allFinite()) {
    return DepthStatus::kInvalid;
  }
  if (result.inside) return DepthStatus::kPenetrating;
  return result.signed_distance > 0.0 ? DepthStatus::kSeparate
                                      : DepthStatus::kTouching;
}

// a turned towards b by `angle` ≤ ∠(a, b); opposite ones by some way round.
Vector3d TurnedTowards(const Vector3d& a, const Vector3d& b, double angle) {
  Vector3d across = b - a.dot(b) * a;
  if (across.norm() <= 1e-12) across = a.unitOrthogonal();
  return (std::cos(angle) * a + std::sin(angle) * across.normalized())
      .normalized();
}

}  // namespace

struct WrenchTracker::Impl {
  Impl(const Solid& the_robot, const Solid& the_obstacle, double the_speed)
      : robot(the_robot),
        obstacle(the_obstacle),
        speed(the_speed),
        gyration(internal::RadiusOfGyration({robot.mesh()})),
        levers(robot.mesh(), obstacle.mesh(),
               kReach * ComputeBounds(robot.mesh()).Diagonal()) {}

  // The way out along n from q strictly inside: to the first point of C_cont.
  double Exit(const ContactSpace& space, const Vector3d& q,
              const Vector3d& n) const {
    const double far = 2.0 * space.bounds().Diagonal();
    return far * space.bvh().FirstHit(q, q + far * n).fraction;
  }
  // Where n wants to go.
  Vector3d Wish(const ContactSpace& space, const Vector3d& q,
                const PenetrationResult& euclid, const Vector3d& n) const {
    const double exit = Exit(space, q, n);
    if (exit > kRatio * -euclid.signed_distance) return euclid.direction;
    const SmoothedNormals normals(
        space, std::max(0.5 * exit, kLeastRadius * gyration));
    const SmoothedNormal found = normals.At(q + exit * n);
    return found.HasDirection() ? found.Direction() : n;
  }

  Solid robot, obstacle;
  double speed;
  double gyration;
  GapLever levers;
};

WrenchTracker::WrenchTracker(const Solid& robot, const Solid& obstacle,
                             double speed) {
  if (!(speed > 0.0) || !std::isfinite(speed)) {
    throw InputError("WrenchTracker: expected a finite speed above 0, found " +
                     FormatDouble(speed));
  }
  RequireNotEmpty(robot, "robot");
  RequireNotEmpty(obstacle, "obstacle");
  impl_ = std::make_shared<const Impl>(robot, obstacle, speed);
}

TrackedWrench WrenchTracker::SmoothedAt(const ContactSpace& space,
                                        const RobotPose& pose) const {
  TrackedWrench answer;
  const SmoothedMetric metric(space);
  const PenetrationResult result = metric.Query(pose.position);
  answer.status = StatusOf(result, pose);
  if (answer.status != DepthStatus::kPenetrating) return answer;
  answer.is_fallback = result.status == QueryStatus::kEuclideanFallback;
  answer.normal = result.direction;
  answer.exit = impl_->Exit(space, pose.position, answer.normal);
  answer.push = answer.euclidean_depth = -result.signed_distance;
  Vector3d lever = Vector3d::Zero();
  impl_->levers.At(pose, &lever);
  answer.lever = pose.orientation * lever;
  return answer;
}

double WrenchTracker::gyration() const { return impl_->gyration; }

double WrenchTracker::StepLength(const RobotPose& a, const RobotPose& b) const {
  return std::hypot(
      (b.position - a.position).norm(),
      impl_->gyration * a.orientation.angularDistance(b.orientation));
}

ContactSpace WrenchTracker::SpaceAt(
    const Eigen::Quaterniond& orientation) const {
  RobotPose pose;
  pose.orientation = orientation;
  CheckPose(pose, "WrenchTracker");
  const Solid& robot = impl_->robot;
  return BuildContactSpace(
      MakeSolid(Rotated(robot.mesh(), orientation.toRotationMatrix()),
                robot.name()),
      impl_->obstacle);
}

TrackedWrench WrenchTracker::Step(const RobotPose& pose, State* state) const {
  return Step(SpaceAt(pose.orientation), pose, state);
}

TrackedWrench WrenchTracker::Step(const ContactSpace& space,
                                  const RobotPose& pose, State* state) const {
  const Impl& impl = *impl_;
  TrackedWrench answer;
  const EuclideanMetric metric(space);
  const PenetrationResult euclid = metric.Query(pose.position);
  answer.status = StatusOf(euclid, pose);
  if (answer.status == DepthStatus::kInvalid) return answer;
  if (answer.status != DepthStatus::kPenetrating) {
    *state = State();
    return answer;
  }
  Vector3d n = euclid.direction, lever = Vector3d::Zero();
  double reach = 0.0;  // how far r may move
  if (state->has_begun) {
    reach = impl.speed * StepLength(state->pose, pose);
    lever = state->lever;
    const Vector3d wish =
        impl.Wish(space, pose.position, euclid, state->normal);
    answer.wanted = Angle(state->normal, wish);
    answer.turned = std::min(kDamping * answer.wanted, reach / impl.gyration);
    n = TurnedTowards(state->normal, wish, answer.turned);
  }
  answer.normal = n;
  answer.exit = impl.Exit(space, pose.position, n);
  answer.euclidean_depth = -euclid.signed_distance;

  RobotPose out = pose;
  out.position += answer.exit * n;
  Vector3d mean = lever;
  impl.levers.At(out, &mean);
  const Vector3d way = mean - lever;
  const double length = way.norm();
  if (!state->has_begun || length == 0.0) {
    lever = mean;
  } else {
    lever += std::min(kDamping, reach / length) * way;
  }
  answer.lever = pose.orientation * lever;
  const double lag = answer.exit - state->push;
  answer.push = state->has_begun
                    ? state->push + std::clamp(kDamping * lag, -reach, reach)
                    : answer.exit;
  *state = {true, pose, n, lever, answer.push};
  return answer;
}

}  // namespace phongpd
