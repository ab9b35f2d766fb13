// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/passages.h"

#include <array>
#include <functional>
#include <utility>

#include "core/contact_space/contact_space.h"
#include "problems/shapes.h"

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;
using Lines = std::vector<double>;

constexpr double kRobot = 0.1;  // side of the cube
constexpr double kFar = 4.0;    // beyond the bounds, turned or not

// A box for every run along x of the cells between grid lines that are solid.
TriangleMesh GridSolid(const Lines& x, const Lines& y, const Lines& z,
                       const std::function<bool(int, int, int)>& is_solid) {
  TriangleMesh solid;
  const auto at = [](const Lines& lines, int i) {
    return lines[static_cast<std::size_t>(i)];
  };
  const int nx = static_cast<int>(x.size()) - 1;
  for (int k = 0; k + 1 < static_cast<int>(z.size()); ++k) {
    for (int j = 0; j + 1 < static_cast<int>(y.size()); ++j) {
      for (int i = 0; i < nx; ++i) {
        if (!is_solid(i, j, k)) continue;
        const int first = i;
        while (i + 1 < nx && is_solid(i + 1, j, k)) ++i;
        solid =
            Joined(solid, MakeBox({at(x, first), at(y, j), at(z, k)},
                                  {at(x, i + 1), at(y, j + 1), at(z, k + 1)}));
      }
    }
  }
  return solid;
}

Passage MakePassage(std::string name, TriangleMesh robot, TriangleMesh obstacle,
                    const Vector3d& start, const Vector3d& goal) {
  Passage passage;
  passage.name = std::move(name);
  passage.workspace.robot = std::move(robot);
  passage.workspace.obstacles = {{"obstacle", std::move(obstacle)}};
  passage.workspace.bounds = {Vector3d::Constant(-1.0),
                              Vector3d::Constant(1.0)};
  passage.start = start;
  passage.goal = goal;
  return passage;
}

TriangleMesh Cube() {
  return MakeBox(Vector3d::Constant(-0.5 * kRobot),
                 Vector3d::Constant(0.5 * kRobot));
}

}  // namespace

Passage PlateHole(double delta) {
  return MakePassage(
      "plate_hole", Cube(),
      Translated(MakePlateWithHole(2.0 * kFar, 0.2 - kRobot, kRobot + delta),
                 {0.13, -0.21, 0.0}),
      {0.1, 0.2, -0.7}, {-0.2, 0.1, 0.7});
}

Passage Tunnel(double delta) {
  const double w = 0.5 * (kRobot + delta);
  const Lines x = {-kFar, -0.3 - w, -0.3 + w, 0.3 - w, 0.3 + w, kFar};
  const Lines y = {-kFar, -0.2 - w, -0.2 + w, 0.2 - w, 0.2 + w, kFar};
  const Lines z = {-0.4, -0.1 - w, -0.1 + w, 0.4};
  const std::vector<std::array<int, 3>> open = {{1, 1, 0}, {1, 1, 1}, {2, 1, 1},
                                                {3, 1, 1}, {3, 2, 1}, {3, 3, 1},
                                                {3, 3, 2}};
  return MakePassage("tunnel", Cube(),
                     GridSolid(x, y, z,
                               [&](int i, int j, int k) {
                                 for (const auto& cell : open) {
                                   if (cell == std::array<int, 3>{i, j, k})
                                     return false;
                                 }
                                 return true;
                               }),
                     {0.1, 0.2, -0.7}, {-0.2, 0.1, 0.7});
}

Passage Keyhole(double delta) {
  const double a = 0.12 + 0.5 * delta, b = 0.04 + 0.5 * delta;
  const Lines x = {-kFar,   -0.4 - a, -0.4 - b, -0.4 + b, -0.4 + a,
                   0.4 - a, 0.4 - b,  0.4 + b,  0.4 + a,  kFar};
  const Lines y = {-kFar, -a, -b, b, a, kFar};
  const Lines z = {-0.05, 0.05};
  return MakePassage("keyhole", MakeAxes(0.12, 0.04),
                     GridSolid(x, y, z,
                               [](int i, int j, int) {
                                 const int c = i > 4 ? i - 4 : i;
                                 const bool in_x = c >= 1 && c <= 3;
                                 const bool in_y = j >= 1 && j <= 3;
                                 return !(in_x && in_y && (c == 2 || j == 2));
                               }),
                     {0.1, 0.2, -0.7}, {-0.2, 0.1, 0.7});
}

Passage Bugtrap(double delta) {
  const double w = 0.5 * (kRobot + delta);
  const Lines x = {-0.5, -0.4, 0.05, 0.4, 0.5};
  const Lines yz = {-0.5, -0.4, -w - 0.05, -w, w, w + 0.05, 0.4, 0.5};
  return MakePassage("bugtrap", Cube(),
                     GridSolid(x, yz, yz,
                               [](int i, int j, int k) {
                                 const bool shell = i == 0 || i == 3 ||
                                                    j == 0 || j == 6 ||
                                                    k == 0 || k == 6;
                                 const bool pipe = i == 2 && j >= 2 && j <= 4 &&
                                                   k >= 2 && k <= 4;
                                 const bool bore = i >= 2 && j == 3 && k == 3;
                                 return (shell || pipe) && !bore;
                               }),
                     {-0.2, 0.2, 0.1}, {-0.1, 0.2, 0.75});
}

Passage Turned(Passage passage) {
  const Eigen::Matrix3d rotation = GenericRotation();
  Workspace& workspace = passage.workspace;
  workspace.robot = Rotated(workspace.robot, rotation);
  for (Obstacle& obstacle : workspace.obstacles) {
    obstacle.mesh = Rotated(obstacle.mesh, rotation);
  }
  passage.start = rotation * passage.start;
  passage.goal = rotation * passage.goal;
  passage.name += " turned";
  return passage;
}

TriangleMesh ContactMesh(const Passage& passage) {
  return BuildContactSpace(passage.workspace.robot,
                           MergedObstacle(passage.workspace))
      .mesh;
}

std::shared_ptr<const ContactModel> MakeModel(const Passage& passage) {
  return std::make_shared<const ContactModel>(
      std::vector<TriangleMesh>{ContactMesh(passage)},
      passage.workspace.bounds);
}

}  // namespace phongpd::testing
