// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/grid_frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/minkowski/operands/canonical_frame.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Coordinates as they were computed, scaled or moved differ from what was
// meant by this much of the largest of them; ...
constexpr double kInputNoise = 0x1p-50;
// ... and by this much of the operand's extent when turned back by a frame
// that was itself found from rounded facets.
constexpr double kTurnNoise = 0x1p-46;

// The vertices of an operand that its triangles use.
struct Vertices {
  explicit Vertices(const TriangleMesh& mesh) : count(mesh.vertices.size()) {
    std::vector<char> is_used(count, 0);
    for (const Triangle& t : mesh.triangles) {
      for (const int v : t) is_used[v] = 1;
    }
    for (std::size_t v = 0; v < count; ++v) {
      if (!is_used[v]) continue;
      index.push_back(v);
      points.push_back(mesh.vertices[v]);
    }
  }
  BoundingBox Box() const {
    BoundingBox box{points[0], points[0]};
    for (const Vector3d& p : points) {
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
    return box;
  }
  // Back under the vertices' numbers.
  std::vector<GridPoint> Spread(const std::vector<GridPoint>& of_points) const {
    std::vector<GridPoint> all(count, GridPoint{0, 0, 0});
    for (std::size_t i = 0; i < index.size(); ++i) {
      all[index[i]] = of_points[i];
    }
    return all;
  }

  std::size_t count;
  std::vector<std::size_t> index;
  std::vector<Vector3d> points;
};

struct Operands {
  Vertices robot, obstacle;

  double Largest() const {
    double largest = 0.0;
    for (const Vertices* v : {&robot, &obstacle}) {
      for (const Vector3d& p : v->points) {
        largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
      }
    }
    return largest;
  }
  // Of the coordinates from the middle of an operand's box.
  double Reach() const {
    double reach = 0.0;
    for (const Vertices* v : {&robot, &obstacle}) {
      const BoundingBox box = v->Box();
      reach = std::max(reach, (box.max - box.Center()).maxCoeff());
      reach = std::max(reach, (box.Center() - box.min).maxCoeff());
    }
    return reach;
  }
};

// Coordinates of `points` from `origin` in units, rounded.
std::vector<GridPoint> Counts(const std::vector<Vector3d>& points,
                              const Vector3d& origin, const LatticeUnit& unit) {
  std::vector<GridPoint> counts;
  counts.reserve(points.size());
  for (const Vector3d& p : points) {
    GridPoint n;
    for (int k = 0; k < 3; ++k) {
      n[k] = std::llrint(unit.Count(p[k] - origin[k]));
    }
    counts.push_back(n);
  }
  return counts;
}

// The least corner, and the greatest common divisor of all coordinates
// measured from it and of `divisor`.
std::int64_t DivisorFromCorner(const std::vector<GridPoint>& points,
                               std::int64_t divisor, GridPoint* corner) {
  *corner = points[0];
  for (const GridPoint& p : points) {
    for (int k = 0; k < 3; ++k) (*corner)[k] = std::min((*corner)[k], p[k]);
  }
  for (const GridPoint& p : points) {
    if (divisor == 1) break;
    for (int k = 0; k < 3; ++k) {
      divisor = std::gcd(divisor, p[k] - (*corner)[k]);
    }
  }
  return divisor;
}

// Moves integers to a centre and divides them; returns the largest that is
// left.
std::int64_t Reduce(const GridPoint& corner, std::int64_t divisor,
                    std::vector<GridPoint>* points, GridPoint* center) {
  GridPoint half = {0, 0, 0};
  for (GridPoint& p : *points) {
    for (int k = 0; k < 3; ++k) {
      p[k] = (p[k] - corner[k]) / divisor;
      half[k] = std::max(half[k], p[k]);
    }
  }
  std::int64_t reach = 0;
  for (int k = 0; k < 3; ++k) {
    reach = std::max(reach, half[k] - half[k] / 2);
    half[k] /= 2;
    (*center)[k] = corner[k] + half[k] * divisor;
  }
  for (GridPoint& p : *points) p = p - half;
  return reach;
}

// Integers of one unit as they stand for the operands; false when they are
// too many for the grid.
bool PlaceIntegers(const Operands& operands, std::vector<GridPoint> robot,
                   std::vector<GridPoint> obstacle, const LatticeUnit& unit,
                   LatticeDivisor kind, GridFrame* frame) {
  GridPoint robot_corner, obstacle_corner, robot_center, obstacle_center;
  std::int64_t divisor = DivisorFromCorner(robot, 0, &robot_corner);
  divisor = DivisorFromCorner(obstacle, divisor, &obstacle_corner);
  if (kind == LatticeDivisor::kPowerOfTwo) divisor &= -divisor;
  const std::int64_t reach =
      std::max(Reduce(robot_corner, divisor, &robot, &robot_center),
               Reduce(obstacle_corner, divisor, &obstacle, &obstacle_center));
  int bits = 0;
  std::frexp(static_cast<double>(reach), &bits);
  if (bits > kGridBits) return false;
  // Up to the full grid: the fractions of a step that points are rounded to
  // in double, and cells judged at, stay as small beside the operands.
  const std::int64_t factor = std::int64_t{1} << (kGridBits - bits);
  for (std::vector<GridPoint>* points : {&robot, &obstacle}) {
    for (GridPoint& p : *points) {
      for (std::int64_t& x : p) x *= factor;
    }
  }
  frame->robot = operands.robot.Spread(robot);
  frame->obstacle = operands.obstacle.Spread(obstacle);
  frame->unit = unit;
  frame->shift = ToDouble(obstacle_center - robot_center);
  frame->stride = static_cast<double>(divisor) / static_cast<double>(factor);
  frame->step = unit.Length(frame->stride);
  return true;
}

bool PlaceExactly(const Operands& operands, LatticeDivisor divisor,
                  GridFrame* frame) {
  std::vector<double> coordinates;
  for (const Vertices* v : {&operands.robot, &operands.obstacle}) {
    for (const Vector3d& p : v->points) {
      coordinates.insert(coordinates.end(), {p[0], p[1], p[2]});
    }
  }
  const std::optional<LatticeUnit> unit = FindExactUnit(coordinates);
  if (!unit) return false;
  const auto place = [&](LatticeDivisor kind) {
    return PlaceIntegers(
        operands, Counts(operands.robot.points, Vector3d::Zero(), *unit),
        Counts(operands.obstacle.points, Vector3d::Zero(), *unit), *unit, kind,
        frame);
  };
  return place(divisor) || place(LatticeDivisor::kGreatest);
}

bool PlaceUpToNoise(const Operands& operands, double noise, GridFrame* frame) {
  const Vector3d robot_corner = operands.robot.Box().min;
  const Vector3d obstacle_corner = operands.obstacle.Box().min;
  std::vector<double> lengths;
  for (const Vertices* v : {&operands.robot, &operands.obstacle}) {
    const Vector3d& corner =
        v == &operands.robot ? robot_corner : obstacle_corner;
    for (const Vector3d& p : v->points) {
      for (int k = 0; k < 3; ++k) lengths.push_back(p[k] - corner[k]);
    }
  }
  const std::optional<double> length =
      FindCommonUnit(std::move(lengths), noise);
  if (!length) return false;
  LatticeUnit unit;
  unit.scale = std::frexp(*length, &unit.exponent);
  frame->origin = obstacle_corner - robot_corner;
  frame->rounding = 2 * noise;
  return PlaceIntegers(operands,
                       Counts(operands.robot.points, robot_corner, unit),
                       Counts(operands.obstacle.points, obstacle_corner, unit),
                       unit, LatticeDivisor::kGreatest, frame);
}

// One value for all coordinates of an axis that differ by noise.
void JoinEqualUpToNoise(double noise, std::vector<Vector3d>* points) {
  std::vector<std::size_t> order(points->size());
  for (int k = 0; k < 3; ++k) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return (*points)[a][k] < (*points)[b][k];
    });
    double value = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      double& x = (*points)[order[i]][k];
      if (i == 0 || x - value > noise) value = x;
      x = value;
    }
  }
}

void PlaceRounded(const Operands& operands, GridFrame* frame) {
  LatticeUnit unit;
  std::frexp(operands.Reach(), &unit.exponent);
  unit.exponent -= kGridBits;
  const Vector3d robot_center = operands.robot.Box().Center();
  const Vector3d obstacle_center = operands.obstacle.Box().Center();
  frame->robot =
      operands.robot.Spread(Counts(operands.robot.points, robot_center, unit));
  frame->obstacle = operands.obstacle.Spread(
      Counts(operands.obstacle.points, obstacle_center, unit));
  frame->unit = unit;
  frame->step = frame->rounding = unit.Length(1.0);
  frame->origin = obstacle_center - robot_center;
}

}  // namespace

Eigen::Vector3d GridFrame::ToUser(const Vector3d& x) const {
  Vector3d q;
  for (int k = 0; k < 3; ++k) q[k] = unit.Length(shift[k] + stride * x[k]);
  if (is_turned) q = rotation.transpose() * q;
  return origin + q;
}

Eigen::Vector3d GridFrame::ToGrid(const Vector3d& q) const {
  Vector3d x = q - origin;
  if (is_turned) x = rotation * x;
  for (int k = 0; k < 3; ++k) x[k] = (unit.Count(x[k]) - shift[k]) / stride;
  return x;
}

GridFrame PlaceOnGrid(const TriangleMesh& robot, const TriangleMesh& obstacle,
                      LatticeDivisor divisor) {
  GridFrame frame;
  Operands operands{Vertices(robot), Vertices(obstacle)};
  double noise = kInputNoise * operands.Largest();
  if (PlaceExactly(operands, divisor, &frame)) return frame;
  frame = GridFrame();
  if (PlaceUpToNoise(operands, noise, &frame)) return frame;
  frame = GridFrame();
  const CanonicalFrame turned = ChooseCanonicalFrame(robot, obstacle);
  if (!turned.used) {
    PlaceRounded(operands, &frame);
    return frame;
  }
  noise += kTurnNoise * operands.Reach();
  const Vector3d between =
      operands.obstacle.Box().Center() - operands.robot.Box().Center();
  for (Vertices* v : {&operands.robot, &operands.obstacle}) {
    const Vector3d center = v->Box().Center();
    for (Vector3d& p : v->points) p = turned.rotation * (p - center);
  }
  if (!PlaceUpToNoise(operands, noise, &frame)) {
    frame = GridFrame();
    for (Vertices* v : {&operands.robot, &operands.obstacle}) {
      JoinEqualUpToNoise(noise, &v->points);
    }
    PlaceRounded(operands, &frame);
    frame.rounding += noise;
  }
  frame.is_turned = true;
  frame.rotation = turned.rotation;
  frame.origin = between + turned.rotation.transpose() * frame.origin;
  return frame;
}

}  // namespace phongpd::internal
