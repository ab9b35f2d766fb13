// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/bounds/convex_hull.h"
#include "core/contact/contact_space.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "results/bench/motion_set.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Matrix3 = Eigen::Matrix<std::int64_t, 3, 3>;

GridVector ToGrid(const Vector3d& v) {
  const GridVector grid = v.array().round().matrix().cast<std::int64_t>();
  if (grid.cast<double>() != v) {
    throw std::logic_error("motion set: a vertex is no integer point");
  }
  return grid;
}

Polyhedron BoxPolyhedron(const GridVector& min, const GridVector& max) {
  Polyhedron box;
  for (int k = 0; k < 3; ++k) {
    box.push_back({GridVector::Unit(k), max[k]});
    box.push_back({-GridVector::Unit(k), -min[k]});
  }
  return box;
}

// { b − a } of the vertices of two convex solids: its hull by trying every
// plane through three points.
Polyhedron ConvexSum(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  std::vector<GridVector> points;
  for (const Vector3d& b : obstacle.vertices) {
    for (const Vector3d& a : robot.vertices) points.push_back(ToGrid(b - a));
  }
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>>
      found;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        GridVector normal =
            (points[j] - points[i]).cross(points[k] - points[i]);
        const std::int64_t divisor =
            std::gcd(std::gcd(normal[0], normal[1]), normal[2]);
        if (divisor == 0) continue;
        normal /= divisor;
        for (const std::int64_t sign : {1, -1}) {
          const GridVector outward = sign * normal;
          const std::int64_t level = outward.dot(points[i]);
          const bool bounds = std::all_of(
              points.begin(), points.end(),
              [&](const GridVector& p) { return outward.dot(p) <= level; });
          if (bounds) {
            found.emplace(outward[0], outward[1], outward[2], level);
          }
        }
      }
    }
  }
  Polyhedron sum;
  for (const auto& [x, y, z, level] : found) {
    sum.push_back({GridVector(x, y, z), level});
  }
  return sum;
}

TriangleMesh Hull(const std::vector<Vector3d>& points) {
  TriangleMesh mesh{points, {}};
  for (int v = 2; v < static_cast<int>(points.size()); ++v) {
    mesh.triangles.push_back({0, 1, v});
  }
  return internal::HullOfVertices(mesh);
}

TriangleMesh CubeMesh(double half) {
  return MakeBox(Vector3d::Constant(-half), Vector3d::Constant(half));
}

void CheckContact(const MotionScene& scene) {
  for (const Vector3d& v : scene.contact.vertices) {
    if (v == v.array().round().matrix()) continue;
    throw std::logic_error("motion set, " + scene.name +
                           ": a vertex of the contact space is no integer");
  }
}

void BuildContact(MotionScene* scene) {
  scene->contact = BuildContactSpace(scene->robot, scene->obstacle).mesh();
  CheckContact(*scene);
}

// Cells of side 4; a robot of half-side 2 fits the gaps of one cell exactly.
MotionScene VoxelScene(int n, double fill, std::int64_t half) {
  std::mt19937_64 random(100);
  Voxels voxels = RandomVoxels(n, fill, EdgeContact::kAvoided, &random);
  voxels.corner.setZero();
  MotionScene scene;
  scene.name = "voxels " + std::to_string(n) + "³, " +
               std::to_string(static_cast<int>(100.0 * fill)) +
               " %, robot of side " + std::to_string(2 * half);
  scene.robot = CubeMesh(static_cast<double>(half));
  scene.obstacle = Scaled(VoxelSurface(voxels), 4.0);
  for (int i = 0; i < n * n * n; ++i) {
    if (!voxels.filled[static_cast<std::size_t>(i)]) continue;
    const GridVector cell(i % n, i / n % n, i / (n * n));
    scene.pieces.push_back(BoxPolyhedron((4 * cell).array() - half,
                                         (4 * cell).array() + 4 + half));
  }
  BuildContact(&scene);
  return scene;
}

// The scene under an integer matrix of determinant 1.
MotionScene Sheared(MotionScene scene, const Matrix3& map) {
  scene.name += ", sheared";
  const Eigen::Matrix3d exact = map.cast<double>();
  for (TriangleMesh* mesh : {&scene.robot, &scene.obstacle, &scene.contact}) {
    for (Vector3d& v : mesh->vertices) v = exact * v;
  }
  Matrix3 inverse;  // rows of the adjugate
  for (int k = 0; k < 3; ++k) {
    inverse.row(k) = map.col((k + 1) % 3).cross(map.col((k + 2) % 3));
  }
  for (Polyhedron& piece : scene.pieces) {
    for (HalfSpace& half : piece) {
      half.normal = (half.normal.transpose() * inverse).transpose().eval();
    }
  }
  return scene;
}

// Convex bodies that lie apart: the contact space is the hull of differences
// of vertices, which keeps them as they are.
MotionScene ConvexScene(const std::string& name, const TriangleMesh& robot,
                        const std::vector<TriangleMesh>& bodies) {
  MotionScene scene;
  scene.name = name;
  scene.robot = robot;
  for (const TriangleMesh& body : bodies) {
    scene.obstacle = Joined(scene.obstacle, body);
    scene.pieces.push_back(ConvexSum(robot, body));
    std::vector<Vector3d> points;
    for (const Vector3d& b : body.vertices) {
      for (const Vector3d& a : robot.vertices) points.push_back(b - a);
    }
    scene.contact = Joined(scene.contact, Hull(points));
  }
  CheckContact(scene);
  return scene;
}

MotionScene CavityScene() {
  MotionScene scene;
  scene.name = "cavity";
  scene.robot = CubeMesh(1.0);
  scene.obstacle =
      MakeBoxShell(Vector3d::Constant(-6.0), Vector3d::Constant(6.0), 2.0);
  for (int k = 0; k < 3; ++k) {
    for (const int side : {-1, 1}) {
      GridVector min = GridVector::Constant(-9), max = -min;
      (side > 0 ? min : max)[k] = side * 5;
      scene.pieces.push_back(BoxPolyhedron(min, max));
    }
  }
  BuildContact(&scene);
  return scene;
}

}  // namespace

std::vector<MotionScene> MotionScenes() {
  std::vector<MotionScene> scenes;
  // Sparse and dense ones; others of this size meet in edges.
  for (const auto& [n, fill] :
       {std::pair(3, 0.375), std::pair(4, 0.125), std::pair(4, 0.875)}) {
    for (const int half : {1, 2}) scenes.push_back(VoxelScene(n, fill, half));
  }
  std::array<Matrix3, 6> maps;
  maps[0] << 1, 1, 0, 0, 1, 0, 0, 0, 1;
  maps[1] << 1, 2, 1, 0, 1, 3, 0, 0, 1;
  maps[2] << 2, 1, 0, 1, 1, 0, 0, 1, 1;
  maps[3] << 1, 0, 0, -3, 1, 0, 2, 1, 1;
  maps[4] << 0, 0, 1, 1, 0, 2, 0, 1, -1;
  maps[5] << 1, -1, 1, 0, 1, -2, 1, -1, 2;
  for (std::size_t i = 0; i < 6; ++i) {
    scenes.push_back(Sheared(scenes[i], maps[i]));
  }
  const TriangleMesh box = MakeBox({-1, -2, -1}, {2, 1, 3});
  const TriangleMesh tetra =
      Hull({{0, 0, 0}, {9, 1, 2}, {-3, 8, 1}, {1, 2, 10}});
  const TriangleMesh octahedron = Hull(
      {{6, 0, 0}, {-6, 0, 0}, {0, 6, 0}, {0, -6, 0}, {0, 0, 6}, {0, 0, -6}});
  const TriangleMesh pyramid =
      Hull({{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {1, 0, 9}});
  const TriangleMesh needle =
      Hull({{0, 0, 0}, {200, 1, 0}, {200, 0, 1}, {199, 1, 1}});
  scenes.push_back(ConvexScene("box", box, {MakeBox({0, 0, 0}, {5, 7, 9})}));
  scenes.push_back(ConvexScene("tetrahedron", box, {tetra}));
  scenes.push_back(
      ConvexScene("octahedra", Scaled(octahedron, 0.5), {octahedron}));
  scenes.push_back(ConvexScene("pyramid", tetra, {pyramid}));
  scenes.push_back(ConvexScene("two bodies", box,
                               {tetra, Translated(pyramid, {30, -4, 2})}));
  scenes.push_back(ConvexScene("needle", box, {needle}));
  scenes.push_back(ConvexScene("needle robot", needle, {octahedron}));
  scenes.push_back(CavityScene());
  return scenes;
}

}  // namespace phongpd::bench
