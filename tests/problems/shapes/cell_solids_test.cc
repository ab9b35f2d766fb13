// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/cell_solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/solid/solid.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

TEST(CellSolids, StepHasOnePolygonAFace) {
  // An L of three cells: 8 faces, 12 vertices, as MakeL.
  const TriangleMesh step =
      MakeCells({0, 1, 2}, {0, 1}, {0, 1, 2}, {{"##"}, {"#."}});
  EXPECT_EQ(step.vertices.size(), 12U);
  EXPECT_EQ(step.triangles.size(), 20U);
  EXPECT_EQ(SignedVolume(step), 3.0);
}

TEST(CellSolids, FrameKeepsItsHole) {
  const std::vector<double> cuts = {-2, -1, 1, 2};
  const TriangleMesh frame =
      MakeCells(cuts, cuts, {0, 1}, {{"###", "#.#", "###"}});
  EXPECT_EQ(frame.triangles.size(),
            MakePlateWithHole(4, 1, 2).triangles.size());
  EXPECT_EQ(SignedVolume(frame), 12.0);
}

// Cell surfaces by another route, and the same surface before and after.
TEST(CellSolids, WholeFacesKeepTheSolid) {
  std::mt19937_64 random(7);
  int merged = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 2 + trial % 2;
    const Voxels voxels = RandomVoxels(n, 0.5, EdgeContact::kAvoided, &random);
    std::vector<double> cuts;
    for (int i = 0; i <= n; ++i) cuts.push_back(i);
    const TriangleMesh cells =
        internal::UniteCells({cuts, cuts, cuts}, [&](int i, int j, int k) {
          return voxels.filled[i + n * (j + n * k)] != 0;
        });
    const TriangleMesh whole = internal::WithWholeFaces(cells);
    const MeshReport report = ExamineMesh(whole);
    EXPECT_EQ(report.boundary_edges + report.non_manifold_edges +
                  report.misoriented_edges + report.self_intersections +
                  report.degenerate_triangles,
              0U);
    EXPECT_EQ(report.volume, SignedVolume(VoxelSurface(voxels)));
    EXPECT_EQ(SurfaceArea(whole), SurfaceArea(cells));
    EXPECT_LE(whole.triangles.size(), cells.triangles.size());
    merged += whole.triangles.size() < cells.triangles.size();
  }
  EXPECT_GT(merged, 50);
}

// The top of the lower layer runs round a pit and a post that touch in the
// vertex (2, 2, 1), so that its border meets itself there.
TEST(CellSolids, FaceThatMeetsItselfStaysInTriangles) {
  const std::vector<double> cuts = {0, 1, 2, 3, 4};
  const TriangleMesh mesh = MakeCells(
      cuts, cuts, {0, 1, 2},
      {{"####", "##.#", "####", "####"}, {"....", "....", ".#..", "...."}});
  const MeshReport report = ExamineMesh(mesh);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges +
                report.self_intersections,
            0U);
  EXPECT_EQ(report.volume, 16.0);
  // Two a cell face: 15 below, 14 + 1 above, 16 + 4 outer and 4 + 4 inner
  // walls.
  EXPECT_EQ(mesh.triangles.size(), 2U * (15 + 15 + 16 + 8));
}

TEST(CellSolids, ShellIsABoxWithACavity) {
  const TriangleMesh shell = MakeBoxShell({0, 0, 0}, {1, 2, 3}, 1);
  EXPECT_EQ(shell.triangles.size(), 24U);
  EXPECT_EQ(SignedVolume(shell), 3 * 4 * 5 - 6);
  MeshReport report;
  MakeSolid(shell, "shell", &report);
  EXPECT_EQ(report.inverted_components, 0);
}

}  // namespace
}  // namespace phongpd
