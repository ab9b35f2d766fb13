// SPDX-License-Identifier: GPL-3.0-or-later
// Warm queries.  Truth: much finer steps, the list of all projections, the
// ring search, and continuity itself.
#include "core/projection/branch_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct Scene {
  TriangleMesh mesh;
  double ell;
  PhongMetric metric;
  double diagonal;

  Scene(const TriangleMesh& m, double smoothing)
      : mesh(m),
        ell(smoothing),
        metric(TakeAsContactSpace(m), Options(smoothing)),
        diagonal(ComputeBounds(m).Diagonal()) {}

  static PhongMetricOptions Options(double smoothing) {
    PhongMetricOptions options;
    options.field_options.smoothing_length = smoothing;
    return options;
  }
};

std::vector<Scene> Scenes() {
  std::vector<Scene> scenes;
  for (const double ell : {0.0, 0.1}) {
    scenes.emplace_back(MakeIcoBall(1.0, 3), ell);
    scenes.emplace_back(MakeL(2.0, 0.7, 0.6), ell);
    scenes.emplace_back(MakeWrench(), ell);
    scenes.emplace_back(MakeTorus(1.0, 0.35, 40, 16), ell);
  }
  return scenes;
}

struct Segment {
  Vector3d from;
  Vector3d to;
  Vector3d At(double t) const { return from + t * (to - from); }
};

class RandomMotions {
 public:
  RandomMotions(const Scene& scene, unsigned seed)
      : scene_(scene), engine_(seed) {}

  Vector3d Point() {
    const BoundingBox box = ComputeBounds(scene_.mesh);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (;;) {
      const Vector3d u(uniform(engine_), uniform(engine_), uniform(engine_));
      const Vector3d q = box.min + u.cwiseProduct(box.max - box.min);
      if (scene_.metric.IsInside(q)) return q;
    }
  }
  Segment Next() {
    const Vector3d from = Point();
    return {from, Point()};
  }

 private:
  const Scene& scene_;
  std::mt19937 engine_;
};

struct Frame {
  double t;
  PenetrationResult result;
};

// Results along the motion, the branch carried from frame to frame.
std::vector<Frame> Track(const PhongMetric& metric, const Segment& motion,
                         int frames) {
  std::vector<Frame> track;
  Branch branch;
  for (int i = 0; i <= frames; ++i) {
    const double t = static_cast<double>(i) / frames;
    track.push_back({t, metric.Query(motion.At(t), branch)});
    branch = track.back().result.branch;
  }
  return track;
}

TEST(BranchWalk, LongStepsArriveWhereShortStepsDo) {
  int agreed = 0, differed = 0, ended = 0;
  for (const Scene& scene : Scenes()) {
    RandomMotions motions(scene, 15);
    for (int i = 0; i < 60; ++i) {
      Segment motion = motions.Next();
      motion.to = motion.At(0.2);
      const auto fine = Track(scene.metric, motion, 400);
      const bool unbroken =
          std::all_of(fine.begin(), fine.end(), [](const Frame& f) {
            return f.result.inside && f.result.status == QueryStatus::kOk;
          });
      if (!unbroken) {
        ++ended;
        continue;
      }
      const PenetrationResult once =
          scene.metric.Query(motion.to, fine.front().result.branch);
      const double distance =
          (once.contact - fine.back().result.contact).norm();
      (distance < 1e-9 * scene.diagonal ? agreed : differed) += 1;
    }
  }
  EXPECT_EQ(differed, 0);
  EXPECT_GT(agreed, 200);
  EXPECT_GT(ended, 0);
}

TEST(BranchWalk, EveryWarmResultIsAmongAllProjections) {
  std::vector<PenetrationResult> all;
  for (const Scene& scene : Scenes()) {
    RandomMotions motions(scene, 16);
    for (int i = 0; i < 8; ++i) {
      const Segment motion = motions.Next();
      for (const Frame& frame : Track(scene.metric, motion, 25)) {
        if (!frame.result.inside) continue;
        ASSERT_NE(frame.result.status, QueryStatus::kInvalid);
        scene.metric.QueryAll(motion.At(frame.t), 2.0 * scene.diagonal, &all);
        double nearest = 1e300;
        for (const PenetrationResult& other : all) {
          nearest =
              std::min(nearest, (other.contact - frame.result.contact).norm());
        }
        EXPECT_LT(nearest, 1e-8 * scene.diagonal);
      }
    }
  }
}

// Largest change of the PD vector from frame to frame, farther than `window`
// (in motion parameter) from every frame that is not plain kOk and inside.
double LargestChange(const std::vector<Frame>& track, const Segment& motion,
                     double window) {
  std::vector<double> excluded;
  for (const Frame& f : track) {
    if (!f.result.inside || f.result.status != QueryStatus::kOk) {
      excluded.push_back(f.t);
    }
  }
  double largest = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    const Frame &a = track[i - 1], &b = track[i];
    const bool skip = std::any_of(
        excluded.begin(), excluded.end(),
        [&](double t) { return t > a.t - window && t < b.t + window; });
    if (skip) continue;
    largest = std::max(largest, (a.result.PenetrationVector(motion.At(a.t)) -
                                 b.result.PenetrationVector(motion.At(b.t)))
                                    .norm());
  }
  return largest;
}

TEST(BranchWalk, HalvingTheStepHalvesTheLargestChange) {
  int compared = 0, halved = 0;
  for (const Scene& scene : Scenes()) {
    RandomMotions motions(scene, 17);
    for (int i = 0; i < 12; ++i) {
      const Segment motion = motions.Next();
      const auto coarse = Track(scene.metric, motion, 1000);
      const auto fine = Track(scene.metric, motion, 2000);
      const double a = LargestChange(coarse, motion, 0.03);
      const double b = LargestChange(fine, motion, 0.03);
      if (a == 0.0 || b == 0.0) continue;
      ++compared;
      halved += b < 0.65 * a;
    }
  }
  EXPECT_GT(compared, 60);
  // A branch that comes near a fold without meeting it turns quickly.
  EXPECT_GE(halved, compared * 95 / 100);
}

TEST(BranchWalk, NeverJumpsSilently) {
  int ends = 0;
  for (const Scene& scene : Scenes()) {
    RandomMotions motions(scene, 18);
    for (int i = 0; i < 20; ++i) {
      const Segment motion = motions.Next();
      const auto track = Track(scene.metric, motion, 2000);
      for (std::size_t k = 1; k < track.size(); ++k) {
        const PenetrationResult &a = track[k - 1].result, &b = track[k].result;
        if (!a.inside || !b.inside) continue;
        ends += b.status == QueryStatus::kBranchEnded;
        if (b.status != QueryStatus::kOk) continue;
        EXPECT_LT((a.contact - b.contact).norm(), 0.06 * scene.diagonal);
      }
    }
  }
  EXPECT_GT(ends, 10);
}

// Motions through vertices, along edges and inside planes of symmetry.
TEST(BranchWalk, FollowsAxisAlignedMotionsThroughVerticesAndEdges) {
  for (const double ell : {0.0, 0.1}) {
    const Scene box(MakeBox({-1, -1, -1}, {1, 1, 1}), ell);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const int other = (axis + 1) % 3;
        for (const double third : {0.0, 0.1, 0.03125}) {
          Vector3d from = Vector3d::Constant(third), to = from;
          from[axis] = to[axis] = 0.9 * side;
          from[other] = -0.3;
          to[other] = 0.3;
          for (const int frames : {1, 7, 60, 600}) {
            const auto track = Track(box.metric, {from, to}, frames);
            for (const Frame& frame : track) {
              EXPECT_EQ(frame.result.status, QueryStatus::kOk);
              EXPECT_NEAR(frame.result.contact[axis], side, 1e-12);
            }
            // The start is reached again, also in one step.
            const PenetrationResult back =
                box.metric.Query(from, track.back().result.branch);
            EXPECT_EQ(back.status, QueryStatus::kOk);
            EXPECT_LT((back.contact - track.front().result.contact).norm(),
                      1e-9);
          }
        }
      }
    }
  }
}

TEST(BranchWalk, AgreesWithTheRingSearchInSmallSteps) {
  int compared = 0, agreed = 0;
  for (const Scene& scene : Scenes()) {
    RandomMotions motions(scene, 19);
    for (int i = 0; i < 4; ++i) {
      const Segment motion = motions.Next();
      const auto track = Track(scene.metric, motion, 200);
      for (std::size_t k = 1; k < track.size(); ++k) {
        const PenetrationResult &a = track[k - 1].result, &b = track[k].result;
        if (!a.branch.IsValid() || !b.inside || b.status != QueryStatus::kOk) {
          continue;
        }
        const PenetrationResult ring =
            scene.metric.QueryRing(motion.At(track[k].t), a.branch, 2);
        ++compared;
        agreed += ring.status == QueryStatus::kOk &&
                  (ring.contact - b.contact).norm() < 1e-8 * scene.diagonal;
      }
    }
  }
  EXPECT_GT(compared, 3000);
  EXPECT_GE(agreed, compared * 97 / 100);
}

TEST(BranchWalk, LeavingTheSolidIsAnOutsideAnswerAndReentryIsShallow) {
  const Scene box(MakeBox({-1, -1, -1}, {1, 1, 1}), 0.1);
  const auto out = Track(box.metric, {{0.8, 0.1, 0.2}, {1.2, 0.1, 0.2}}, 64);
  for (const Frame& frame : out) {
    EXPECT_EQ(frame.result.status, QueryStatus::kOk);
    const double x = 0.8 + 0.4 * frame.t;
    EXPECT_EQ(frame.result.inside, x < 1.0);
    EXPECT_NEAR(frame.result.signed_distance, x - 1.0, 0.02);
  }
  const PenetrationResult back =
      box.metric.Query(Vector3d(0.999, 0.1, 0.2), out.back().result.branch);
  EXPECT_NEAR(back.signed_distance, -0.001, 1e-4);
}

TEST(BranchWalk, LeavingElsewhereThanTheBranchLeadsIsSaid) {
  // In at the left of a thick plate, out at the right: the branch keeps
  // pointing left, and its depth of 2 drops to 0 in one frame.
  const PhongMetric plate = testing::UnsmoothedPhong(
      TakeAsContactSpace(MakeBox({-1, -50, -50}, {1, 50, 50})));
  const auto across = Track(plate, {{-1.5, 0.3, 0.2}, {1.5, 0.3, 0.2}}, 61);
  int ends = 0;
  double last_depth = 0.0;
  for (const Frame& frame : across) {
    if (frame.result.status == QueryStatus::kBranchEnded) {
      ++ends;
      EXPECT_FALSE(frame.result.inside);
      EXPECT_NEAR(last_depth, 2.0, 0.1);
    }
    if (frame.result.inside) last_depth = -frame.result.signed_distance;
  }
  EXPECT_EQ(ends, 1);
}

TEST(BranchWalk, GradientPredictsTheNextDepth) {
  for (const Scene& scene : Scenes()) {
    RandomMotions motions(scene, 20);
    int checked = 0;
    const double step = 1e-7 * scene.diagonal;
    for (int i = 0; i < 200; ++i) {
      const Vector3d q = motions.Point();
      const PenetrationResult at = scene.metric.Query(q);
      if (at.status != QueryStatus::kOk || at.gradient.norm() > 3.0 ||
          at.branch.lambda.minCoeff() < 1e-3) {
        continue;  // one-sided on edges, large near folds
      }
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d d = step * Vector3d::Unit(axis);
        const PenetrationResult plus = scene.metric.Query(q + d, at.branch);
        const PenetrationResult minus = scene.metric.Query(q - d, at.branch);
        if (plus.branch.triangle != at.branch.triangle ||
            minus.branch.triangle != at.branch.triangle) {
          continue;
        }
        ++checked;
        EXPECT_NEAR(
            (plus.signed_distance - minus.signed_distance) / (2.0 * step),
            at.gradient[axis], 1e-6);
      }
    }
    EXPECT_GT(checked, 200);
  }
}

// On an edge of the field mesh the gradient belongs to the result's triangle:
// it predicts moves whose contact stays on that side.
TEST(BranchWalk, GradientIsOneSidedOnEdges) {
  int checked = 0;
  for (const Scene& scene : Scenes()) {
    const PhongField& field = scene.metric.field();
    const double step = 1e-7 * scene.diagonal;
    for (std::size_t t = 0; t < field.mesh.triangles.size(); t += 7) {
      const Triangle& v = field.mesh.triangles[t];
      const Vector3d p =
          0.4 * field.mesh.vertices[v[0]] + 0.6 * field.mesh.vertices[v[1]];
      const Vector3d n = 0.4 * field.normals[v[0]] + 0.6 * field.normals[v[1]];
      const Vector3d inward =
          (field.mesh.vertices[v[2]] - field.mesh.vertices[v[0]]).normalized();
      const Vector3d q = field.FromField(p - 0.01 * n);
      if (!scene.metric.IsInside(q)) continue;
      Branch branch;
      branch.triangle = static_cast<int>(t);
      branch.lambda = Vector3d(0.4, 0.6, 0.0);
      branch.s = -0.01 / field.scale;
      // On the edge, beside it by rounding, and off it.
      for (const double offset : {0.0, 1e-12, -1e-12, 1e-3}) {
        const Vector3d start = q + offset * scene.diagonal * inward;
        const PenetrationResult at = scene.metric.Query(start, branch);
        const Vector3d end = start + step * inward;
        const PenetrationResult next = scene.metric.Query(end, at.branch);
        if (at.status != QueryStatus::kOk || !next.inside ||
            next.status != QueryStatus::kOk || at.gradient.norm() > 3.0 ||
            next.branch.triangle != at.branch.triangle) {
          continue;
        }
        ++checked;
        EXPECT_NEAR((next.signed_distance - at.signed_distance) / step,
                    at.gradient.dot(inward), 2e-5);
      }
    }
  }
  EXPECT_GT(checked, 1000);
}

}  // namespace
}  // namespace phongpd
