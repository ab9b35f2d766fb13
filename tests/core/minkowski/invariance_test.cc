// SPDX-License-Identifier: GPL-3.0-or-later
// A contact space moves with its operands: the same topology whatever their
// scale, place, axes, order and, on lattices, integer linear map; the same
// points, exactly where the input is exact.  The campaign's item "invariance".
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <set>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Random = std::mt19937_64;
using testing::CampaignCases;

// What rounding to the grid may move a surface by, over its diagonal: half a
// step in each coordinate of both operands, and more beside narrow edges.
constexpr double kGrid = 16 * 0x1p-38;

struct Pair {
  TriangleMesh robot, obstacle;
};

std::uint64_t Cases(long brief, long whole) {
  return static_cast<std::uint64_t>(CampaignCases(brief, whole));
}

int Uniform(int min, int max, Random* random) {
  return std::uniform_int_distribution<int>(min, max)(*random);
}

// x ↦ map·x + offset; turned over when the map mirrors.
TriangleMesh Mapped(TriangleMesh mesh, const Matrix3d& map,
                    const Vector3d& offset = Vector3d::Zero()) {
  for (Vector3d& v : mesh.vertices) v = map * v + offset;
  return map.determinant() < 0 ? Reversed(mesh) : mesh;
}

// Entries in −2 … 2; of determinant ±1 if asked for.
Matrix3d IntegerMap(bool is_unimodular, Random* random) {
  for (;;) {
    Matrix3d map;
    for (int i = 0; i < 9; ++i) map(i / 3, i % 3) = Uniform(-2, 2, random);
    const long det = std::lround(map.determinant());
    if (det != 0 && (!is_unimodular || std::abs(det) == 1)) return map;
  }
}

Pair VoxelPair(Random* random) {
  return {RandomVoxelSolid(2, 0.5, random), RandomVoxelSolid(3, 0.5, random)};
}

// The shapes of the campaign in turn.
Pair MakePair(std::uint64_t seed) {
  Random random(seed);
  Pair pair = VoxelPair(&random);
  switch (seed % 6) {
    case 0:
      break;
    case 1: {
      const Matrix3d map = IntegerMap(false, &random);
      pair.robot = Mapped(pair.robot, map);
      pair.obstacle = Mapped(pair.obstacle, map);
      break;
    }
    case 2:  // tenths as people write them
      for (TriangleMesh* mesh : {&pair.robot, &pair.obstacle}) {
        for (Vector3d& v : mesh->vertices) v /= 10.0;
      }
      break;
    case 3:
      return {MakeCone(0.8, 1.6, Uniform(5, 24, &random)), MakeAxes(2, 0.2)};
    case 4:
      return {MakeStar(0.5, 1.2),
              Rotated(MakeTorus(2, 0.6, 9, 6), RandomRotation(&random))};
    default:
      return {MakeL(0.4, 0.15, 0.3), MakeWrench(1.0, 6, 8, 5, 5)};
  }
  return pair;
}

ContactSpace Build(const Pair& pair) {
  return BuildContactSpace(pair.robot, pair.obstacle);
}

// Vertices where three planes or more meet: those on a straight edge depend on
// how it was cut.
std::vector<Vector3d> CornersOf(const ContactSpace& space) {
  std::vector<std::set<int>> planes(space.mesh().vertices.size());
  for (std::size_t t = 0; t < space.mesh().triangles.size(); ++t) {
    for (const int v : space.mesh().triangles[t])
      planes[v].insert(space.plane()[t]);
  }
  std::vector<Vector3d> corners;
  for (std::size_t v = 0; v < planes.size(); ++v) {
    if (planes[v].size() > 2) corners.push_back(space.mesh().vertices[v]);
  }
  return corners;
}

// Largest distance of a point to the nearest of the others, both ways.
double Apart(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double worst = 0.0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Vector3d& p : *from) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& q : *to) {
        nearest = std::min(nearest, (p - q).lpNorm<Eigen::Infinity>());
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

bool IsFinite(const ContactSpace& space) {
  return std::all_of(space.mesh().vertices.begin(), space.mesh().vertices.end(),
                     [](const Vector3d& v) { return v.allFinite(); }) &&
         std::isfinite(space.report().volume);
}

using PointMap = std::function<Vector3d(const Vector3d&)>;

// Largest distance of a vertex to the other surface, both ways.
double SurfacesApart(const TriangleMesh& a, const TriangleMesh& b) {
  double worst = 0.0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const TriangleBvh tree(*to);
    for (const Vector3d& p : from->vertices) {
      worst = std::max(worst, tree.FindClosest(p).distance);
    }
  }
  return worst;
}

// Counts what is not as it should be, and keeps the worst displacement: of
// corners where nothing was rounded, else of the surface (a facet that
// rounding broke has corners along the break, wherever others cross it).
class Judge {
 public:
  Judge(const std::string& subject, double exact_bound, double rounded_bound) {
    for (testing::CampaignRow* row : {&exact_, &rounded_}) {
      row->item = "invariance";
      row->unit = "L";
    }
    exact_.subject = subject + ", on lattices";
    exact_.bound = exact_bound;
    rounded_.subject = subject + ", rounded";
    rounded_.bound = rounded_bound;
  }
  ~Judge() {
    for (const testing::CampaignRow* row : {&exact_, &rounded_}) {
      if (row->cases > 0) testing::ReportCampaign(*row);
    }
    EXPECT_GT(exact_.cases + rounded_.cases, 0);
  }

  // `moved` must be `space` with its points mapped; `length` is L after that.
  void Compare(const ContactSpace& space, const ContactSpace& moved,
               const PointMap& map, double length, const std::string& what) {
    const ContactSpaceReport &a = space.report(), &b = moved.report();
    const bool is_exact = a.grid_step == 0.0;
    testing::CampaignRow& row = is_exact ? exact_ : rounded_;
    double apart = 0.0;
    if (is_exact) {
      std::vector<Vector3d> corners = CornersOf(space);
      for (Vector3d& p : corners) p = map(p);
      apart = Apart(corners, CornersOf(moved)) / length;
    } else {
      TriangleMesh expected = space.mesh();
      for (Vector3d& p : expected.vertices) p = map(p);
      apart = SurfacesApart(expected, moved.mesh()) / length;
    }
    const bool is_right = b.manifold && IsFinite(moved) &&
                          b.components == a.components && b.genus == a.genus &&
                          b.cavities == a.cavities && apart <= row.bound;
    EXPECT_TRUE(is_right) << what << ": manifold " << b.manifold
                          << ", components " << a.components << " and "
                          << b.components << ", genus " << a.genus << " and "
                          << b.genus << ", cavities " << a.cavities << " and "
                          << b.cavities << ", apart by " << apart << " L";
    ++row.cases;
    row.failures += !is_right;
    row.worst = std::max(row.worst, apart);
  }

 private:
  testing::CampaignRow exact_, rounded_;
};

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
  testing::CampaignRow row;
  row.item = "invariance";
  row.subject = "2^k, k = -100 ... 100, bit for bit, queries too";
  const long step = CampaignCases(50, 1);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Pair pair = MakePair(seed);
    const ContactSpace space = Build(pair);
    const Vector3d q = 0.1 * ComputeBounds(space.mesh()).max;
    const auto depth = EuclideanMetric(space).Query(q).signed_distance;
    for (long k = -100; k <= 100; k += step) {
      const double factor = std::ldexp(1.0, static_cast<int>(k));
      const ContactSpace scaled =
          Build({Scaled(pair.robot, factor), Scaled(pair.obstacle, factor)});
      const bool same =
          AreSame(space, scaled, static_cast<int>(k)) &&
          EuclideanMetric(scaled).Query(factor * q).signed_distance ==
              factor * depth;
      EXPECT_TRUE(same) << "seed " << seed << ", 2^" << k;
      ++row.cases;
      row.failures += !same;
    }
  }
  testing::ReportCampaign(row);
}

TEST(InvarianceCampaign, PowersOfTenKeepTopologyAndPoints) {
  Judge judge("10^k, k = -9 ... 9", 1e-15, kGrid);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    const Pair pair = MakePair(seed);
    const ContactSpace space = Build(pair);
    for (int k = -9; k <= 9; k += static_cast<int>(CampaignCases(6, 1))) {
      const double factor = std::pow(10.0, std::abs(k));
      const auto scale = [&](const Vector3d& p) -> Vector3d {
        return k < 0 ? Vector3d(p / factor) : Vector3d(p * factor);
      };
      Pair scaled = pair;
      for (TriangleMesh* mesh : {&scaled.robot, &scaled.obstacle}) {
        for (Vector3d& v : mesh->vertices) v = scale(v);
      }
      const ContactSpace other = Build(scaled);
      judge.Compare(
          space, other, scale, Length(other),
          "seed " + std::to_string(seed) + ", 10^" + std::to_string(k));
    }
  }
}

// By 1 … 10^6 diagonals in any direction: whole numbers, and what rounds.
TEST(InvarianceCampaign, OffsetsKeepTopologyAndPoints) {
  Judge judge("offsets to 10^6 L", 1e-9, 1e-9);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    const Pair pair = MakePair(seed);
    const ContactSpace space = Build(pair);
    const double length = ComputeBounds(pair.obstacle).Diagonal();
    Random random(seed);
    for (int k = 0; k <= 6; k += static_cast<int>(CampaignCases(3, 1))) {
      const double far = std::pow(10.0, k) * length;
      Vector3d a = far * RandomRotation(&random).col(0);
      Vector3d b = far * RandomRotation(&random).col(0);
      if (k % 2 == 0) a = a.array().round(), b = b.array().round();
      const ContactSpace moved =
          Build({Translated(pair.robot, a), Translated(pair.obstacle, b)});
      judge.Compare(
          space, moved, [&](const Vector3d& p) { return Vector3d(p + b - a); },
          length,
          "seed " + std::to_string(seed) + ", 10^" + std::to_string(k) + " L");
    }
  }
}

TEST(InvarianceCampaign, PermutedAndMirroredAxesGiveTheSamePoints) {
  Judge judge("48 signed permutations, swapped operands, shuffled meshes", 0.0,
              kGrid);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    const Pair pair = MakePair(seed);
    const ContactSpace space = Build(pair);
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
            space, Build({Mapped(pair.robot, map), Mapped(pair.obstacle, map)}),
            [&](const Vector3d& p) { return Vector3d(map * p); }, length,
            name + ", signed permutation " + std::to_string(number));
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
    judge.Compare(
        space, Build({pair.obstacle, pair.robot}),
        [](const Vector3d& p) { return Vector3d(-p); }, length,
        name + ", swapped");
    Pair shuffled = pair;
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
        space, Build(shuffled), [](const Vector3d& p) { return p; }, length,
        name + ", shuffled");
  }
}

// Everything is a lattice point, so nothing may be off by anything.
TEST(InvarianceCampaign, IntegerMapsAreExact) {
  Judge judge("integer maps and offsets of voxel solids", 0.0, 0.0);
  for (std::uint64_t seed = 0; seed < Cases(40, 2000); ++seed) {
    Random random(seed);
    const Pair pair = VoxelPair(&random);
    const Matrix3d map = IntegerMap(seed % 2 == 0, &random);
    const auto offset = [&] {
      return Vector3d(Uniform(-9999999, 9999999, &random),
                      Uniform(-9999999, 9999999, &random), 0);
    };
    const Vector3d a = offset(), b = offset();
    const ContactSpace space = Build(pair);
    const ContactSpace other =
        Build({Mapped(pair.robot, map, a), Mapped(pair.obstacle, map, b)});
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
  Judge judge("turned alike, offsets to 10^5 L", 1e-9, 1e-9);
  for (std::uint64_t seed = 0; seed < Cases(6, 120); ++seed) {
    Random random(seed);
    Pair pair = VoxelPair(&random);
    if (seed % 3 == 1) {
      pair = {MakePrism(0.48, 2, 16), MakePlateWithRoundHole(4, 1, 0.5, 16)};
    } else if (seed % 3 == 2) {
      pair = {MakeL(0.4, 0.15, 0.3), MakeWrench(1.0, 6, 8, 5, 5)};
    }
    const ContactSpace space = Build(pair);
    const double length = ComputeBounds(pair.obstacle).Diagonal();
    const Matrix3d turn = RandomRotation(&random);
    for (int k = 0; k <= 5; k += static_cast<int>(CampaignCases(3, 1))) {
      const double far = std::pow(10.0, k) * length;
      const Vector3d a = far * RandomRotation(&random).col(0);
      const Vector3d b = far * RandomRotation(&random).col(0);
      const ContactSpace moved =
          Build({Mapped(pair.robot, turn, a), Mapped(pair.obstacle, turn, b)});
      judge.Compare(
          space, moved,
          [&](const Vector3d& p) { return Vector3d(turn * p + b - a); }, length,
          "seed " + std::to_string(seed) + ", 10^" + std::to_string(k) + " L");
    }
  }
}

}  // namespace
}  // namespace phongpd
