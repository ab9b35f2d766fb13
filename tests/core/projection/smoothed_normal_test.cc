// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: adaptive quadrature over slices of the triangles, and closed forms of
// half-space, slab, wedge, corner and ball.
#include "core/projection/smoothed_normal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/unit_normal.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// ∫ w dA along the segment from a to b, each point weighted alike: within the
// ball w is a polynomial of degree 4.
double SliceIntegral(const Vector3d& a, const Vector3d& b) {
  const Vector3d e = b - a;
  const double ee = e.squaredNorm(), ae = a.dot(e);
  const double root = ae * ae - ee * (a.squaredNorm() - 1.0);
  if (root <= 0.0 || ee == 0.0) return 0.0;
  const double from = std::max(0.0, (-ae - std::sqrt(root)) / ee);
  const double to = std::min(1.0, (-ae + std::sqrt(root)) / ee);
  if (from >= to) return 0.0;
  return boost::math::quadrature::gauss<double, 7>::integrate(
      [&](double v) {
        const double w = 1.0 - (a + v * e).squaredNorm();
        return w * w;
      },
      from, to);
}

// G_ρ(x)/ρ².
Vector3d ByQuadrature(const TriangleMesh& mesh, const Vector3d& x, double rho) {
  Vector3d sum = Vector3d::Zero();
  for (const Triangle& t : mesh.triangles) {
    std::array<Vector3d, 3> c;
    for (std::size_t i = 0; i < 3; ++i) {
      c[i] = (mesh.vertices[t[i]] - x) / rho;
    }
    // 2 area s ds dv: s from corner 0 to the edge across, v along the slice.
    const Vector3d cross = (c[1] - c[0]).cross(c[2] - c[0]);
    const auto slice = [&](double s) {
      return s *
             SliceIntegral(c[0] + s * (c[1] - c[0]), c[0] + s * (c[2] - c[0]));
    };
    // In parts: where the ball is entered within one, it shows.
    double value = 0.0;
    for (int i = 0; i < 8; ++i) {
      value += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
          slice, i / 8.0, (i + 1) / 8.0, 12, 1e-12);
    }
    sum += value * cross;
  }
  return sum;
}

Vector3d RandomDirection(std::mt19937* engine) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(*engine), normal(*engine), normal(*engine))
      .normalized();
}

Vector3d RandomPoint(const TriangleMesh& mesh, std::mt19937* engine) {
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  const BoundingBox box = ComputeBounds(mesh);
  return box.min +
         Vector3d(uniform(*engine), uniform(*engine), uniform(*engine))
             .cwiseProduct(box.max - box.min);
}

// Each triangle in three at a point of it, or in two at a point of an edge:
// the same surface.
TriangleMesh Split(const TriangleMesh& mesh, double lambda) {
  TriangleMesh out = mesh;
  out.triangles.clear();
  for (const Triangle& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                   &c = mesh.vertices[t[2]];
    out.vertices.push_back((1.0 - 1.5 * lambda) * a + lambda * b +
                           0.5 * lambda * c);
    const int v = static_cast<int>(out.vertices.size()) - 1;
    for (int i = 0; i < 3; ++i) {
      out.triangles.push_back({t[i], t[(i + 1) % 3], v});
    }
  }
  return out;
}

SmoothedNormals Make(const TriangleMesh& mesh, double rho) {
  return SmoothedNormals(TakeAsContactSpace(mesh), rho);
}

TEST(SmoothedNormal, AgreesWithQuadrature) {
  std::mt19937 engine(1);
  for (const TriangleMesh& mesh :
       {MakeBox({-1, -2, -3}, {1, 2, 3}), MakeU(2.0, 0.25, 0.5),
        Rotated(MakeStar(1.0, 1.5), GenericRotation()), MakeIcoBall(1.0, 2),
        MakeCone(0.5, 3.0, 24)}) {
    const double diagonal = ComputeBounds(mesh).Diagonal();
    int known = 0;
    for (const double share : {0.02, 0.1, 0.4, 1.0, 3.0}) {
      const SmoothedNormals normals = Make(mesh, share * diagonal);
      for (int i = 0; i < 8; ++i) {
        const Vector3d x = RandomPoint(mesh, &engine);
        const SmoothedNormal found = normals.At(x);
        const Vector3d truth = ByQuadrature(mesh, x, share * diagonal);
        EXPECT_LT((found.integral - truth).norm(), 2e-13)
            << share << ' ' << x.transpose();
        known += found.HasDirection() ? 1 : 0;
        EXPECT_EQ(found.Direction().norm() > 0.0, found.HasDirection());
        if (found.HasDirection() && truth.norm() > 1e-6) {
          EXPECT_LT((found.Direction() - truth.normalized()).norm(), 1e-6);
        }
      }
    }
    EXPECT_GT(known, 10);
  }
}

TEST(SmoothedNormal, AgreesWithQuadratureOnVerticesEdgesAndPlanes) {
  for (const TriangleMesh& mesh : {MakeBox({0, 0, 0}, {1, 1, 1}),
                                   MakeStar(1.0, 1.5), MakeIcoBall(1.0, 1)}) {
    const double rho = 0.7;
    const SmoothedNormals normals = Make(mesh, rho);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const Triangle& t = mesh.triangles[i];
      const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                     &c = mesh.vertices[t[2]];
      for (const Vector3d& x :
           {a, Vector3d(0.5 * (a + b)), Vector3d((a + b + c) / 3.0),
            Vector3d(2.0 * a - b),
            Vector3d(a + 0.3 * (a - b) + 0.4 * (a - c))}) {
        EXPECT_LT((normals.At(x).integral - ByQuadrature(mesh, x, rho)).norm(),
                  2e-13);
      }
    }
  }
}

TEST(SmoothedNormal, IsTheClosedFormOfHalfSpaceSlabWedgeAndCorner) {
  const double rho = 0.5;
  // Within ρ of the origin: the half-space z < 0 (its other faces are far).
  const SmoothedNormals half = Make(MakeBox({-3, -3, -4}, {3, 3, 0}), rho);
  for (const double h : {0.0, 1e-9, 0.1, 0.25, 0.49, 0.499999}) {
    const double r = h / rho;
    const double truth = kPi / 3.0 * std::pow(1.0 - r * r, 3);
    for (const double z : {-h, h}) {
      const SmoothedNormal found = half.At({0.2, -0.1, z});
      EXPECT_LT((found.integral - truth * Vector3d::UnitZ()).norm(), 1e-15);
      EXPECT_EQ(found.Direction(), Vector3d::UnitZ());
    }
  }
  // Between 0 and −0.3.
  const SmoothedNormals slab = Make(MakeBox({-3, -3, -0.3}, {3, 3, 0}), rho);
  for (const double z : {-0.02, -0.1, -0.149, -0.151, -0.25}) {
    const double up = z / rho, down = (z + 0.3) / rho;
    const double truth =
        kPi / 3.0 *
        (std::pow(1.0 - up * up, 3) - std::pow(1.0 - down * down, 3));
    EXPECT_LT(
        (slab.At({0.3, 0.1, z}).integral - truth * Vector3d::UnitZ()).norm(),
        1e-15);
  }
  EXPECT_FALSE(slab.At({0.3, 0.1, -0.15}).HasDirection());
  // On the edge of two half-planes: half a disc of each; on a corner, a
  // quarter of three.
  const SmoothedNormals box = Make(MakeBox({-3, -3, -4}, {0, 3, 0}), rho);
  EXPECT_LT(
      (box.At({0, 0.5, 0}).integral - kPi / 6.0 * Vector3d(1, 0, 1)).norm(),
      1e-15);
  EXPECT_LT(
      (box.At({0, 3, 0}).integral - kPi / 12.0 * Vector3d(1, 1, 1)).norm(),
      1e-15);
  // A prism's edge between sides that turn by 2π/5.
  const SmoothedNormals prism = Make(MakePrism(2.0, 8.0, 5), rho);
  const TriangleMesh mesh = MakePrism(2.0, 8.0, 5);
  const Vector3d edge(
      mesh.vertices[0].x(), mesh.vertices[0].y(),
      0.5 * (ComputeBounds(mesh).min.z() + ComputeBounds(mesh).max.z()));
  EXPECT_NEAR(prism.At(edge).integral.norm(),
              kPi / 6.0 * 2.0 * std::cos(kPi / 5.0), 1e-14);
}

// With α = 1 − (a² + c²)/ρ² and β = 2ac/ρ² at the distance c from the centre
// of a ball of radius a, all of it within ρ: G = 8π/3 a² α β.
TEST(SmoothedNormal, ConvergesToTheClosedFormOfABall) {
  const double rho = 3.0;
  double before = 0.0;
  for (int level = 2; level <= 4; ++level) {
    const SmoothedNormals normals = Make(MakeIcoBall(1.0, level), rho);
    double worst = 0.0;
    std::mt19937 same(3);
    for (int i = 0; i < 20; ++i) {
      const Vector3d out = RandomDirection(&same);
      const double c = 0.1 + 0.04 * i;
      const double alpha = 1.0 - (1.0 + c * c) / (rho * rho);
      const double beta = 2.0 * c / (rho * rho);
      const Vector3d truth = 8.0 * kPi / 3.0 * alpha * beta / (rho * rho) * out;
      worst = std::max(
          worst, (normals.At(c * out).integral - truth).norm() / truth.norm());
    }
    EXPECT_LT(worst, 0.6 * std::pow(0.25, level));
    if (level > 2) {
      EXPECT_NEAR(worst / before, 0.25, 0.02);
    }
    before = worst;
  }
}

TEST(SmoothedNormal, IsZeroWhereNothingIsWithinTheRadius) {
  const SmoothedNormals normals = Make(MakeBox({-1, -1, -1}, {1, 1, 1}), 0.5);
  for (const Vector3d& x :
       {Vector3d(0, 0, 0), Vector3d(0.5, 0.5, -0.5), Vector3d(1.5, 0, 0),
        Vector3d(9, 9, 9), Vector3d(1e300, -1e300, 0)}) {
    const SmoothedNormal found = normals.At(x);
    EXPECT_EQ(found.integral, Vector3d::Zero());
    EXPECT_FALSE(found.HasDirection());
    EXPECT_EQ(found.Direction(), Vector3d::Zero());
  }
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {infinity, std::nan("")}) {
    EXPECT_EQ(normals.At({bad, 0, 0}).integral, Vector3d::Zero());
  }
}

TEST(SmoothedNormal, SaysWhereSymmetryLeavesNoDirection) {
  for (const TriangleMesh& mesh :
       {MakeBox({-1, -1, -1}, {1, 1, 1}), MakeIcoBall(1.0, 3)}) {
    for (const double rho : {1.1, 2.0, 20.0}) {
      const SmoothedNormals normals = Make(mesh, rho);
      EXPECT_FALSE(normals.At(Vector3d::Zero()).HasDirection()) << rho;
      EXPECT_TRUE(normals.At({1e-3, 0, 0}).HasDirection()) << rho;
      EXPECT_LT(
          (normals.At({1e-3, 0, 0}).Direction() - Vector3d::UnitX()).norm(),
          0.02);
    }
  }
}

TEST(SmoothedNormal, DoesNotDependOnHowTheSurfaceIsCut) {
  std::mt19937 engine(4);
  const TriangleMesh mesh =
      Rotated(MakeBox({0, 0, 0}, {1, 2, 3}), GenericRotation());
  // The last leave slivers down to what coordinates round to.
  for (const double lambda : {0.4, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const TriangleMesh cut = Split(mesh, lambda);
    const TriangleMesh twice = Split(cut, 0.3);
    for (const double rho : {0.3, 1.0, 5.0}) {
      const SmoothedNormals whole = Make(mesh, rho), parts = Make(cut, rho),
                            more = Make(twice, rho);
      for (int i = 0; i < 60; ++i) {
        const Vector3d x = i < 40
                               ? RandomPoint(mesh, &engine)
                               : cut.vertices[static_cast<std::size_t>(i % 20)];
        const SmoothedNormal truth = whole.At(x);
        for (const SmoothedNormals* other : {&parts, &more}) {
          const SmoothedNormal found = other->At(x);
          const double error = (found.integral - truth.integral).norm();
          EXPECT_LT(error, 2e-14 / rho);
          // It knows how well, but for the rounding of the new corners.
          EXPECT_LE(error,
                    (1.0 + 3.0 / rho) * (truth.rounding + found.rounding));
        }
      }
    }
  }
}

TEST(SmoothedNormal, MovesTurnsAndScalesWithTheShape) {
  std::mt19937 engine(5);
  const TriangleMesh mesh = MakeWrench();
  const double rho = 0.2 * ComputeBounds(mesh).Diagonal();
  const SmoothedNormals normals = Make(mesh, rho);
  const Eigen::Matrix3d turn = GenericRotation();
  const SmoothedNormals turned = Make(Rotated(mesh, turn), rho);
  const auto mapped = [&](double scale, const Vector3d& by) {
    TriangleMesh out = mesh;
    for (Vector3d& v : out.vertices) v = scale * v + by;
    return out;
  };
  const Vector3d by(1e6, -3e5, 7e5);
  const SmoothedNormals moved = Make(mapped(1.0, by), rho);
  const double large = std::ldexp(1.0, 300), small = std::ldexp(1.0, -300);
  const SmoothedNormals up = Make(mapped(large, {0, 0, 0}), large * rho),
                        down = Make(mapped(small, {0, 0, 0}), small * rho);
  for (int i = 0; i < 200; ++i) {
    const Vector3d x = RandomPoint(mesh, &engine);
    const SmoothedNormal found = normals.At(x);
    EXPECT_LT((turned.At(turn * x).integral - turn * found.integral).norm(),
              1e-13);
    // Coordinates of 1e6 round to 1e-10.
    EXPECT_LT((moved.At(x + by).integral - found.integral).norm(), 1e-7);
    EXPECT_EQ(up.At(large * x).integral, found.integral);
    EXPECT_EQ(down.At(small * x).integral, found.integral);
  }
}

// |∇w| ≤ 16/(5√5 ρ), so G/ρ² changes by at most 1.44·A/ρ² per step of ρ, A the
// area within reach; no plane, edge or vertex on the way shows.
TEST(SmoothedNormal, IsContinuousAcrossPlanesEdgesAndVertices) {
  std::mt19937 engine(6);
  for (const TriangleMesh& mesh : {MakeBox({0, 0, 0}, {1, 1, 1}),
                                   MakeStar(1.0, 1.5), MakeU(2, 0.25, 0.5)}) {
    const double rho = 0.6;
    const SmoothedNormals normals = Make(mesh, rho);
    for (int i = 0; i < 300; ++i) {
      const Triangle& t =
          mesh.triangles[static_cast<std::size_t>(i) % mesh.triangles.size()];
      const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                     &c = mesh.vertices[t[2]];
      const Vector3d at = i % 3 == 0   ? a
                          : i % 3 == 1 ? Vector3d(0.7 * a + 0.3 * b)
                                       : Vector3d(1.5 * a - 0.2 * b - 0.3 * c);
      const Vector3d step = RandomDirection(&engine);
      for (const double size : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
        const Vector3d change = normals.At(at + size * step).integral -
                                normals.At(at - size * step).integral;
        EXPECT_LT(change.norm(), 60.0 * size + 2e-15) << i << ' ' << size;
      }
    }
  }
}

TEST(SmoothedNormal, RefusesARadiusThatIsNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double rho : {0.0, -1.0, 1e-12, infinity, std::nan("")}) {
    EXPECT_THROW(Make(MakeBox({0, 0, 0}, {1, 1, 1}), rho), InputError);
  }
  // Of any other the sum is a number.
  for (const double rho : {1e-8, 1e3, 1e150, 1e300}) {
    const SmoothedNormal found =
        Make(MakeBox({0, 0, 0}, {1, 1, 1}), rho).At({0.5, 0.4, 1.0});
    EXPECT_TRUE(std::isfinite(found.integral.norm())) << rho;
    if (rho < 1.0) {
      EXPECT_EQ(found.Direction(), Vector3d::UnitZ());
    }
  }
}

}  // namespace
}  // namespace phongpd
