// SPDX-License-Identifier: GPL-3.0-or-later
// A contact space moves with its operands: the same topology whatever their
// scale, place, axes, order and, on lattices, integer linear map; the same
// points, exactly where the input is exact.  The campaign's item "invariance".
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/moved_spaces.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Random = std::mt19937_64;
using testing::CampaignCases;
using testing::CampaignRow;
using testing::LatticePair;
using testing::MakeMovedPair;
using testing::Mapped;
using testing::MovedPair;
using testing::MovedSpaceJudge;
using testing::RandomIntegerMap;
using testing::ReportCampaign;
using testing::SpaceOf;

// What rounding to the grid may move a surface by, over its diagonal: half a
// step in each coordinate of both operands, and more beside narrow edges.
constexpr double kGrid = 16 * 0x1p-38;

std::uint64_t Cases(long brief, long whole) {
  return static_cast<std::uint64_t>(CampaignCases(brief, whole));
}

int Uniform(int min, int max, Random* random) {
  return std::uniform_int_distribution<int>(min, max)(*random);
}

double Length(const ContactSpace& space) {
  return ComputeBounds(space.mesh()).Diagonal();
}

bool AreSame(const ContactSpace& space, const ContactSpace& scaled, int k) {
  const double factor = std::ldexp(1.0, k);
  return scaled.mesh().triangles == space.mesh().triangles &&
         scaled.plane() == space.plane() && scaled.kind() == space.kind() &&
         std::equal(space.mesh().vertices.begin(), space.mesh().vertices.end(),
                    scaled.mesh().vertices.begin(),
                    scaled.mesh().vertices.end(),
                    [factor](const Vector3d& p, const Vector3d& q) {
                      return factor * p == q;
                    });
}

TEST(InvarianceCampaign, PowersOfTwoChangeNoBit) {
  CampaignRow row;
  row.item = "invariance";
  row.subject = "2^k, k = -100 ... 100, bit for bit, queries too";
  const long step = CampaignCases(50, 1);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const MovedPair pair = MakeMovedPair(seed);
    const ContactSpace space = SpaceOf(pair);
    const Vector3d q = 0.1 * ComputeBounds(space.mesh()).max;
    const auto depth = EuclideanMetric(space).Query(q).signed_distance;
    for (long k = -100; k <= 100; k += step) {
      const double factor = std::ldexp(1.0, static_cast<int>(k));
      const ContactSpace scaled =
          SpaceOf({Scaled(pair.robot, factor), Scaled(pair.obstacle, factor)});
      const bool same =
          AreSame(space, scaled, static_cast<int>(k)) &&
          EuclideanMetric(scaled).Query(factor * q).signed_distance ==
              factor * depth;
      EXPECT_TRUE(same) << "seed " << seed << ", 2^" << k;
      ++row.cases;
      row.failures += !same;
    }
  }
  ReportCampaign(row);
}

TEST(InvarianceCampaign, PowersOfTenKeepTopologyAndPoints) {
  MovedSpaceJudge judge("10^k, k = -9 ... 9", 1e-15, kGrid);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    const MovedPair pair = MakeMovedPair(seed);
    const ContactSpace space = SpaceOf(pair);
    for (int k = -9; k <= 9; k += static_cast<int>(CampaignCases(6, 1))) {
      const double factor = std::pow(10.0, std::abs(k));
      const auto scale = [&](const Vector3d& p) -> Vector3d {
        return k < 0 ? Vector3d(p / factor) : Vector3d(p * factor);
      };
      MovedPair scaled = pair;
      for (TriangleMesh* mesh : {&scaled.robot, &scaled.obstacle}) {
        for (Vector3d& v : mesh->vertices) v = scale(v);
      }
      const ContactSpace other = SpaceOf(scaled);
      judge.Compare(
          space, other, scale, Length(other),
          "seed " + std::to_string(seed) + ", 10^" + std::to_string(k));
    }
  }
}

// By 1 … 10^6 diagonals in any direction: whole numbers, and what rounds.
TEST(InvarianceCampaign, OffsetsKeepTopologyAndPoints) {
  MovedSpaceJudge judge("offsets to 10^6 L", 1e-9, 1e-9);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    const MovedPair pair = MakeMovedPair(seed);
    const ContactSpace space = SpaceOf(pair);
    const double length = ComputeBounds(pair.obstacle).Diagonal();
    Random random(seed);
    for (int k = 0; k <= 6; k += static_cast<int>(CampaignCases(3, 1))) {
      const double far = std::pow(10.0, k) * length;
      Vector3d a = far * RandomRotation(&random).col(0);
      Vector3d b = far * RandomRotation(&random).col(0);
      if (k % 2 == 0) a = a.array().round(), b = b.array().round();
      const ContactSpace moved =
          SpaceOf({Translated(pair.robot, a), Translated(pair.obstacle, b)});
      judge.Compare(
          space, moved, [&](const Vector3d& p) { return Vector3d(p + b - a); },
          length,
          "seed " + std::to_string(seed) + ", 10^" + std::to_string(k) + " L");
    }
  }
}

TEST(InvarianceCampaign, PermutedAndMirroredAxesGiveTheSamePoints) {
  MovedSpaceJudge judge(
      "48 signed permutations, swapped operands, shuffled meshes", 0.0, kGrid);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    const MovedPair pair = MakeMovedPair(seed);
    const ContactSpace space = SpaceOf(pair);
    const std::string name = "seed " + std::to_string(seed);
    const double length = Length(space);
    std::array<int, 3> axes = {0, 1, 2};
    std::uint64_t number = 0;
    do {
      for (int signs = 0; signs < 8; ++signs) {
        if ((number++ + seed) % Cases(13, 3) != 0) continue;
        Matrix3d map = Matrix3d::Zero();
        for (int k = 0; k < 3; ++k) {
          map(k, axes[k]) = (signs >> k & 1) != 0 ? -1 : 1;
        }
        judge.Compare(
            space,
            SpaceOf({Mapped(pair.robot, map), Mapped(pair.obstacle, map)}),
            [&](const Vector3d& p) { return Vector3d(map * p); }, length,
            name + ", signed permutation " + std::to_string(number));
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
    judge.Compare(
        space, SpaceOf({pair.obstacle, pair.robot}),
        [](const Vector3d& p) { return Vector3d(-p); }, length,
        name + ", swapped");
    MovedPair shuffled = pair;
    Random random(seed);
    for (TriangleMesh* mesh : {&shuffled.robot, &shuffled.obstacle}) {
      std::vector<int> place(mesh->vertices.size());
      std::iota(place.begin(), place.end(), 0);
      std::shuffle(place.begin(), place.end(), random);
      const std::vector<Vector3d> vertices = mesh->vertices;
      for (std::size_t v = 0; v < place.size(); ++v) {
        mesh->vertices[place[v]] = vertices[v];
      }
      for (Triangle& t : mesh->triangles)
        t = {place[t[1]], place[t[2]], place[t[0]]};
      std::shuffle(mesh->triangles.begin(), mesh->triangles.end(), random);
    }
    judge.Compare(
        space, SpaceOf(shuffled), [](const Vector3d& p) { return p; }, length,
        name + ", shuffled");
  }
}

// Everything is a lattice point, so nothing may be off by anything.
TEST(InvarianceCampaign, IntegerMapsAreExact) {
  MovedSpaceJudge judge("integer maps and offsets of voxel solids", 0.0, 0.0);
  for (std::uint64_t seed = 0; seed < Cases(40, 2000); ++seed) {
    Random random(seed);
    const MovedPair pair = LatticePair(&random);
    const Matrix3d map = RandomIntegerMap(seed % 2 == 0, &random);
    const auto offset = [&] {
      return Vector3d(Uniform(-9999999, 9999999, &random),
                      Uniform(-9999999, 9999999, &random), 0);
    };
    const Vector3d a = offset(), b = offset();
    const ContactSpace space = SpaceOf(pair);
    const ContactSpace other =
        SpaceOf({Mapped(pair.robot, map, a), Mapped(pair.obstacle, map, b)});
    const std::string name = "seed " + std::to_string(seed);
    judge.Compare(
        space, other,
        [&](const Vector3d& p) { return Vector3d(map * p + b - a); }, 1.0,
        name);
    EXPECT_EQ(other.report().grid_step, 0.0) << name;
    EXPECT_EQ(other.report().self_intersections,
              space.report().self_intersections)
        << name;
    EXPECT_NEAR(other.report().volume,
                space.report().volume * std::abs(map.determinant()),
                1e-9 * other.report().volume)
        << name;
  }
}

// Modelled along axes, turned together and then moved: what rounding makes of
// their coordinates is taken back by the frame.  Beyond 10^5 L the directions
// of facets scatter by more than the frame calls one direction.
TEST(InvarianceCampaign, TurnedAndMovedSolidsKeepTopology) {
  MovedSpaceJudge judge("turned alike, offsets to 10^5 L", 1e-9, 1e-9);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    Random random(seed);
    MovedPair pair = LatticePair(&random);
    if (seed % 3 == 1) {
      pair = {MakePrism(0.48, 2, 16), MakePlateWithRoundHole(4, 1, 0.5, 16)};
    } else if (seed % 3 == 2) {
      pair = {MakeL(0.4, 0.15, 0.3), MakeWrench(1.0, 6, 8, 5, 5)};
    }
    const ContactSpace space = SpaceOf(pair);
    const double length = ComputeBounds(pair.obstacle).Diagonal();
    const Matrix3d turn = RandomRotation(&random);
    for (int k = 0; k <= 5; k += static_cast<int>(CampaignCases(3, 1))) {
      const double far = std::pow(10.0, k) * length;
      const Vector3d a = far * RandomRotation(&random).col(0);
      const Vector3d b = far * RandomRotation(&random).col(0);
      const ContactSpace moved = SpaceOf(
          {Mapped(pair.robot, turn, a), Mapped(pair.obstacle, turn, b)});
      judge.Compare(
          space, moved,
          [&](const Vector3d& p) { return Vector3d(turn * p + b - a); }, length,
          "seed " + std::to_string(seed) + ", 10^" + std::to_string(k) + " L");
    }
  }
}

}  // namespace
}  // namespace phongpd
