// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/motion_cases.h"

#include <random>

#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"
#include "results/bench/paper_benchmarks.h"

namespace phongpd::bench {

using Eigen::Vector3d;

std::vector<MotionSpace> MotionSpaces() {
  std::vector<MotionSpace> spaces;
  const auto add = [&](const std::string& name, const TriangleMesh& robot,
                       const TriangleMesh& obstacle) {
    spaces.push_back({name, BuildContactSpace(robot, obstacle)});
  };
  for (const PaperBenchmark& paper : PaperBenchmarks()) {
    add(paper.title, paper.robot, paper.obstacle);
  }
  const Vector3d half = Vector3d::Constant(0.2);
  const TriangleMesh cube = MakeBox(-half, half);
  const TriangleMesh turned = Rotated(cube, GenericRotation());
  const TriangleMesh ball = MakeIcoBall(0.25, 2);
  add("cube + L", cube, MakeL(2.0, 0.5, 0.6));
  add("turned cube + U", turned, MakeU(2.0, 0.3, 0.6));
  add("cube + plate with hole", cube, MakePlateWithHole(3.0, 0.2, 1.0));
  add("ball + plate with round hole", ball,
      MakePlateWithRoundHole(3.0, 0.1, 0.6, 24));
  add("cube + thin plate", cube,
      MakeBox({-1.5, -1.5, -0.02}, {1.5, 1.5, 0.02}));
  add("turned cube + hollow box", turned, MakeVessel(3.0, 2.0, 0.8));
  add("ball + torus", ball, MakeTorus(1.5, 0.4, 48, 20));
  add("ball + knot", ball, MakeKnot(0.5, 0.2, 96, 12));
  add("star + organic body", MakeStar(0.2, 0.4), MakeBlob(1.5, 4, 0.35, 1));
  add("ball + scanned U", ball, MakeScan(MakeU(2.0, 0.3, 0.6), 0.15, 0.002, 3));
  return spaces;
}

namespace {

// Random points of a contact space.
class Points {
 public:
  Points(const ContactSpace& contact, std::uint64_t seed)
      : contact_(contact),
        random_(seed),
        center_(contact.bounds().Center()),
        half_(0.5 * (contact.bounds().max - contact.bounds().min)) {}

  Vector3d Any() { return RandomVector(&unit_, &random_); }
  Vector3d Normal() { return RandomVector(&normal_, &random_); }
  const Vector3d& half() const { return half_; }
  Vector3d Interior() {
    for (;;) {
      const Vector3d q = center_ + half_.cwiseProduct(Any());
      if (contact_.bvh().Locate(q) == Location::kInside) return q;
    }
  }

 private:
  const ContactSpace& contact_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::normal_distribution<double> normal_;
  Vector3d center_, half_;
};

}  // namespace

std::vector<Motion> MakeMotions(const ContactSpace& contact, int count,
                                int frames, std::uint64_t seed) {
  Points points(contact, seed);
  std::vector<Motion> motions;
  for (int i = 0; i < count; ++i) {
    const Vector3d from = points.Interior(), to = points.Interior();
    const Vector3d bend =
        i % 2 == 0 ? Vector3d::Zero()
                   : Vector3d(0.5 * points.half().cwiseProduct(points.Any()));
    Motion motion;
    for (int frame = 0; frame < frames; ++frame) {
      const double t = static_cast<double>(frame) / (frames - 1);
      motion.push_back(from + t * (to - from) + 4.0 * t * (1.0 - t) * bend);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

std::vector<Motion> MakeWalks(const ContactSpace& contact, int count,
                              int frames, std::uint64_t seed) {
  constexpr double kTurn = 0.33;
  const BoundingBox& box = contact.bounds();
  const double step = 0.003 * box.Diagonal();
  Points points(contact, seed);
  std::vector<Motion> motions;
  for (int i = 0; i < count; ++i) {
    Motion motion = {points.Interior()};
    Vector3d heading = points.Normal().normalized();
    while (static_cast<int>(motion.size()) < frames) {
      heading = (heading + kTurn * points.Normal()).normalized();
      for (int axis = 0; axis < 3; ++axis) {
        const double next = motion.back()[axis] + step * heading[axis];
        if (next < box.min[axis] || next > box.max[axis]) {
          heading[axis] = -heading[axis];
        }
      }
      motion.push_back(motion.back() + step * heading);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

BeginFollowing FollowMetric(const PenetrationMetric& metric) {
  return [&metric] {
    return [&metric, branch = Branch()](const Vector3d& q) mutable {
      const PenetrationResult result = metric.Query(q, branch);
      const bool had = branch.IsValid();
      branch = result.branch;
      return MotionStep{
          result.PenetrationVector(q),
          had && !result.inside && result.status == QueryStatus::kBranchEnded,
          false, result.status == QueryStatus::kBranchEnded};
    };
  };
}

BeginFollowing FollowTracker(const PenetrationTracker& tracker) {
  return [&tracker] {
    return [&tracker,
            state = PenetrationTracker::State()](const Vector3d& q) mutable {
      const TrackerResult result = tracker.Step(q, &state);
      return MotionStep{result.pd, result.status == QueryStatus::kLeftElsewhere,
                        result.status == QueryStatus::kSliding, false};
    };
  };
}

std::vector<double> EuclideanDepths(const PenetrationMetric& euclidean,
                                    const Motion& motion) {
  std::vector<double> depths;
  for (const Vector3d& q : motion) {
    const PenetrationResult result = euclidean.Query(q);
    depths.push_back(result.inside ? -result.signed_distance : 0.0);
  }
  return depths;
}

}  // namespace phongpd::bench
