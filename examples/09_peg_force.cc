// SPDX-License-Identifier: GPL-3.0-or-later
// 09_peg_force PEG HOLE [ROWS.csv]: what a hand feels that pushes a peg into
// its hole, tilts it against the rim and takes it back, by each metric: forces
// depth · n, torques about the peg's origin, and the work of the closed motion,
// there and back: energy that the force gives to the hand for nothing.
#include <phongpd/constraints/pose_row.h>
#include <phongpd/constraints/wrench_tracker.h>
#include <phongpd/core/projection/phong_metric.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>

using namespace phongpd;
using Eigen::AngleAxisd, Eigen::Vector3d;

struct Push {
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
};
constexpr std::array<const char*, 4> kNames = {"euclidean", "phong", "smoothed",
                                               "tracked"};

// Closed: t = 0 and 1 are the same pose.
RobotPose Hand(double t) {
  const double pi = std::acos(-1.0), phi = 2.0 * pi * t;
  return {{0.19 + 0.15 * std::cos(phi), 0.74 + 0.1 * std::sin(phi),
           0.03 * std::sin(phi)},
          AngleAxisd(0.2 * std::sin(2.0 * phi), Vector3d::UnitY()) *
              AngleAxisd(0.5 * pi + 0.15 * std::sin(phi), Vector3d::UnitZ())};
}

// Of all metrics at one pose.
struct Pushes {
  Pushes(const Solid& peg, const Solid& hole)
      : row(peg, hole), witness(peg, hole), tracker(peg, hole) {}

  std::array<Push, 4> At(const RobotPose& pose) {
    const ContactSpace space = tracker.SpaceAt(pose.orientation);
    std::array<Push, 4> pushes;
    const PoseRowValue s = row.At(pose);  // exact, with its torque
    const double depth = std::max(0.0, -s.value);
    pushes[0] = {depth * s.by_translation, depth * s.by_rotation};
    const PenetrationResult phong = PhongMetric(space).Query(pose.position);
    if (phong.inside) {  // its lever: where the peg touches when it is out
      const Depth out = witness.At(RobotPose{phong.contact, pose.orientation});
      pushes[1].force = phong.PenetrationVector(pose.position);
      pushes[1].torque = (out.on_robot - phong.contact).cross(pushes[1].force);
    }
    const TrackedWrench smoothed = tracker.SmoothedAt(space, pose);
    const TrackedWrench tracked = tracker.Step(space, pose, &state);
    for (const std::size_t m : {2u, 3u}) {
      const TrackedWrench& w = m == 2 ? smoothed : tracked;
      pushes[m] = {w.push * w.normal, w.push * w.Torque()};
    }
    return pushes;
  }
  PoseRow row;
  DepthQuery witness;
  WrenchTracker tracker;
  WrenchTracker::State state;
};

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const Solid peg = ReadSolid(argv[1]), hole = ReadSolid(argv[2]);
  const int finest = argc > 3 ? 320 : 80;
  std::ofstream rows(argc > 3 ? argv[3] : "");
  rows << "steps,way,t,metric,fx,fy,fz,tx,ty,tz,work,held,change\n";
  for (int steps = 40; steps <= finest; steps *= 2) {
    for (const int way : {1, -1}) {
      Pushes pushes(peg, hole);
      RobotPose before = Hand(0.0);
      std::array<Push, 4> last = pushes.At(before);
      // Work by both ends of a step; of a force held until the next is known;
      // the largest change of force a step.
      std::array<double, 4> work = {}, held = {}, change = {};
      for (int i = 1; i <= steps; ++i) {
        const RobotPose pose = Hand(1.0 * way * i / steps);
        const std::array<Push, 4> now = pushes.At(pose);
        const Vector3d move = pose.position - before.position;
        const AngleAxisd turn(pose.orientation * before.orientation.inverse());
        for (std::size_t m = 0; m < now.size(); ++m) {
          const auto worth = [&](const Push& p) {
            return p.force.dot(move) + p.torque.dot(turn.angle() * turn.axis());
          };
          held[m] += worth(last[m]);
          work[m] += 0.5 * (worth(last[m]) + worth(now[m]));
          change[m] =
              std::max(change[m], (now[m].force - last[m].force).norm());
          if (i < steps && (steps < finest || way < 0)) continue;
          rows << steps << ',' << way << ',' << 1.0 * i / steps << ','
               << kNames[m];
          for (const Vector3d& v : {now[m].force, now[m].torque})
            rows << ',' << v.x() << ',' << v.y() << ',' << v.z();
          rows << ',' << work[m] << ',' << held[m] << ',' << change[m] << '\n';
        }
        last = now;
        before = pose;
      }
      for (std::size_t m = 0; m < last.size(); ++m)
        std::cout << kNames[m] << ", " << steps << " steps "
                  << (way > 0 ? "there" : "back") << ": work " << work[m]
                  << ", held " << held[m] << ", change " << change[m] << '\n';
    }
  }
}
