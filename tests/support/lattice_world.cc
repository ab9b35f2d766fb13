// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/lattice_world.h"

#include <CGAL/Exact_rational.h>

#include <Eigen/LU>
#include <algorithm>

#include "core/contact/contact_space.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Box = std::array<Vector3i, 2>;
using Rational = CGAL::Exact_rational;
using RationalPoint = std::array<Rational, 3>;

TriangleMesh BoxMesh(const Box& box) {
  return MakeBox(box[0].cast<double>(), box[1].cast<double>());
}

// A box, or an L of two.
std::vector<Box> MakeRobot(int size, std::mt19937_64* random, Solid* solid) {
  if (Pick(0, 2, random) > 0 || size < 2) {
    const Vector3i corner = PickPoint(-2, 1, random);
    const Box box = {corner, corner + PickPoint(1, size, random)};
    *solid = MakeSolid(BoxMesh(box), "robot");
    return {box};
  }
  const int height = Pick(1, size, random);
  *solid = MakeSolid(MakeL(size, 1.0, height), "robot");
  return {{Vector3i(0, 0, 0), Vector3i(size, 1, height)},
          {Vector3i(0, 0, 0), Vector3i(1, size, height)}};
}

std::vector<Box> MakeObstacles(LatticeWorld::Family family,
                               std::mt19937_64* random) {
  using Family = LatticeWorld::Family;
  const Vector3i o = PickPoint(-6, 4, random);
  const Vector3i size = PickPoint(3, 7, random);
  const Box base = {o, o + size};
  std::vector<Box> boxes = {base};
  switch (family) {
    case Family::kBox:
      break;
    case Family::kU:
    case Family::kL: {
      const int arm = Pick(2, 8, random);
      boxes.push_back({Vector3i(o.x(), o.y(), o.z() + size.z()),
                       Vector3i(o.x() + Pick(1, size.x(), random),
                                o.y() + size.y(), o.z() + size.z() + arm)});
      if (family == Family::kL) break;
      const int far = o.x() + size.x() + Pick(0, 4, random);
      boxes[0][1].x() = far;
      boxes.push_back(
          {Vector3i(far - Pick(1, 2, random), o.y(), o.z() + size.z()),
           Vector3i(far, o.y() + size.y(),
                    o.z() + size.z() + Pick(2, 8, random))});
      break;
    }
    case Family::kSlots:
      // Slots of width 0 to 4, for robots of width 1 to 3, between slabs that
      // part the bounds into rooms, but for windows.
      for (int i = Pick(1, 3, random), x = o.x() + size.x(); i > 0; --i) {
        x += Pick(0, 4, random);
        const int end = x + Pick(1, 3, random);
        const int window = o.z() + Pick(1, 6, random);
        boxes.push_back({Vector3i(x, -20, -20), Vector3i(end, 20, window)});
        boxes.push_back({Vector3i(x, -20, window + Pick(0, 3, random)),
                         Vector3i(end, 20, 20)});
        x = end;
      }
      break;
    case Family::kVoxels: {
      boxes.clear();
      const int n = Pick(3, 4, random), side = Pick(2, 4, random);
      const int fill = Pick(20, 75, random);
      for (int i = 0; i < n * n * n; ++i) {
        if (Pick(0, 99, random) >= fill) continue;
        const Vector3i corner = side * Vector3i(i % n, i / n % n, i / (n * n));
        boxes.push_back({corner, corner + Vector3i::Constant(side)});
      }
      if (boxes.empty()) boxes.push_back(base);
      break;
    }
  }
  return boxes;
}

}  // namespace

int Pick(int low, int high, std::mt19937_64* random) {
  return low +
         static_cast<int>((*random)() % static_cast<unsigned>(high - low + 1));
}

Vector3i PickPoint(int low, int high, std::mt19937_64* random) {
  const int x = Pick(low, high, random), y = Pick(low, high, random);
  return {x, y, Pick(low, high, random)};
}

void LabelCells(LatticeWorld* world) {
  const BoundingBox& bounds = world->workspace.bounds;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    int low = world->boxes[0][0][k], high = world->boxes[0][1][k];
    for (const Box& box : world->boxes) {
      low = std::min(low, box[0][k]);
      high = std::max(high, box[1][k]);
    }
    world->min[i] = 2 * low - 6;
    world->max[i] = 2 * high + 6;
    if (bounds.IsEmpty()) continue;
    world->min[i] = 2 * static_cast<int>(bounds.min[k]) + 1;
    world->max[i] = 2 * static_cast<int>(bounds.max[k]) - 1;
  }
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    count *= static_cast<std::size_t>(world->max[k] - world->min[k] + 1);
  }
  constexpr int kFilled = -1, kUnseen = -2;
  world->labels.assign(count, kUnseen);
  const auto index = [&](const LatticeWorld::Cell& cell) {
    std::size_t at = 0;
    for (std::size_t k = 3; k-- > 0;) {
      at = at * static_cast<std::size_t>(world->max[k] - world->min[k] + 1) +
           static_cast<std::size_t>(cell[k] - world->min[k]);
    }
    return at;
  };
  LatticeWorld::Cell cell;
  for (const Box& box : world->boxes) {
    LatticeWorld::Cell low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = static_cast<int>(k);
      low[k] = std::max(world->min[k], 2 * box[0][i]);
      high[k] = std::min(world->max[k], 2 * box[1][i]);
    }
    for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
        for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
          world->labels[index(cell)] = kFilled;
        }
      }
    }
  }
  std::vector<LatticeWorld::Cell> cells;
  for (cell[2] = world->min[2]; cell[2] <= world->max[2]; ++cell[2]) {
    for (cell[1] = world->min[1]; cell[1] <= world->max[1]; ++cell[1]) {
      for (cell[0] = world->min[0]; cell[0] <= world->max[0]; ++cell[0]) {
        cells.push_back(cell);
      }
    }
  }
  int parts = 0;
  for (const LatticeWorld::Cell& seed : cells) {
    if (world->labels[index(seed)] != kUnseen) continue;
    std::vector<LatticeWorld::Cell> open = {seed};
    world->labels[index(seed)] = parts;
    while (!open.empty()) {
      const LatticeWorld::Cell at = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        for (const int step : {-1, 1}) {
          LatticeWorld::Cell next = at;
          next[k] += step;
          if (next[k] < world->min[k] || next[k] > world->max[k]) continue;
          if (world->labels[index(next)] != kUnseen) continue;
          world->labels[index(next)] = parts;
          open.push_back(next);
        }
      }
    }
    ++parts;
  }
}

namespace {

RationalPoint BeforeMap(const Eigen::Matrix3i& map, const Vector3d& q) {
  RationalPoint p;
  const auto cofactor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const int c = (j + 1) % 3, d = (j + 2) % 3;
    return map(a, c) * map(b, d) - map(a, d) * map(b, c);
  };
  const int determinant = map(0, 0) * cofactor(0, 0) +
                          map(0, 1) * cofactor(0, 1) +
                          map(0, 2) * cofactor(0, 2);
  for (int i = 0; i < 3; ++i) {
    Rational sum = 0;
    for (int j = 0; j < 3; ++j)
      sum += Rational(cofactor(j, i)) * Rational(q[j]);
    p[static_cast<std::size_t>(i)] = sum / Rational(determinant);
  }
  return p;
}

bool Meets(const RationalPoint& a, const RationalPoint& b, const Box& box) {
  Rational enter = 0, leave = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational low = box[0][static_cast<int>(k)];
    const Rational high = box[1][static_cast<int>(k)];
    if ((a[k] < low && b[k] < low) || (a[k] > high && b[k] > high)) {
      return false;
    }
    const Rational way = b[k] - a[k];
    if (way == 0) continue;
    const Rational first = ((way > 0 ? low : high) - a[k]) / way;
    const Rational last = ((way > 0 ? high : low) - a[k]) / way;
    enter = std::max(enter, first);
    leave = std::min(leave, last);
    if (enter > leave) return false;
  }
  return true;
}

}  // namespace

int LatticeWorld::Label(const Cell& cell) const {
  std::size_t at = 0;
  for (std::size_t k = 3; k-- > 0;) {
    at = at * static_cast<std::size_t>(max[k] - min[k] + 1) +
         static_cast<std::size_t>(cell[k] - min[k]);
  }
  return labels[at];
}

Vector3d LatticeWorld::Point(const Cell& cell) const {
  return 0.5 * (map * Vector3i(cell[0], cell[1], cell[2])).cast<double>();
}

LatticeWorld::Cell LatticeWorld::RandomCell(std::mt19937_64* random) const {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) cell[k] = Pick(min[k], max[k], random);
  return cell;
}

bool LatticeWorld::IsFree(const std::vector<Vector3d>& path) const {
  std::vector<RationalPoint> points;
  for (const Vector3d& q : path) {
    points.push_back(BeforeMap(map, q));
    if (workspace.bounds.IsEmpty()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = static_cast<int>(k);
      if (points.back()[k] <= Rational(workspace.bounds.min[i]) ||
          points.back()[k] >= Rational(workspace.bounds.max[i])) {
        return false;
      }
    }
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (const Box& box : boxes) {
      if (Meets(points[i - 1], points[i], box)) return false;
    }
  }
  return !path.empty();
}

LatticeWorld MakeLatticeWorld(LatticeWorld::Family family, bool mapped,
                              std::mt19937_64* random) {
  static constexpr const char* kNames[] = {"box", "L", "U", "slots", "voxels"};
  LatticeWorld world;
  world.name =
      std::string(kNames[static_cast<int>(family)]) + (mapped ? " mapped" : "");
  const std::vector<Box> robot =
      MakeRobot(family == LatticeWorld::Family::kVoxels ? 2 : 3, random,
                &world.workspace.robot);
  for (const Box& box : MakeObstacles(family, random)) {
    world.workspace.obstacles.push_back(MakeSolid(
        BoxMesh(box), std::to_string(world.workspace.obstacles.size())));
    for (const Box& part : robot) {
      world.boxes.push_back({box[0] - part[1], box[1] - part[0]});
    }
  }
  // Some within bounds, which obstacles may touch or stick out of.
  if (family == LatticeWorld::Family::kSlots || Pick(0, 2, random) == 0) {
    Vector3i low = world.boxes[0][0], high = world.boxes[0][1];
    for (const Box& box : world.boxes) {
      low = low.cwiseMin(box[0]);
      high = high.cwiseMax(box[1]);
    }
    low = low.cwiseMax(-10);
    high = high.cwiseMin(14);
    world.workspace.bounds = {(low - PickPoint(-1, 2, random)).cast<double>(),
                              (high + PickPoint(-1, 2, random)).cast<double>()};
    world.name += " in bounds";
  }
  LabelCells(&world);
  const bool is_full =
      *std::max_element(world.labels.begin(), world.labels.end()) < 0;
  if (is_full) return MakeLatticeWorld(family, mapped, random);
  world.contact_space =
      BuildContactSpace(world.workspace.robot, MergedObstacle(world.workspace))
          .mesh();
  while (mapped) {
    world.map.row(0) = PickPoint(-2, 2, random);
    world.map.row(1) = PickPoint(-2, 2, random);
    world.map.row(2) = PickPoint(-2, 2, random);
    if (world.map.cast<double>().determinant() > 0.5) break;
  }
  for (Vector3d& v : world.contact_space.vertices) {
    v = world.map.cast<double>() * v;
  }
  return world;
}

}  // namespace phongpd::testing
