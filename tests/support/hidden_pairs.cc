// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/hidden_pairs.h"

#include <array>
#include <cassert>

#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

// Point i of Hilbert's curve through 4 × 4 × 4 points (J. Skilling,
// "Programming the Hilbert curve", 2004).
std::array<int, 3> HilbertPoint(int i) {
  constexpr int kBits = 2;
  std::array<int, 3> x{};
  for (int bit = 0; bit < 3 * kBits; ++bit) {
    if ((i >> (3 * kBits - 1 - bit) & 1) != 0) {
      x[static_cast<std::size_t>(bit % 3)] |= 1 << (kBits - 1 - bit / 3);
    }
  }
  const int last = x[2] >> 1;
  x[2] ^= x[1];
  x[1] ^= x[0];
  x[0] ^= last;
  for (int q = 2; q != 1 << kBits; q <<= 1) {
    for (std::size_t k = 3; k-- > 0;) {
      if ((x[k] & q) != 0) {
        x[0] ^= q - 1;
      } else {
        const int swapped = (x[0] ^ x[k]) & (q - 1);
        x[0] ^= swapped;
        x[k] ^= swapped;
      }
    }
  }
  return x;
}

TriangleMesh Turned(const TriangleMesh& mesh) {
  return Rotated(mesh, GenericRotation());
}

// Three overlapping bars, each a component of its own.
TriangleMesh MakeBars(double length, double width) {
  TriangleMesh bars;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d half = Eigen::Vector3d::Constant(width);
    half[k] = length;
    bars = k == 0 ? MakeBox(-half, half) : Joined(bars, MakeBox(-half, half));
  }
  return bars;
}

// A solid within the walls of a box, as bounds make them.
TriangleMesh InBounds(const TriangleMesh& solid, double reach) {
  const auto box = [](double half) {
    return MakeBox(Eigen::Vector3d::Constant(-half),
                   Eigen::Vector3d::Constant(half));
  };
  return Joined(solid, Joined(box(reach + 0.5), Reversed(box(reach))));
}

}  // namespace

TriangleMesh MakeHilbertTube(int cells) {
  assert(1 <= cells && cells <= 127);
  Voxels voxels;
  voxels.n = 7;
  voxels.filled.assign(7 * 7 * 7, 0);
  const auto fill = [&](const std::array<int, 3>& c) {
    voxels.filled[static_cast<std::size_t>(c[0] + 7 * (c[1] + 7 * c[2]))] = 1;
  };
  for (int cell = 0; cell < cells; ++cell) {
    const std::array<int, 3> from = HilbertPoint(cell / 2);
    const std::array<int, 3> to = HilbertPoint((cell + 1) / 2);
    fill({from[0] + to[0], from[1] + to[1], from[2] + to[2]});
  }
  return VoxelSurface(voxels);
}

std::vector<HiddenPair> HiddenPairs(int detail) {
  const int d = detail;
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     cube = MakeBox({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4});
  const TriangleMesh knot = MakeKnot(0.5, 0.2, 32 * d, 4 * d);
  const TriangleMesh thick_knot = MakeKnot(0.5, 0.225, 32 * d, 4 * d);
  const TriangleMesh torus = MakeTorus(1.2, 0.4, 12 * d, 6 * d);
  const TriangleMesh blob = MakeBlob(1.0, 1 + d, 0.35, 1);
  const TriangleMesh spiky = MakeBlob(1.0, 1 + d, 0.7, 3);
  const TriangleMesh ball = MakeIcoBall(0.6, d);
  const TriangleMesh wrench = MakeWrench(0.4, 6 * d, 6 * d, 5 * d, 5 * d);
  const TriangleMesh scan = MakeScan(torus, 0.5 / d, 0.002, 3);
  const TriangleMesh bars = MakeBars(1.2, 0.2);
  const TriangleMesh axes = MakeAxes(1.2, 0.2);
  const TriangleMesh shell = MakeVessel(3.0, 2.2, 0.0);
  const TriangleMesh vessel = MakeVessel(3.0, 2.2, 0.8);
  const TriangleMesh cells = MakeHilbertTube(15 * d);
  const TriangleMesh few_cells = MakeHilbertTube(7 * d);
  const TriangleMesh grid = Scaled(few_cells, 0.5);
  const TriangleMesh stars =
      Joined(Joined(star, Translated(Turned(star), {0.7, 0, 0})),
             Translated(star, {0.2, 0.9, 0.1}));
  const TriangleMesh turned_cells = Turned(Scaled(few_cells, 0.6));
  const TriangleMesh hollow =
      Joined(MakeIcoBall(2.0, 1 + d), Reversed(MakeIcoBall(1.3, 1 + d)));
  // A third ball fills part of the cavity and of its wall.
  const TriangleMesh opened =
      Joined(hollow, Translated(MakeIcoBall(1.2, d), {1.1, 0.2, 0.1}));
  return {
      {"star + knot", star, thick_knot, true},
      {"turned star + knot", Turned(star), knot, true},
      {"knot + star", knot, star, true},
      {"knot + turned knot", knot, Turned(knot), true},
      {"knot + torus", knot, torus, true},
      {"torus + turned torus", torus, Turned(torus), true},
      {"torus + torus", torus, torus, true},
      {"star + torus", star, torus, true},
      {"star + star", star, star, true},
      {"star + turned star", star, Turned(star), true},
      {"star + organic body", star, blob, true},
      {"star + spiky body", star, spiky, true},
      {"organic bodies", Scaled(blob, 0.5), spiky, true},
      {"spiky bodies", spiky, Turned(spiky), true},
      {"wrench + knot", wrench, knot, true},
      {"turned wrench + scan", Turned(wrench), scan, true},
      {"knot + scan", Scaled(knot, 0.5), scan, true},
      {"ball + wrench", ball, wrench, false},
      {"ball + ball", ball, ball, false},
      {"ball + knot", ball, knot, true},
      {"cube + organic body", cube, blob, false},
      {"bars + knot", bars, knot, true},
      {"bars + turned bars", bars, Turned(bars), true},
      {"axes + axes", axes, axes, false},
      {"axes + turned axes", axes, Turned(axes), true},
      {"three stars + torus", stars, torus, true},
      {"cube + three stars", cube, stars, true},
      {"turned tube + tube", turned_cells, cells, true},
      {"tube + tube, half a lattice", grid, cells, true},
      {"tube + tube, one lattice", few_cells, cells, false},
      {"star + tube", star, cells, true},
      {"knot + tube", knot, cells, true},
      {"cube + shell", cube, shell, false},
      {"star + shell", Scaled(star, 0.5), shell, false},
      {"star + vessel", Scaled(star, 0.5), vessel, true},
      {"knot + shell", Scaled(knot, 0.4), shell, false},
      {"star + knot in bounds", star, InBounds(thick_knot, 3.0), true},
      {"knot + knot in wide bounds", knot, InBounds(knot, 6.0), true},
      {"star + hollow ball", Scaled(star, 0.7), hollow, true},
      {"hollow ball + knot", Scaled(hollow, 0.5), knot, true},
      {"knot + filled hollow ball", Scaled(knot, 0.4), opened, true},
  };
}

}  // namespace phongpd
