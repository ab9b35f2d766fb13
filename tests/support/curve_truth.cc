// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/curve_truth.h"

#include <algorithm>
#include <array>
#include <vector>

#include "tests/support/rationals.h"

namespace phongpd::testing {
namespace {

// A polynomial's Bézier coefficients.
using Bernstein = std::vector<Rational>;

RationalPoint Minus(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalPoint Cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Rational Dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalPoint Exact(const Eigen::Vector3d& p) {
  return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
}

std::array<Bernstein, 2> Halves(Bernstein p) {
  std::array<Bernstein, 2> half = {p, p};
  const std::size_t n = p.size();
  for (std::size_t left = n - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) p[i] = (p[i] + p[i + 1]) / 2;
    half[0][n - left] = p[0];
    half[1][left - 1] = p[left - 1];
  }
  return half;
}

bool AllPositive(const Bernstein& p) {
  return std::all_of(p.begin(), p.end(),
                     [](const Rational& x) { return x > 0; });
}

bool AllNegative(const Bernstein& p) {
  return std::all_of(p.begin(), p.end(),
                     [](const Rational& x) { return x < 0; });
}

// `height` above the plane, `inside` of the three edges.
CurveTruth Decide(const Bernstein& height,
                  const std::array<Bernstein, 3>& inside, int depth) {
  if (AllPositive(height) || AllNegative(height) ||
      std::any_of(inside.begin(), inside.end(), AllNegative)) {
    return CurveTruth::kMisses;
  }
  if (std::all_of(inside.begin(), inside.end(), AllPositive) &&
      height.front() * height.back() <= 0) {
    return CurveTruth::kMeets;
  }
  if (depth == 0) return CurveTruth::kGrazes;
  const auto heights = Halves(height);
  std::array<std::array<Bernstein, 3>, 2> insides;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto halves = Halves(inside[k]);
    insides[0][k] = halves[0];
    insides[1][k] = halves[1];
  }
  const CurveTruth first = Decide(heights[0], insides[0], depth - 1);
  if (first == CurveTruth::kMeets) return first;
  const CurveTruth second = Decide(heights[1], insides[1], depth - 1);
  return second == CurveTruth::kMisses ? first : second;
}

CurveTruth Meets(const CurvePiece& piece,
                 const std::array<Eigen::Vector3d, 3>& corners) {
  const std::array<RationalPoint, 3> c = {Exact(corners[0]), Exact(corners[1]),
                                          Exact(corners[2])};
  const RationalPoint normal = Cross(Minus(c[1], c[0]), Minus(c[2], c[0]));
  Bernstein height;
  std::array<Bernstein, 3> inside;
  for (int i = 0; i <= piece.degree(); ++i) {
    const RationalPoint q = Exact(piece.point(i));
    height.push_back(Dot(normal, Minus(q, c[0])));
    for (std::size_t k = 0; k < 3; ++k) {
      const RationalPoint inwards = Cross(normal, Minus(c[(k + 1) % 3], c[k]));
      inside[k].push_back(Dot(inwards, Minus(q, c[k])));
    }
  }
  return Decide(height, inside, 100);
}

}  // namespace

CurveTruth MeetsSurface(const CurvePiece& piece, const TriangleMesh& mesh) {
  Eigen::Vector3d low = piece.front(), high = low;
  for (int i = 1; i <= piece.degree(); ++i) {
    low = low.cwiseMin(piece.point(i));
    high = high.cwiseMax(piece.point(i));
  }
  CurveTruth truth = CurveTruth::kMisses;
  for (const auto& triangle : mesh.triangles) {
    const std::array<Eigen::Vector3d, 3> c = {mesh.vertices[triangle[0]],
                                              mesh.vertices[triangle[1]],
                                              mesh.vertices[triangle[2]]};
    const Eigen::Vector3d from = c[0].cwiseMin(c[1]).cwiseMin(c[2]);
    const Eigen::Vector3d to = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    if ((from.array() > high.array()).any() ||
        (to.array() < low.array()).any()) {
      continue;
    }
    const CurveTruth one = Meets(piece, c);
    if (one == CurveTruth::kMeets) return one;
    if (one == CurveTruth::kGrazes) truth = one;
  }
  return truth;
}

}  // namespace phongpd::testing
