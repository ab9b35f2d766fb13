// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/motion_view.h"

#include <algorithm>

#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// A motion is played by so many steps, equal in time.
constexpr int kMoments = 600;

// Of a limit of each axis, or of the norm.
double ShareOf(const Vector3d& asked, const Vector3d& limit, bool by_norm) {
  return by_norm ? asked.norm() / limit.x()
                 : asked.cwiseAbs().cwiseQuotient(limit).maxCoeff();
}

// The motion of an answer from 0 on for `seconds`, at rest after its end.
void Play(const OptimizeRequest& request, const PathAnswer& answer,
          const std::vector<MovingBody>& bodies, double seconds,
          NamedPath* path) {
  const MotionLimits& limits = *request.limits;
  const Vector3d none = Vector3d::Zero();
  path->points.clear();
  ViewPace& pace = path->pace;
  pace.duration = seconds;
  for (int i = 0; i <= kMoments; ++i) {
    const double t = seconds * i / kMoments;
    const Trajectory::Sample sample = answer.motion.At(t);
    const bool rests = t > answer.motion.duration();
    const auto share = [&](const Vector3d& asked, const Vector3d& limit) {
      return ShareOf(rests ? none : asked, limit, limits.by_norm);
    };
    path->points.push_back(sample.position);
    pace.velocity.push_back(share(sample.velocity, limits.velocity));
    pace.acceleration.push_back(
        share(sample.acceleration, limits.acceleration));
    pace.jerk.push_back(share(sample.jerk, limits.jerk));
    double room = answer.evidence.free_space->Clearance(sample.position);
    for (const MovingBody& body : bodies) {
      room = std::min(room, body.space->Clearance(sample.position -
                                                  body.motion.At(t).position));
    }
    pace.clearance.push_back(room);
  }
}

std::string Spoken(PathStatus status) {
  std::string text = ToString(status);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

NamedPath PathInTime(const World& world, const OptimizeRequest& request,
                     const PathAnswer& answer) {
  NamedPath path = {"motion · " + Spoken(answer.status), answer.path,
                    answer.is_free};
  if (answer.motion.empty()) return path;
  Play(request, answer, MovingBodies(world, request.moving),
       answer.motion.duration(), &path);
  return path;
}

std::vector<ViewMover> MoversOf(const std::vector<MovingObstacle>& moving,
                                double seconds) {
  if (!(seconds > 0.0)) {
    for (const MovingObstacle& one : moving) {
      seconds = std::max(seconds, one.motion.duration());
    }
  }
  std::vector<ViewMover> movers;
  for (const MovingObstacle& one : moving) {
    ViewMover mover = {one.solid.name(), one.solid.mesh(), {}};
    for (int i = 0; i <= kMoments; ++i) {
      mover.points.push_back(one.motion.At(seconds * i / kMoments).position);
    }
    movers.push_back(std::move(mover));
  }
  return movers;
}

void AddFleet(const std::vector<FleetRobot>& robots, const FleetAnswer& answer,
              View* view) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const FleetRobot& robot = robots[i];
    const PathAnswer& own = answer.robots[i];
    NamedPath& path = view->paths[i];
    path.is_free = own.is_free;
    if (!answer.IsSolved()) {
      if (!own.path.empty()) path.points = own.path;
      continue;
    }
    std::vector<MovingObstacle> others = robot.request.moving;
    for (std::size_t k = 0; k < robots.size(); ++k) {
      if (k == i) continue;
      others.push_back({robots[k].world.workspace().robot.Named(robots[k].name),
                        answer.robots[k].motion});
    }
    Play(robot.request, own, MovingBodies(robot.world, others),
         std::max(answer.duration, own.motion.duration()), &path);
  }
  if (!robots.empty()) {
    view->movers = MoversOf(robots.front().request.moving, answer.duration);
  }
  if (const FleetPair* closest = answer.Closest()) {
    view->notes.push_back("Closest to each other: " +
                          ClosestText(*closest, view->unit));
  }
}

std::string ClosestText(const FleetPair& pair, const std::string& unit) {
  return pair.first + " and " + pair.second + ", " + Rounded(pair.least, 3) +
         " " + unit + " at t = " + Rounded(pair.time, 4) + " s";
}

}  // namespace phongpd
