// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/rigid_motions.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"

namespace phongpd::bench {
namespace {

constexpr int kTries = 10'000;
constexpr int kPoseTries = 10'000;  // where little is free
constexpr double kBeforeContact = 1e-4;
constexpr double kGrazingTo = 1e-6;

class Motions {
 public:
  Motions(const RigidScene& scene, const RigidJudge& judge, unsigned seed)
      : scene_(scene), judge_(judge), random_(seed) {
    for (const auto& v : scene.robot.vertices) {
      reach_ = std::max(reach_, v.norm());
    }
  }

  // An empty one if this try found none.
  std::vector<RigidMotionEnds> Try(RigidMotionKind kind) {
    const RobotPose a = FreePose();
    if (kind == RigidMotionKind::kRandom) return {{a, FreePose()}};
    if (kind == RigidMotionKind::kContact) return Contact(a);
    return Grazing(a);
  }

 private:
  RobotPose RandomPose() {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> normal;
    RobotPose pose;
    for (int k = 0; k < 3; ++k) {
      const double share = unit(random_);
      pose.position[k] = scene_.bounds.min[k] +
                         share * (scene_.bounds.max[k] - scene_.bounds.min[k]);
    }
    for (int k = 0; k < 4; ++k) pose.orientation.coeffs()[k] = normal(random_);
    pose.orientation.normalize();
    return pose;
  }

  RobotPose FreePose() {
    for (int i = 0; i < kPoseTries; ++i) {
      const RobotPose pose = RandomPose();
      if (IsFree(pose, pose)) return pose;
    }
    throw InputError(scene_.name + ": expected room for the robot, found none");
  }

  // From `from` towards a random pose, of two robot's sizes at most.
  RobotPose Near(const RobotPose& from) {
    const RigidMotion way(from, RandomPose());
    const double size =
        (way.end().position - from.position).norm() + reach_ * way.angle();
    return way.At(std::min(1.0, 2.0 * reach_ / size));
  }

  bool IsFree(const RobotPose& a, const RobotPose& b) const {
    return judge_.Check(RigidMotion(a, b)).IsFree();
  }

  // The share of the way that is proved free, to `to` of the way.
  double FreeShare(const RobotPose& a, const RobotPose& b, double to) const {
    const RigidMotion way(a, b);
    double low = 0.0, high = 1.0;
    while (high - low > to) {
      const double middle = 0.5 * (low + high);
      (IsFree(a, way.At(middle)) ? low : high) = middle;
    }
    return low;
  }

  std::vector<RigidMotionEnds> Contact(const RobotPose& a) {
    const RobotPose b = RandomPose();
    if (IsFree(a, b)) return {};
    const double first = FreeShare(a, b, kBeforeContact);
    if (first < 0.01) return {};
    const RobotPose start = RigidMotion(a, b).At(first);
    const RobotPose back = RigidMotion(a, b).At(0.9 * first);
    const RobotPose c = Near(back);
    if (IsFree(back, c)) return {};
    const double second = FreeShare(back, c, kBeforeContact);
    if (second < 0.01) return {};
    return {{start, RigidMotion(back, c).At(second)}};
  }

  std::vector<RigidMotionEnds> Grazing(const RobotPose& a) {
    const RobotPose b = FreePose(), c = FreePose();
    if (!IsFree(a, b) || IsFree(a, c)) return {};
    // Between a motion that is free and one that is not.
    const RigidMotion ends(b, c);
    double low = 0.0, high = 1.0;
    while (high - low > kGrazingTo) {
      const double middle = 0.5 * (low + high);
      (IsFree(a, ends.At(middle)) ? low : high) = middle;
    }
    const RobotPose beyond = ends.At(high);
    if (!IsFree(beyond, beyond)) return {};
    return {{a, ends.At(low)}, {a, beyond}};
  }

  const RigidScene& scene_;
  const RigidJudge& judge_;
  std::mt19937_64 random_;
  double reach_ = 0.0;
};

}  // namespace

const char* ToString(RigidMotionKind kind) {
  switch (kind) {
    case RigidMotionKind::kRandom:
      return "random";
    case RigidMotionKind::kContact:
      return "contact";
    case RigidMotionKind::kGrazing:
      return "grazing";
  }
  return "";
}

std::vector<RigidMotionEnds> MakeRigidMotions(const RigidScene& scene,
                                              const RigidJudge& judge,
                                              RigidMotionKind kind, int count,
                                              unsigned seed) {
  Motions motions(scene, judge, seed);
  std::vector<RigidMotionEnds> found;
  for (int i = 0; i < kTries && static_cast<int>(found.size()) < count; ++i) {
    for (const RigidMotionEnds& one : motions.Try(kind)) found.push_back(one);
  }
  return found;
}

int OmplParts(const RigidScene& scene, const RigidMotionEnds& ends,
              double resolution) {
  const double way = (ends.end.position - ends.start.position).norm() /
                     scene.bounds.Diagonal();
  const double cosine =
      std::min(1.0, std::abs(ends.start.orientation.dot(ends.end.orientation)));
  const double turn = std::acos(cosine) / (0.5 * kPi);
  return std::max(
      1, static_cast<int>(std::ceil(std::max(way, turn) / resolution)));
}

}  // namespace phongpd::bench
