// SPDX-License-Identifier: GPL-3.0-or-later
// Which of all projections a cold query returns.  Truth: every triangle of the
// field tried over the whole range of s, and the rule for ties applied to what
// they give.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/projection/normal_field.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Of the rule for ties, field frame (prism_search.h).
constexpr double kTie = 1e-13;
constexpr double kSame = 1e-9;
// Where triangles collapse to a point, as on the axis of a torus, s is a triple
// root: known to the cube root of rounding, and so is the depth.
constexpr double kFolded = 1e-4;  // |det J| / |e₁||e₂| from which it is simple
constexpr double kFoldedDepth = 1e-5;

struct Candidate {
  double depth;
  Vector3d contact;
  bool folded;
};

// Field frame, ascending in depth.
std::vector<Candidate> TryAllTriangles(const std::vector<OffsetPrism>& prisms,
                                       const Vector3d& x) {
  std::vector<Candidate> all;
  std::array<NormalHit, 3> hits;
  for (const OffsetPrism& prism : prisms) {
    const int count = prism.Project(x, -4.0, 1e-13, &hits);
    for (int i = 0; i < count; ++i) {
      const double det = prism.Jacobian(hits[i]).determinant();
      all.push_back(
          {std::max(0.0, -prism.SignedDepth(hits[i])),
           prism.Point(hits[i].lambda),
           std::abs(det) < kFolded * prism.e1.norm() * prism.e2.norm()});
    }
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.depth < b.depth; });
  return all;
}

bool ComesFirst(const Vector3d& a, const Vector3d& b) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(a[i] - b[i]) > kSame) return a[i] < b[i];
  }
  return false;
}

// What a cold query at q must give: the least depth, and of the contacts that
// tie for it the first; any of those whose depths are too close to call.
void ExpectLeast(const PhongMetric& metric,
                 const std::vector<OffsetPrism>& prisms, const Vector3d& q) {
  const PhongField& field = metric.field();
  const PenetrationResult result = metric.Query(q);
  ASSERT_TRUE(result.inside);
  const std::vector<Candidate> all = TryAllTriangles(prisms, field.ToField(q));
  ASSERT_EQ(result.status == QueryStatus::kEuclideanFallback, all.empty());
  if (all.empty()) return;
  const double least = all.front().depth;
  const bool folded =
      std::any_of(all.begin(), all.end(), [&](const Candidate& candidate) {
        return candidate.folded && candidate.depth < least + kFoldedDepth;
      });
  EXPECT_NEAR(-result.signed_distance * field.scale, least,
              folded ? kFoldedDepth : 1e-12);
  if (folded) return;
  const Vector3d contact = field.ToField(result.contact);
  const Candidate* first = &all.front();
  bool close_call = false;
  bool among = false;
  for (const Candidate& candidate : all) {
    const double behind = candidate.depth - least;
    if (behind > 1e-12) break;
    among = among || (candidate.contact - contact).norm() < 2.0 * kSame;
    if (behind > 0.1 * kTie) close_call = true;
    if (ComesFirst(candidate.contact, first->contact)) first = &candidate;
  }
  EXPECT_TRUE(among);
  if (!close_call) {
    EXPECT_LT((first->contact - contact).norm(), 2.0 * kSame);
  }
}

// Points where the search has an easy and a hard time: anywhere, just below
// the surface, and where everything ties.
std::vector<Vector3d> Points(const PhongMetric& metric,
                             const TriangleMesh& mesh, int count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const BoundingBox box = ComputeBounds(mesh);
  const double diagonal = box.Diagonal();
  std::vector<Vector3d> points;
  const auto offer = [&](const Vector3d& q) {
    if (metric.IsInside(q)) points.push_back(q);
  };
  for (int i = 0; i < 6 * count; ++i) {
    const Vector3d u(uniform(engine), uniform(engine), uniform(engine));
    offer(box.min + u.cwiseProduct(box.max - box.min));
  }
  if (static_cast<int>(points.size()) > count) {
    points.resize(static_cast<std::size_t>(count));
  }
  const double below[] = {1e-3, 1e-6, 1e-9, 1e-12, 1e-15};
  for (int i = 0; i < count; ++i) {
    const std::size_t pick = engine() % mesh.triangles.size();
    const auto& [a, b, c] = mesh.triangles[pick];
    double l1 = uniform(engine), l2 = (1.0 - l1) * uniform(engine);
    if (i % 3 == 0) l2 = 0.0;       // an edge
    if (i % 5 == 0) l1 = l2 = 0.0;  // a vertex
    const Vector3d e1 = mesh.vertices[b] - mesh.vertices[a];
    const Vector3d e2 = mesh.vertices[c] - mesh.vertices[a];
    const Vector3d normal = e1.cross(e2).normalized();
    offer(mesh.vertices[a] + l1 * e1 + l2 * e2 -
          below[i % 5] * diagonal * normal);
  }
  for (int i = 0; i < 27; ++i) {  // middle and axes
    const Vector3d u(i % 3, i / 3 % 3, i / 9);
    offer(box.Center() +
          0.1 * (u - Vector3d::Ones()).cwiseProduct(box.max - box.min));
  }
  return points;
}

void ExpectLeastEverywhere(const TriangleMesh& mesh, int count) {
  for (const double ell : {0.0, 0.1, 0.2}) {
    SCOPED_TRACE("smoothing length " + std::to_string(ell));
    PhongMetricOptions options;
    options.field_options.smoothing_length = ell;
    const PhongMetric metric(TakeAsContactSpace(mesh), options);
    const std::vector<OffsetPrism> prisms = BuildOffsetPrisms(metric.field());
    const std::vector<Vector3d> points = Points(metric, mesh, count);
    ASSERT_GT(points.size(), static_cast<std::size_t>(count) / 4);
    for (const Vector3d& q : points) {
      ASSERT_NO_FATAL_FAILURE(ExpectLeast(metric, prisms, q));
    }
  }
}

TEST(ColdSearch, FindsTheLeastOfAllTrianglesOnRoundAndBranchedSolids) {
  ExpectLeastEverywhere(MakeBlob(1.5, 3, 0.35, 1), 150);
  ExpectLeastEverywhere(MakeTorus(1.0, 0.35, 40, 16), 150);
  ExpectLeastEverywhere(MakeKnot(0.5, 0.2, 48, 8), 60);
  ExpectLeastEverywhere(MakeStar(0.2, 0.4), 150);
}

TEST(ColdSearch, FindsTheLeastOfAllTrianglesOnFlatFacetsAndThinWalls) {
  ExpectLeastEverywhere(MakeL(2.0, 0.7, 0.6), 150);
  ExpectLeastEverywhere(Rotated(MakeU(2.0, 0.4, 0.6), GenericRotation()), 150);
  ExpectLeastEverywhere(MakeWrench(), 60);
  ExpectLeastEverywhere(MakeVessel(2.0, 1.9, 0.5), 150);
  ExpectLeastEverywhere(MakeBox({-1.0, -1.0, -1e-3}, {1.0, 1.0, 1e-3}), 150);
  ExpectLeastEverywhere(MakeBox({-1e-4, -1.0, -1e-4}, {1e-4, 1.0, 1e-4}), 150);
}

// A robot and an obstacle: slivers, many triangles in one plane.
TEST(ColdSearch, FindsTheLeastOfAllTrianglesOnContactSpaces) {
  const TriangleMesh cube =
      MakeBox(Vector3d::Constant(-0.2), Vector3d::Constant(0.2));
  ExpectLeastEverywhere(
      BuildContactSpace(Rotated(cube, GenericRotation()), MakeL(2.0, 0.5, 0.6))
          .mesh(),
      100);
  ExpectLeastEverywhere(
      BuildContactSpace(MakeCone(0.3, 0.7, 24), MakeAxes(1.0, 0.1)).mesh(), 60);
}

// The centre of a ball and the middle planes of a cube, where as many tie as
// can be.
TEST(ColdSearch, OfTiesTheFirstContactWins) {
  ExpectLeastEverywhere(MakeIcoBall(1.0, 3), 60);
  ExpectLeastEverywhere(
      MakeBox(Vector3d::Constant(-1.0), Vector3d::Constant(1.0)), 100);
  const PhongMetric metric = testing::UnsmoothedPhong(TakeAsContactSpace(
      MakeBox(Vector3d::Constant(-1.0), Vector3d::Constant(1.0))));
  const PenetrationResult middle = metric.Query(Vector3d::Zero());
  EXPECT_LT((middle.contact - Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(middle.signed_distance, -1.0, 1e-15);
}

TEST(ColdSearch, HoldsAtBothEndsOfTheScaleAndFarFromTheOrigin) {
  for (const double size : {0x1p-250, 0x1p250}) {
    TriangleMesh mesh = MakeBlob(1.5, 2, 0.35, 1);
    for (Vector3d& v : mesh.vertices) v *= size;
    ExpectLeastEverywhere(mesh, 60);
  }
  TriangleMesh mesh = MakeBlob(1.5, 2, 0.35, 1);
  for (Vector3d& v : mesh.vertices) v += Vector3d(3e6, -1e6, 2e6);
  ExpectLeastEverywhere(mesh, 60);
}

// One end of the tree is a millionth of the other.
TEST(ColdSearch, FindsTheLeastWhereTrianglesDifferByAMillion) {
  TriangleMesh mesh = MakeTorus(1.0, 0.35, 40, 16);
  for (Vector3d& v : mesh.vertices) {
    v.x() = std::copysign(std::pow(std::abs(v.x()) / 1.4, 5.0) * 1.4, v.x());
  }
  ExpectLeastEverywhere(mesh, 100);
}

}  // namespace
}  // namespace phongpd
