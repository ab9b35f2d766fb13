// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: collision of the original solids, by FCL and by exact predicates.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "constraints/motion_oracle.h"
#include "constraints/oracle/collision_oracle.h"
#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/solid/solid.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/metrics.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::RandomPoint;

constexpr std::uint64_t kSeed = 20261;

struct Solids {
  std::string name;
  std::function<TriangleMesh()> robot, obstacle;
};

// The first ones are cheap: the short form takes no others.
std::vector<Solids> AllSolids(int* brief) {
  const auto pair = [](PairKind kind, std::uint64_t seed, bool robot) {
    const SolidPair made = MakeRandomPair(kind, seed);
    return robot ? made.robot : made.obstacle;
  };
  const auto star = [] {
    return Rotated(MakeStar(0.15, 0.3), GenericRotation());
  };
  const auto box = [] {
    return MakeBox(Vector3d(-0.1, -0.15, -0.2), Vector3d(0.2, 0.15, 0.1));
  };
  const auto cone = [] { return MakeCone(0.2, 0.4, 7); };
  const auto ball = [] { return MakeIcoBall(0.25, 1); };
  std::vector<Solids> all = {
      {"L", box, [] { return MakeL(2.0, 0.4, 0.6); }},
      {"acute notch", box,  // a free wedge of 31° between two convex bodies
       [] {
         return Joined(Rotated(MakeBox(Vector3d(0, 0, 0), Vector3d(2, 0.5, 1)),
                               Eigen::AngleAxisd(-0.27, Vector3d::UnitZ())
                                   .toRotationMatrix()),
                       Rotated(MakeBox(Vector3d(0, -0.5, 0), Vector3d(2, 0, 1)),
                               Eigen::AngleAxisd(0.27, Vector3d::UnitZ())
                                   .toRotationMatrix()));
       }},
      {"U", cone, [] { return MakeU(2.0, 0.4, 0.7); }},
      {"plate with hole", ball,
       [] { return MakePlateWithHole(2.0, 0.2, 0.9); }},
      {"star", box, [] { return MakeStar(0.6, 1.2); }},
      {"axes", cone, [] { return MakeAxes(1.0, 0.12); }},
      {"box shell", box,
       [] {
         return MakeBoxShell(Vector3d(-1, -1, -1), Vector3d(1, 1, 1), 0.3);
       }},
  };
  *brief = static_cast<int>(all.size());
  const std::vector<Solids> rest = {
      {"box", star,
       [] {
         return MakeBox(Vector3d::Zero(), {1, 2, 3});
       }},
      {"ico ball", star, [] { return MakeIcoBall(1.0, 2); }},
      {"uv ball", box, [] { return MakeUvBall(1.0, 12, 10); }},
      {"cone", star, [] { return MakeCone(1.0, 2.0, 24); }},
      {"wrench", ball, [] { return MakeWrench(0.3, 16, 15, 12, 10); }},
      {"torus", cone, [] { return MakeTorus(1.0, 0.3, 20, 10); }},
      {"plate with round hole", box,
       [] { return MakePlateWithRoundHole(2.0, 0.2, 0.5, 12); }},
      {"prism", star, [] { return MakePrism(0.8, 1.0, 9); }},
      {"vessel", ball, [] { return MakeVessel(2.0, 1.4, 0.8); }},
      {"blob", cone, [] { return MakeBlob(1.0, 2, 0.3, 5); }},
      {"scan", box,
       [] { return MakeScan(MakeU(2.0, 0.4, 0.7), 0.6, 0.01, 3); }},
      {"knot", cone, [] { return MakeKnot(0.5, 0.12, 48, 6); }},
  };
  all.insert(all.end(), rest.begin(), rest.end());
  // Kinds without gaps between 0 and 1e-6 L.
  for (const PairKind kind :
       {PairKind::kAligned, PairKind::kTurnedAlike, PairKind::kTurnedApart,
        PairKind::kCavity, PairKind::kManyBoxes}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      all.push_back({"random pair, " + Name(kind),
                     [=] { return pair(kind, seed, true); },
                     [=] { return pair(kind, seed, false); }});
    }
  }
  for (const char* name : {"ball_cone", "cone_axes", "ball_wrench"}) {
    const Workspace of = ParseScene(MakeScene(name, {}), name).workspace;
    all.push_back(
        {name, [=] { return of.robot; }, [=] { return JoinedObstacle(of); }});
  }
  return all;
}

// The outward direction at q_c.  A closest point may be a re-entrant edge, the
// tip of a notch, where `direction`, which points from q_o to q_c, can lead
// into the facet on the other side: free wedges below 90° have such
// directions.  There a direction above all facets at q_c takes its place; the
// Phong direction is one by itself.
Vector3d Outward(const TriangleMesh& mesh, const PenetrationResult& result,
                 double diagonal) {
  std::vector<Vector3d> normals;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d& b = mesh.vertices[t[1]];
    const Vector3d& c = mesh.vertices[t[2]];
    const double reach = 2e-6 * diagonal;
    if (ClosestOnTriangle(a, b, c, result.contact).squared_distance <=
        reach * reach) {
      normals.push_back((b - a).cross(c - a).stableNormalized());
    }
  }
  const auto lowest = [&](const Vector3d& n) {
    return *std::min_element(normals.begin(), normals.end(),
                             [&](const Vector3d& x, const Vector3d& y) {
                               return n.dot(x) < n.dot(y);
                             });
  };
  Vector3d n = result.direction;
  for (int i = 0; i < 1000 && n.normalized().dot(lowest(n)) < 0.1; ++i) {
    n += 0.2 * lowest(n);
  }
  return n.normalized();
}

struct Tally {
  long poses = 0;
  long failures = 0;
  long turned = 0;  // Euclidean directions that Outward replaced
};

// Poses of one pair: the same points by every route.
Tally Separate(const Solids& solids, long poses, std::mt19937_64* random) {
  const Solid robot = MakeSolid(solids.robot(), "robot");
  const Solid obstacle = MakeSolid(solids.obstacle(), "obstacle");
  const TriangleMesh mesh = BuildContactSpace(robot, obstacle).mesh();
  const BoundingBox box = ComputeBounds(mesh);
  const double diagonal = box.Diagonal();
  const CollisionOracle fcl(robot, obstacle);
  const MotionOracle exact(robot, obstacle);
  const auto metrics =
      testing::EuclideanAndPhong(TakeAsContactSpace(mesh), 0.1);
  std::vector<Branch> branches(metrics.size());
  Tally tally;
  const auto judge = [&](const PenetrationResult& result, const Vector3d& q,
                         std::size_t m, const char* how) {
    ++tally.poses;
    Vector3d n = result.direction;
    if (m == 0 || result.status == QueryStatus::kEuclideanFallback) {
      n = Outward(mesh, result, diagonal);
      tally.turned += n.dot(result.direction) < 0.999 ? 1 : 0;
    }
    const Vector3d out = q + result.PenetrationVector(q) + 1e-6 * diagonal * n;
    const bool deep = result.signed_distance < -1e-9 * diagonal;
    const bool by_fcl = fcl.Collides(out), by_exact = exact.Collides(out);
    // And what is separated must have been in collision.
    if (!by_fcl && !by_exact && (!deep || exact.Collides(q))) return;
    ++tally.failures;
    ADD_FAILURE() << solids.name << ", metric " << m << ", " << how << ", q "
                  << q.transpose() << ": depth " << -result.signed_distance
                  << " fcl " << by_fcl << " exact " << by_exact;
  };
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Vector3d q = box.Center();
  long made = 0;
  for (long tried = 0; made < poses && tried < 1000 * (poses + 1); ++tried) {
    // Every eighth pose anywhere, the others a step on: branches follow.
    const bool fresh = made % 8 == 0;
    const Vector3d step(unit(*random), unit(*random), unit(*random));
    const Vector3d next =
        fresh ? RandomPoint(box, random) : Vector3d(q + 0.02 * diagonal * step);
    const PenetrationResult euclid = metrics[0]->Query(next);
    if (!euclid.inside) continue;
    q = next;
    made += 5;
    judge(euclid, q, 0, "cold");
    for (std::size_t m = 1; m < metrics.size(); ++m) {
      judge(metrics[m]->Query(q), q, m, "cold");
      if (fresh) branches[m] = Branch();
      const PenetrationResult warm = metrics[m]->Query(q, branches[m]);
      branches[m] = warm.branch;
      judge(warm, q, m, "warm");
    }
  }
  return tally;
}

// PD + 1e-6 L n̂ leaves the obstacle: on the original meshes, for Euclidean PD
// and PhongPD (ℓ = 0 and 0.1), cold and warm.
TEST(SeparationCampaign, PenetrationVectorsSeparateTheOriginalSolids) {
  int brief = 0;
  const std::vector<Solids> all = AllSolids(&brief);
  const long whole = static_cast<long>(all.size());
  const long pairs = testing::CampaignCases(brief, whole);
  const long poses = testing::CampaignCases(2000, 105000) / pairs;
  std::mt19937_64 random(kSeed);
  Tally sum;
  for (long i = 0; i < pairs; ++i) {
    const Tally tally =
        Separate(all[static_cast<std::size_t>(i)], poses, &random);
    EXPECT_GE(tally.poses, poses) << all[static_cast<std::size_t>(i)].name;
    sum.poses += tally.poses;
    sum.failures += tally.failures;
    sum.turned += tally.turned;
  }
  EXPECT_EQ(sum.failures, 0);
  // The case that needs Outward is there.
  EXPECT_GT(sum.turned, 0);
  testing::ReportCampaign({"1 separation",
                           std::to_string(pairs) +
                               " pairs of solids; Euclid and Phong (ℓ 0, "
                               "0.1), cold and warm; FCL and exact predicates",
                           sum.poses, sum.failures, 0.0, 0.0, "", kSeed});
}

}  // namespace
}  // namespace phongpd
