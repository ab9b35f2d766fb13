// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>

#include "core/minkowski/build_limits.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/sanitizer.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

TriangleMesh Peg(double side) {
  return MakeBox({-side / 2, -side / 2, -1}, {side / 2, side / 2, 1});
}

void ExpectSound(const ContactSpaceReport& report) {
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.manifold);
}

TEST(ContactSpace, OfTwoUnitCubesIsTheCubeOfSideTwo) {
  const ContactSpace c = BuildContactSpace(Cube(1), Cube(1));
  ExpectSound(c.report());
  EXPECT_EQ(c.report().volume, 8.0);
  EXPECT_EQ(c.report().triangles, 12u);
  EXPECT_EQ(c.report().vertices, 8u);
  EXPECT_EQ(c.report().genus, 0);
}

TEST(ContactSpace, IsObstaclePlusReflectedRobot) {
  // A robot that extends to +x keeps the obstacle away on the −x side.
  const TriangleMesh robot = MakeBox({0, 0, 0}, {3, 1, 1});
  const ContactSpace c =
      BuildContactSpace(robot, MakeBox({0, 0, 0}, {1, 1, 1}));
  const BoundingBox box = ComputeBounds(c.mesh());
  EXPECT_EQ(box.min, Vector3d(-3, -1, -1));
  EXPECT_EQ(box.max, Vector3d(1, 1, 1));
}

TEST(ContactSpace, OfACubeInAVesselHasACavityThatArisesByTheSum) {
  const ContactSpace c = BuildContactSpace(Cube(1), MakeVessel(3.6, 3.0, 0.6));
  ExpectSound(c.report());
  EXPECT_NEAR(c.report().volume, 89.336, 1e-9);
  EXPECT_EQ(c.report().components, 2);
  EXPECT_EQ(c.report().cavities, 1);
}

TEST(ContactSpace, OfACubeInAShellKeepsTheCavity) {
  const ContactSpace c = BuildContactSpace(Cube(1), MakeVessel(4, 3, 0));
  ExpectSound(c.report());
  EXPECT_EQ(c.report().volume, 125.0 - 8.0);
  EXPECT_EQ(c.report().cavities, 1);
}

TEST(ContactSpace, OuterShellOnlyDropsCavities) {
  ContactSpaceOptions options;
  options.outer_shell_only = true;
  const ContactSpace c =
      BuildContactSpace(Cube(1), MakeVessel(4, 3, 0), options);
  ExpectSound(c.report());
  EXPECT_EQ(c.report().volume, 125.0);
  EXPECT_EQ(c.report().components, 1);
}

TEST(ContactSpace, OfAnExactlyFittingPegHasNoSlot) {
  const ContactSpace c = BuildContactSpace(Peg(1), MakePlateWithHole(4, 1, 1));
  ExpectSound(c.report());
  EXPECT_EQ(c.report().volume, 75.0);
  EXPECT_EQ(c.report().genus, 0);
}

TEST(ContactSpace, OfAPegWithOnePercentClearanceHasAThroughSlot) {
  const ContactSpace c =
      BuildContactSpace(Peg(0.99), MakePlateWithHole(4, 1, 1));
  ExpectSound(c.report());
  // (4.99² − 0.01²) · 3
  EXPECT_NEAR(c.report().volume, 74.7, 1e-9);
  EXPECT_EQ(c.report().genus, 1);
}

TEST(ContactSpace, KeepsASlotOfOneMillionth) {
  const double peg = 1 - 1e-6;
  const ContactSpace c =
      BuildContactSpace(Peg(peg), MakePlateWithHole(4, 1, 1));
  ExpectSound(c.report());
  EXPECT_EQ(c.report().genus, 1);
  EXPECT_NEAR(c.report().volume, ((4 + peg) * (4 + peg) - 1e-12) * 3, 1e-9);
}

TEST(ContactSpace, OfConvexBodiesHasTheVolumeOfMixedVolumes) {
  // Steiner: V(B ⊕ box) for a box obstacle and a prism robot is linear in
  // each; here simply the sum of two boxes of different sides.
  const ContactSpace c = BuildContactSpace(MakeBox({-1, -2, -3}, {1, 2, 3}),
                                           MakeBox({0, 0, 0}, {5, 7, 9}));
  EXPECT_EQ(c.report().volume, 7.0 * 11.0 * 15.0);
}

TEST(ContactSpace, OfSolidsThatTouchAlongAnEdgeKeepsThemApart) {
  // Two bars whose sums with the unit cube meet in one vertical edge.
  const TriangleMesh bars =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({2, 2, 0}, {3, 3, 1}));
  const ContactSpace c = BuildContactSpace(Cube(1), bars);
  ExpectSound(c.report());
  EXPECT_EQ(c.report().components, 2);
  EXPECT_EQ(c.report().volume, 16.0);
}

TEST(ContactSpace, OfSolidsThatTouchInAVertexKeepsThemApart) {
  const TriangleMesh bars =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({2, 2, 2}, {3, 3, 3}));
  const ContactSpace c = BuildContactSpace(Cube(1), bars);
  ExpectSound(c.report());
  EXPECT_EQ(c.report().components, 2);
  EXPECT_EQ(c.report().volume, 16.0);
}

TEST(ContactSpace, OfASolidThatTouchesItselfAlongAnEdgeIsManifold) {
  // As above, but a third box joins the two: one solid, pinched on an edge.
  const TriangleMesh bars = Joined(
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({2, 2, 0}, {3, 3, 1})),
      MakeBox({0, 0, 1.5}, {3, 3, 2.5}));
  const ContactSpace c = BuildContactSpace(Cube(1), bars);
  ExpectSound(c.report());
  EXPECT_EQ(c.report().components, 1);
  // Slab 4·4·2 and, below it, two columns of 2·2·1.5.
  EXPECT_EQ(c.report().volume, 32.0 + 12.0);
}

TEST(ContactSpace, TakesOverlappingComponentsAsTheirUnion) {
  const TriangleMesh cone = MakeCone(0.8, 1.6, 40);
  const auto bar = [](int axis) {
    Vector3d half(0.2, 0.2, 0.2);
    half[axis] = 2;
    return MakeBox(-half, half);
  };
  const ContactSpace one = BuildContactSpace(cone, MakeAxes(2, 0.2));
  const ContactSpace three =
      BuildContactSpace(cone, Joined(Joined(bar(0), bar(1)), bar(2)));
  EXPECT_NEAR(one.report().volume, three.report().volume, 1e-9);
  EXPECT_EQ(one.report().triangles, three.report().triangles);
}

TEST(ContactSpace, SwappingTheOperandsMirrorsIt) {
  const TriangleMesh a = MakeStar(0.5, 1.2), b = MakeTorus(2, 0.6, 12, 8);
  const ContactSpace ab = BuildContactSpace(a, b), ba = BuildContactSpace(b, a);
  EXPECT_NEAR(ab.report().volume, ba.report().volume,
              1e-9 * ab.report().volume);
  EXPECT_EQ(ab.report().genus, ba.report().genus);
  const BoundingBox x = ComputeBounds(ab.mesh()), y = ComputeBounds(ba.mesh());
  EXPECT_LT((x.min + y.max).norm(), 1e-10);
  EXPECT_LT((x.max + y.min).norm(), 1e-10);
}

TEST(ContactSpace, ScalesBitIdenticallyByPowersOfTwo) {
  const TriangleMesh a = MakeCone(0.8, 1.6, 20), b = MakeL(3, 1, 1);
  const ContactSpace c = BuildContactSpace(a, b);
  for (const double factor : {std::ldexp(1.0, -30), std::ldexp(1.0, 30)}) {
    const ContactSpace s =
        BuildContactSpace(Scaled(a, factor), Scaled(b, factor));
    ASSERT_EQ(s.mesh().triangles, c.mesh().triangles);
    for (std::size_t i = 0; i < c.mesh().vertices.size(); ++i) {
      EXPECT_EQ(s.mesh().vertices[i], factor * c.mesh().vertices[i]);
    }
  }
}

TEST(ContactSpace, KeepsItsVolumeWhereverTheOperandsAre) {
  const TriangleMesh a = MakeCone(0.8, 1.6, 20), b = MakeU(3, 0.5, 1);
  const double volume = BuildContactSpace(a, b).report().volume;
  const Vector3d far(1e5, -2e5, 3e5);
  for (const double scale : {1e-9, 1e-3, 1e3, 1e9}) {
    const ContactSpace c =
        BuildContactSpace(Scaled(a, scale), Scaled(b, scale));
    EXPECT_NEAR(c.report().volume / std::pow(scale, 3), volume, 1e-8 * volume);
  }
  const ContactSpace c = BuildContactSpace(Translated(a, far), b);
  ExpectSound(c.report());
  EXPECT_NEAR(c.report().volume, volume, 1e-8 * volume);
  const BoundingBox box = ComputeBounds(c.mesh());
  EXPECT_LT((box.Center() + far).norm(), 10.0);
}

TEST(ContactSpace, IsTheTurnedOneWhenBothOperandsTurnAlike) {
  const TriangleMesh a = MakeWrench(0.5, 12, 12, 8, 8), b = MakeL(3, 1, 1);
  const ContactSpace straight = BuildContactSpace(a, b);
  const Eigen::Matrix3d turn = GenericRotation();
  const ContactSpace c = BuildContactSpace(Rotated(a, turn), Rotated(b, turn));
  ExpectSound(c.report());
  EXPECT_FALSE(straight.report().canonical_frame);
  EXPECT_TRUE(c.report().canonical_frame);
  EXPECT_NEAR(c.report().volume, straight.report().volume,
              1e-9 * straight.report().volume);
  EXPECT_EQ(c.report().triangles, straight.report().triangles);
  const BoundingBox back = ComputeBounds(Rotated(c.mesh(), turn.transpose()));
  const BoundingBox box = ComputeBounds(straight.mesh());
  EXPECT_LT((back.min - box.min).norm() + (back.max - box.max).norm(), 1e-9);
}

TEST(ContactSpace, LeavesSolidsWithoutCommonAxesWhereTheyAre) {
  const ContactSpace c = BuildContactSpace(
      MakeStar(0.5, 1.2), Rotated(MakeIcoBall(2, 2), GenericRotation()));
  EXPECT_FALSE(c.report().canonical_frame);
}

TEST(ContactSpace, DoesNotDependOnTheNumberOfThreads) {
  const TriangleMesh a = MakeStar(0.5, 1.2), b = MakeTorus(2, 0.6, 16, 8);
  const ContactSpace parallel = BuildContactSpace(a, b);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ContactSpace serial = BuildContactSpace(a, b);
  EXPECT_EQ(parallel.mesh().triangles, serial.mesh().triangles);
  EXPECT_EQ(parallel.mesh().vertices, serial.mesh().vertices);
  EXPECT_EQ(parallel.plane(), serial.plane());
}

TEST(ContactSpace, TrianglesOfOnePlaneIdAreCoplanar) {
  const ContactSpace c =
      BuildContactSpace(MakeCone(0.8, 1.6, 20), MakeAxes(2, 0.2));
  std::vector<Vector3d> normal, point;
  for (std::size_t t = 0; t < c.mesh().triangles.size(); ++t) {
    const std::size_t id = static_cast<std::size_t>(c.plane()[t]);
    const Triangle& f = c.mesh().triangles[t];
    const Vector3d& p = c.mesh().vertices[f[0]];
    const Vector3d n =
        (c.mesh().vertices[f[1]] - p).cross(c.mesh().vertices[f[2]] - p);
    if (id == normal.size()) {
      normal.push_back(n.normalized());
      point.push_back(p);
    }
    ASSERT_LT(id, normal.size());
    for (const int v : f) {
      EXPECT_LT(std::abs(normal[id].dot(c.mesh().vertices[v] - point[id])),
                1e-9);
    }
  }
}

TEST(ContactSpace, MergingCoplanarTrianglesKeepsTheSurface) {
  const TriangleMesh a = MakeWrench(0.5, 12, 12, 8, 8), b = MakeL(3, 1, 1);
  ContactSpaceOptions raw;
  raw.merge_coplanar = false;
  const ContactSpace merged = BuildContactSpace(a, b);
  const ContactSpace cut = BuildContactSpace(a, b, raw);
  ExpectSound(cut.report());
  EXPECT_LT(merged.report().triangles, cut.report().triangles);
  EXPECT_NEAR(merged.report().volume, cut.report().volume, 1e-9);
  EXPECT_NEAR(SurfaceArea(merged.mesh()), SurfaceArea(cut.mesh()), 1e-9);
}

TEST(ContactSpace, RefusesAnOpenOperandByNameAndCount) {
  TriangleMesh open = Cube(1);
  open.triangles.pop_back();
  ContactSpaceOptions options;
  options.robot_name = "gripper.stl";
  const std::string what =
      testing::ErrorOf([&] { BuildContactSpace(open, Cube(1), options); });
  EXPECT_NE(what.find("gripper.stl"), std::string::npos) << what;
  EXPECT_NE(what.find("3"), std::string::npos) << what;
}

constexpr double kQuarantineMib = testing::kKeepsFreedMemory ? 512.0 : 0.0;

TEST(ContactSpace, RefusesWhatIsPredictedToExceedALimit) {
  const TriangleMesh a = MakeStar(0.5, 1.2), b = MakeTorus(2, 0.6, 24, 12);
  const PredictedCost cost = BuildContactSpace(a, b).report().predicted;
  ContactSpaceOptions options;
  options.max_seconds = 0.5 * cost.seconds;
  EXPECT_THROW(BuildContactSpace(a, b, options), InputError);
  options.max_seconds = 600;          // passed by no machine
  options.max_mib = 0.05 * cost.mib;  // by boxes neither
  EXPECT_THROW(BuildContactSpace(a, b, options), InputError);
  options.max_mib = 10 * cost.mib + kQuarantineMib;
  EXPECT_NO_THROW(BuildContactSpace(a, b, options));
}

TEST(ContactSpace, StopsABuildThatPassesALimit) {
  internal::BuildLimits limits([] {
    ContactSpaceOptions options;
    options.max_seconds = 1e-9;
    options.robot_name = "screw.off";
    return options;
  }());
  const std::string what =
      testing::ErrorOf([&] { limits.Check("arrangement"); });
  for (const char* part : {"screw.off", "max_seconds", "arrangement"}) {
    EXPECT_NE(what.find(part), std::string::npos) << what;
  }
}

// Whenever it is asked for, and whatever threads have reserved by then.
TEST(ContactSpace, MayTakeNineTenthsOfWhatWasFreeInTheBeginning) {
  const ContactSpaceOptions options;
  EXPECT_GT(internal::BuildLimits(options).max_mib(), 0.0);
  if (testing::kIsSanitized) GTEST_SKIP() << "sanitizers need address space";
  double pages = 0.0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit limit = before;
  const std::size_t mib = std::size_t{1} << 20;
  limit.rlim_cur =
      static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) +
      200 * mib;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const internal::BuildLimits early(options), late(options);
  const double expected = early.max_mib();
  void* const reserved =
      mmap(nullptr, 150 * mib, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const double found = late.max_mib();
  const double now = internal::BuildLimits(options).max_mib();
  EXPECT_EQ(munmap(reserved, 150 * mib), 0);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_NEAR(expected, 0.9 * 200.0, 1.0);
  EXPECT_NEAR(found, expected, 1.0);
  EXPECT_NEAR(now, expected - 0.9 * 150.0, 1.0);
}

TEST(ContactSpace, StopsBeforeItFillsTheMemory) {
  ContactSpaceOptions options;
  options.max_mib = 0.25;
  internal::BuildLimits limits(options);
  std::vector<char> more(std::size_t{64} << 20, 1);
  EXPECT_EQ(more.back(), 1);
  EXPECT_THROW(limits.Check("arrangement"), InputError);
}

TEST(ContactSpace, PredictsItsArrangementWithinAFactorOfTwo) {
  const ContactSpaceReport report =
      BuildContactSpace(MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 24, 12)).report();
  const double built = static_cast<double>(report.arrangement_faces);
  EXPECT_LT(report.predicted.arrangement_faces, 2 * built);
  EXPECT_GT(report.predicted.arrangement_faces, 0.5 * built);
}

TEST(ContactSpace, TurnsAnInsideOutOperandAndSaysSo) {
  const ContactSpace c = BuildContactSpace(Reversed(Cube(1)), Cube(1));
  EXPECT_EQ(c.report().volume, 8.0);
  EXPECT_EQ(c.report().robot.inverted_components, 1);
  EXPECT_FALSE(c.report().warnings.empty());
}

}  // namespace
}  // namespace phongpd
