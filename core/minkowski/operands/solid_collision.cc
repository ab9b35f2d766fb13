// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/solid_collision.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/box_tree_pairs.h"
#include "core/mesh/union_find.h"

namespace phongpd::internal {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SolidFacet = Kernel::Triangle_3;

struct TestedSolid {
  std::vector<SolidFacet> facets;
  std::vector<Point> seeds;  // one vertex per component
  BoundingBox bounds;
  BoxTree facet_tree, seed_tree;
};

Eigen::Vector3d Coordinates(const Point& p) { return {p.x(), p.y(), p.z()}; }

// Grid coordinates are exact in double, and so are their boxes.
void BuildTrees(TestedSolid* solid) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(solid->facets.size());
  for (const SolidFacet& t : solid->facets) {
    const CGAL::Bbox_3 box = t.bbox();
    boxes.push_back({{box.xmin(), box.ymin(), box.zmin()},
                     {box.xmax(), box.ymax(), box.zmax()}});
  }
  solid->facet_tree = BoxTree(boxes, 4);
  if (!boxes.empty()) {
    const BoxTree::Node& root = solid->facet_tree.nodes()[0];
    solid->bounds = {root.min, root.max};
  }
  boxes.clear();
  for (const Point& p : solid->seeds) {
    boxes.push_back({Coordinates(p), Coordinates(p)});
  }
  solid->seed_tree = BoxTree(boxes, 4);
}

TestedSolid MakeTested(const GridSolid& grid, double sign) {
  TestedSolid solid;
  UnionFind sets(grid.vertices.size());
  const auto point = [&](int v) {
    const Eigen::Vector3d p = sign * ToDouble(grid.vertices[v]);
    return Point(p[0], p[1], p[2]);
  };
  for (const Triangle& t : grid.facets) {
    sets.Join(t[0], t[1]);
    sets.Join(t[0], t[2]);
    // Reflection turned the facets; turn them back.
    solid.facets.emplace_back(point(t[0]), point(sign > 0 ? t[1] : t[2]),
                              point(sign > 0 ? t[2] : t[1]));
  }
  for (int v = 0; v < static_cast<int>(grid.vertices.size()); ++v) {
    if (!grid.neighbors[v].empty() && sets.Find(v) == v) {
      solid.seeds.push_back(point(v));
    }
  }
  return solid;
}

// Sign of the turn a → b → p in the xy plane, with p moved by (ε, ε²): never
// zero unless a and b coincide there.
int Turn(const Point& a, const Point& b, const Point& p) {
  const Kernel::Point_2 a2(a.x(), a.y()), b2(b.x(), b.y()), p2(p.x(), p.y());
  const int turn = static_cast<int>(CGAL::orientation(a2, b2, p2));
  if (turn != 0) return turn;
  if (a.y() != b.y()) return a.y() > b.y() ? 1 : -1;
  return a.x() == b.x() ? 0 : a.x() < b.x() ? 1 : -1;
}

// Winding number of the solid around p (not on its surface): signed count of
// facets above p.  Positive means inside, also where components overlap.
int WindingNumber(const TestedSolid& solid, const Point& p) {
  int winding = 0;
  const auto is_above = [&](const Eigen::Vector3d& low,
                            const Eigen::Vector3d& high) {
    return high[2] >= p.z() && low[0] <= p.x() && high[0] >= p.x() &&
           low[1] <= p.y() && high[1] >= p.y();
  };
  const BoxTree& tree = solid.facet_tree;
  tree.ForEach(
      [&](int index) {
        return is_above(tree.nodes()[index].min, tree.nodes()[index].max);
      },
      [&](int position) {
        const SolidFacet& t = solid.facets[tree.order()[position]];
        const int turn = Turn(t[0], t[1], p);
        // p is below the facet when it is behind its upward side.
        if (turn != 0 && Turn(t[1], t[2], p) == turn &&
            Turn(t[2], t[0], p) == turn &&
            static_cast<int>(CGAL::orientation(t[0], t[1], t[2], p)) != turn) {
          winding += turn;
        }
        return true;
      });
  return winding;
}

// Does `other` contain a seed of `solid` moved by `shift`?
bool ContainsSeed(const TestedSolid& other, const TestedSolid& solid,
                  const Kernel::Vector_3& shift) {
  // 2^39 + 2^40 with 12 fractional bits: exact, too.
  const Eigen::Vector3d s(shift.x(), shift.y(), shift.z());
  const Eigen::Vector3d low = other.bounds.min - s, high = other.bounds.max - s;
  const BoxTree& tree = solid.seed_tree;
  bool contains = false;
  tree.ForEach(
      [&](int index) {
        const BoxTree::Node& node = tree.nodes()[index];
        return (node.max.array() >= low.array()).all() &&
               (node.min.array() <= high.array()).all();
      },
      [&](int position) {
        contains = WindingNumber(
                       other, solid.seeds[tree.order()[position]] + shift) > 0;
        return !contains;
      });
  return contains;
}

// Does a facet of `robot` moved by `shift` meet one of `obstacle`?
bool FacetsMeet(const TestedSolid& obstacle, const TestedSolid& robot,
                const Kernel::Vector_3& shift) {
  const Eigen::Vector3d s(shift.x(), shift.y(), shift.z());
  // Exact, as are the sums.
  const auto overlap = [&s](const BoxTree::Node& fixed,
                            const BoxTree::Node& moved) {
    return (fixed.min.array() <= (moved.max + s).array()).all() &&
           (fixed.max.array() >= (moved.min + s).array()).all();
  };
  const std::vector<BoxTree::Node>& fixed = obstacle.facet_tree.nodes();
  const std::vector<BoxTree::Node>& moved = robot.facet_tree.nodes();
  bool meet = false;
  int placed = -1;  // position of the robot's facet that `at` is
  SolidFacet at;
  ForEachPair(
      robot.facet_tree, obstacle.facet_tree,
      [&](int i, int j) { return overlap(fixed[j], moved[i]); },
      [&](int k, int l) {
        if (k != placed) {
          const SolidFacet& t = robot.facets[robot.facet_tree.order()[k]];
          at = SolidFacet(t[0] + shift, t[1] + shift, t[2] + shift);
          placed = k;
        }
        const SolidFacet& u = obstacle.facets[obstacle.facet_tree.order()[l]];
        meet =
            CGAL::do_overlap(at.bbox(), u.bbox()) && CGAL::do_intersect(at, u);
        return !meet;
      });
  return meet;
}

}  // namespace

struct SolidCollision::Impl {
  TestedSolid obstacle, robot;
};

SolidCollision::SolidCollision(const GridSolid& obstacle,
                               const GridSolid& reflected_robot)
    : impl_(std::make_unique<Impl>()) {
  impl_->obstacle = MakeTested(obstacle, 1.0);
  impl_->robot = MakeTested(reflected_robot, -1.0);
  BuildTrees(&impl_->obstacle);
  BuildTrees(&impl_->robot);
}

SolidCollision::~SolidCollision() = default;

bool SolidCollision::Collide(const Eigen::Vector3d& q) const {
  const Eigen::Vector3d at = RoundedToFractions(q);
  const Kernel::Vector_3 shift(at[0], at[1], at[2]);
  return ContainsSeed(impl_->obstacle, impl_->robot, shift) ||
         ContainsSeed(impl_->robot, impl_->obstacle, -shift) ||
         FacetsMeet(impl_->obstacle, impl_->robot, shift);
}

}  // namespace phongpd::internal
