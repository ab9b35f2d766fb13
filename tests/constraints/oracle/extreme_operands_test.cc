// SPDX-License-Identifier: GPL-3.0-or-later
// Operands at the extremes of shape and position, each against closed forms,
// counts known by construction, and collision tests at points.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/contact_space_check.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using testing::CampaignCases;
using testing::CampaignRow;
using testing::Cube;
using testing::ReportCampaign;

// Counts cases and their failures, and tells gtest and the campaign.
class Table {
 public:
  explicit Table(const std::string& subject) {
    row_.item = "geometry";
    row_.subject = subject;
    row_.seed = 1;
  }
  ~Table() { ReportCampaign(row_); }

  // All that tests/support/contact_space_check.h asks of a pair.
  void Check(const std::string& what, const SolidPair& pair) {
    CheckOptions options;
    options.points = static_cast<int>(CampaignCases(24, 200));
    options.variants = testing::IsLongCampaign();
    ++row_.cases;
    const CheckResult result = CheckContactSpace(pair, options);
    row_.failures += !result.failures.empty();
    for (const std::string& failure : result.failures) {
      ADD_FAILURE() << what << ": " << failure;
    }
  }
  // |value − truth| ≤ bound · scale.
  void CheckValue(const std::string& what, double value, double truth,
                  double bound, double scale) {
    ++row_.cases;
    const double error = std::abs(value - truth) / scale;
    row_.worst = std::max(row_.worst, error);
    row_.bound = bound;
    row_.failures += !(error <= bound);
    EXPECT_LE(error, bound) << what << ": " << value << ", not " << truth;
  }

 private:
  CampaignRow row_;
};

// Of a vertex: by the grid, or, where the operands lie on it, by the doubles it
// is written in.
double Rounding(const ContactSpace& space) {
  return std::max(space.report().grid_step,
                  0x1p-52 * ComputeBounds(space.mesh()).Diagonal());
}

TriangleMesh Box(const Vector3d& size) {
  return MakeBox(-0.5 * size, 0.5 * size);
}

TriangleMesh Tetrahedron(const Vector3d& a, const Vector3d& b,
                         const Vector3d& c, const Vector3d& d) {
  TriangleMesh mesh{{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  return SignedVolume(mesh) > 0 ? mesh : Reversed(mesh);
}

// |K ⊕ box| for convex K: each edge of the box sweeps K's shadow along it,
// each face K's width across it.
double SumWithBox(const TriangleMesh& convex, const Vector3d& box) {
  Vector3d shadow = Vector3d::Zero();
  for (const Triangle& t : convex.triangles) {
    const Vector3d& a = convex.vertices[t[0]];
    shadow +=
        0.25 *
        (convex.vertices[t[1]] - a).cross(convex.vertices[t[2]] - a).cwiseAbs();
  }
  const BoundingBox bounds = ComputeBounds(convex);
  const Vector3d width = bounds.max - bounds.min;
  return SignedVolume(convex) + box.dot(shadow) +
         box.x() * box.y() * width.z() + box.y() * box.z() * width.x() +
         box.z() * box.x() * width.y() + box.prod();
}

// A prism over the triangle (0,0) (1,0) (1,angle): the edge at the origin is a
// knife's.
TriangleMesh Knife(double angle) {
  const double slope = std::tan(angle);
  std::vector<Vector3d> corners;
  for (const double z : {-0.5, 0.5}) {
    corners.insert(corners.end(), {{0, 0, z}, {1, 0, z}, {1, slope, z}});
  }
  return {corners,
          {{0, 2, 1},
           {3, 4, 5},
           {0, 1, 4},
           {0, 4, 3},
           {1, 2, 5},
           {1, 5, 4},
           {2, 0, 3},
           {2, 3, 5}}};
}

TEST(ExtremeOperandsCampaign, SumsOfBoxesOfAnyAspectHaveTheirVolume) {
  Table table("boxes, aspect 1 to 1e6, volume in closed form");
  const int finest = 6;
  const int stride = testing::IsLongCampaign() ? 1 : 3;
  for (int i = 0; i <= finest; i += stride) {
    for (int j = 0; j <= i; j += stride) {
      for (int k = 0; k <= finest; k += stride) {
        const Vector3d a(1.0, std::pow(10.0, -i), std::pow(10.0, -j));
        const Vector3d b(std::pow(10.0, -k), 1.0, 0.3);
        for (const bool is_turned : {false, true}) {
          const Matrix3d turn =
              is_turned ? GenericRotation() : Matrix3d::Identity();
          const ContactSpace space =
              BuildContactSpace(Rotated(Box(a), turn), Rotated(Box(b), turn));
          table.CheckValue("boxes", space.report().volume, (a + b).prod(),
                           32 * Rounding(space), SurfaceArea(space.mesh()));
          EXPECT_TRUE(space.report().manifold);
          EXPECT_EQ(space.report().genus, 0);
          EXPECT_EQ(space.report().components, 1);
        }
      }
    }
  }
}

TEST(ExtremeOperandsCampaign, NeedlesSlabsAndKnivesMeetBoxesInClosedForm) {
  Table table("needles, slabs, knives to 1e-6 with a box, closed form");
  const int count = static_cast<int>(CampaignCases(4, 60));
  std::mt19937_64 random(1);
  for (int i = 0; i < count; ++i) {
    for (int k = 1; k <= 6; k += testing::IsLongCampaign() ? 1 : 5) {
      const double thin = std::pow(10.0, -k);
      const Matrix3d turn =
          i == 0 ? Matrix3d::Identity() : testing::RandomRotation(&random);
      const Vector3d box(0.3, i % 2 == 0 ? 0.2 : thin, 0.1);
      for (const TriangleMesh& shape :
           {MakeCone(thin, 1.0, 7), MakePrism(1.0, thin, 9), Knife(thin),
            Tetrahedron({0, 0, 0}, {1, thin, 0}, {1, 0, thin}, {1, 0, 0})}) {
        const TriangleMesh solid = Rotated(shape, turn);
        for (const bool is_robot : {false, true}) {
          const TriangleMesh other = Box(box);
          const ContactSpace space = is_robot ? BuildContactSpace(solid, other)
                                              : BuildContactSpace(other, solid);
          table.CheckValue("convex", space.report().volume,
                           SumWithBox(solid, box), 32 * Rounding(space),
                           SurfaceArea(space.mesh()));
          EXPECT_TRUE(space.report().manifold);
        }
      }
    }
  }
}

TEST(ExtremeOperandsCampaign, DifferenceBodiesOfSimplicesAreTwentyTimesThem) {
  // Rogers and Shephard 1957: |K − K| = C(6,3) |K| for simplices, the most.
  Table table("tetrahedra against themselves, 20 |T|");
  std::mt19937_64 random(2);
  const long count = CampaignCases(20, 2000);
  for (long i = 0; i < count; ++i) {
    const Vector3d scale(1.0, std::pow(10.0, -double(i % 7)),
                         std::pow(10.0, -double(i % 4)));
    const auto corner = [&] {
      return Vector3d(testing::RandomPoint({-scale, scale}, &random));
    };
    const TriangleMesh tetrahedron =
        Tetrahedron(corner(), corner(), corner(), corner());
    const ContactSpace space = BuildContactSpace(tetrahedron, tetrahedron);
    table.CheckValue("simplex", space.report().volume,
                     20 * SignedVolume(tetrahedron), 32 * Rounding(space),
                     SurfaceArea(space.mesh()));
    EXPECT_TRUE(space.report().manifold);
    // Every pose that puts one corner on another is in contact.
    EXPECT_LT(
        TriangleBvh(space.mesh())
            .FindClosest(tetrahedron.vertices[0] - tetrahedron.vertices[1])
            .distance,
        4 * Rounding(space));
  }
}

// A block whose top is the saddle z = 1 + bend · (x² − y²).
TriangleMesh Saddle(int cells, double bend) {
  TriangleMesh mesh;
  const int n = cells + 1;
  for (const bool is_top : {false, true}) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double x = 2.0 * i / cells - 1.0, y = 2.0 * j / cells - 1.0;
        mesh.vertices.push_back(
            {x, y, is_top ? 1.0 + bend * (x * x - y * y) : 0.0});
      }
    }
  }
  const auto quad = [&mesh](int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  const int top = n * n;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const int a = i * n + j, b = a + n, c = b + 1, d = a + 1;
      quad(a, d, c, b);
      quad(top + a, top + b, top + c, top + d);
    }
    const int far = cells * n;  // walls at y = −1, y = 1, x = −1, x = 1
    quad(i * n, (i + 1) * n, top + (i + 1) * n, top + i * n);
    quad((i + 1) * n + cells, i * n + cells, top + i * n + cells,
         top + (i + 1) * n + cells);
    quad(i + 1, i, top + i, top + i + 1);
    quad(far + i, far + i + 1, top + far + i + 1, top + far + i);
  }
  return mesh;
}

TEST(ExtremeOperandsCampaign, SaddlesStarsAndKnivesKeepTheirPoints) {
  Table table("saddles, stars, knives: collision at points");
  const auto check = [&table](const char* what, const TriangleMesh& robot,
                              const TriangleMesh& obstacle) {
    SolidPair pair;
    pair.robot = robot;
    pair.obstacle = obstacle;
    table.Check(what, pair);
  };
  const int exponents = static_cast<int>(CampaignCases(2, 6));
  for (int e = 0; e < exponents; ++e) {
    const double thin = std::pow(10.0, testing::IsLongCampaign() ? -e : -6 * e);
    check("saddle, box", Cube(0.3), Saddle(4, 0.9 * thin));
    check("saddle, saddle", Rotated(Saddle(2, thin), GenericRotation()),
          Saddle(3, 0.7 * thin));
    check("star, knife", Rotated(Knife(thin), GenericRotation()),
          MakeStar(0.4, 1.0));
    check("knife, knife", Rotated(Knife(thin), GenericRotation()), Knife(thin));
    check("L, needle", MakeCone(thin, 1.0, 5), MakeL(1.0, 0.3, 0.2));
  }
}

TEST(ExtremeOperandsCampaign, CoplanarAndCollinearVerticesChangeNothing) {
  Table table("faces and edges cut finer, the same contact space");
  for (const TriangleMesh& coarse :
       {Cube(2.0), MakeL(2.0, 0.5, 0.5), MakeVessel(4.0, 2.0, 0.0)}) {
    const TriangleMesh fine = MakeScan(coarse, 0.5, 0.0, 1);
    for (const TriangleMesh& other : {Cube(0.5), MakeAxes(0.75, 0.25)}) {
      const ContactSpace truth = BuildContactSpace(other, coarse);
      for (const bool is_robot_fine : {false, true}) {
        const ContactSpace space = BuildContactSpace(
            is_robot_fine ? MakeScan(other, 0.25, 0.0, 1) : other, fine);
        table.CheckValue("volume", space.report().volume, truth.report().volume,
                         1e-15, truth.report().volume);
        table.CheckValue(
            "triangles", static_cast<double>(space.report().triangles),
            static_cast<double>(truth.report().triangles), 0.0, 1.0);
        EXPECT_EQ(space.report().components, truth.report().components);
        EXPECT_EQ(space.report().cavities, truth.report().cavities);
        EXPECT_EQ(space.report().genus, truth.report().genus);
      }
    }
  }
}

TEST(ExtremeOperandsCampaign, SolidsThatShareAPointAnEdgeOrAFace) {
  Table table("components and operands that touch");
  const LatticeBox unit = {{0, 0, 0}, {4, 4, 4}};
  const LatticeBox others[] = {{{4, 4, 4}, {8, 8, 8}},   // a vertex
                               {{4, 4, 0}, {8, 8, 4}},   // an edge
                               {{4, 0, 0}, {8, 4, 4}},   // a face
                               {{4, 2, 2}, {8, 6, 6}},   // part of a face
                               {{4, 4, 2}, {8, 8, 6}}};  // part of an edge
  const std::vector<LatticeBox> robot = {{{0, 0, 0}, {1, 2, 3}}};
  for (const LatticeBox& other : others) {
    SolidPair pair;
    pair.robot = BoxesMesh(robot);
    pair.obstacle = BoxesMesh({unit, other});
    pair.volume = LatticeSumVolume(robot, {unit, other});
    pair.components = 1;
    pair.cavities = 0;
    pair.genus = 0;
    pair.is_exact = true;
    table.Check("as components of the obstacle", pair);
    std::swap(pair.robot, pair.obstacle);
    table.Check("as components of the robot", pair);

    // As robot and obstacle: q = 0 is on the contact space, and the pose is
    // free or not a little way off.
    const TriangleMesh a = BoxesMesh({unit}), b = BoxesMesh({other});
    const ContactSpace space = BuildContactSpace(a, b);
    table.CheckValue(
        "touching pose",
        TriangleBvh(space.mesh()).FindClosest(Vector3d::Zero()).distance, 0.0,
        0.0, 1.0);
    for (int i = 0; i < 27; ++i) {
      const Vector3d q = 1e-9 * Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      bool is_free = false, is_on_surface = false;
      for (int k = 0; k < 3; ++k) {
        const double low = 0.25 * (other.min[k] - unit.max[k]);
        const double high = 0.25 * (other.max[k] - unit.min[k]);
        is_free |= q[k] < low || q[k] > high;
        is_on_surface |= q[k] == low || q[k] == high;
      }
      if (is_on_surface) continue;
      table.CheckValue(
          "beside it",
          testing::WindingNumber(space.mesh(), q) > 0.5 ? 0.0 : 1.0,
          is_free ? 1.0 : 0.0, 0.0, 1.0);
    }
  }
}

TEST(ExtremeOperandsCampaign, NestedShellsKeepEveryCavity) {
  Table table("shells nested to depth 5, robots with cavities");
  const auto cube = [](double side) { return Cube(side); };
  const auto cubed = [](double x) { return x * x * x; };
  for (int depth = 1; depth <= 5; ++depth) {
    TriangleMesh obstacle;
    for (int i = 0; i < depth; ++i) {  // walls 1 thick, gaps 1 wide
      obstacle = Joined(obstacle, MakeVessel(4.0 * i + 8.0, 4.0 * i + 6.0, 0));
    }
    const auto expect = [&](double robot, int cavities, double volume) {
      SolidPair pair;
      pair.robot = cube(robot);
      pair.obstacle = obstacle;
      pair.volume = volume;
      pair.cavities = cavities;
      pair.components = 2 * cavities;
      if (cavities == 1) pair.components = 2;
      pair.genus = 0;
      pair.is_exact = true;
      table.Check("depth " + std::to_string(depth), pair);
      // Inside out as a robot: the same by symmetry.
      std::swap(pair.robot, pair.obstacle);
      table.Check("robot of depth " + std::to_string(depth), pair);
    };
    double volume = 0.0;
    for (int i = 0; i < depth; ++i) {
      volume += cubed(4.0 * i + 8.5) - cubed(4.0 * i + 5.5);
    }
    expect(0.5, depth, volume);
    // Too large for the gaps: only the innermost cavity is left.
    expect(1.5, 1, cubed(4.0 * depth + 5.5) - cubed(4.5));
  }
  // Both hollow: a box in the cavity of the other, and around it.
  SolidPair pair;
  pair.robot = MakeVessel(8.0, 6.0, 0.0);
  pair.obstacle = MakeVessel(2.0, 1.0, 0.0);
  pair.volume = cubed(10.0) - cubed(4.0);
  pair.cavities = 1;
  pair.components = 2;
  pair.genus = 0;
  pair.is_exact = true;
  table.Check("both hollow", pair);
  pair.robot = MakePlateWithHole(4.0, 1.0, 2.0);
  pair.obstacle = cube(0.5);
  pair.volume = (4.5 * 4.5 - 1.5 * 1.5) * 1.5;
  pair.cavities = 0;
  pair.components = 1;
  pair.genus = 1;
  table.Check("plate with a hole", pair);
}

}  // namespace
}  // namespace phongpd
