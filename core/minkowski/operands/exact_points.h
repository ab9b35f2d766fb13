// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <unordered_map>
#include <vector>

#include "core/minkowski/operands/exact_grid.h"

// Exact points of the arrangement.  No point is ever constructed from rounded
// or other constructed points: each is defined by grid integers alone, so all
// predicates are polynomials of bounded degree, evaluated in double first and
// in fixed-width integers when the rounding could decide.
namespace phongpd::internal {

// Wide enough for every product below: 283-bit coordinates times 243-bit
// denominators, and products of two normals' cross products.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<
        640, 640, boost::multiprecision::signed_magnitude,
        boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

// The plane normal·x = offset; |normal| < 2^80, |offset| < 2^122.
struct GridPlane {
  GridNormal normal{};
  Int128 offset = 0;
  bool operator==(const GridPlane& o) const {
    return normal == o.normal && offset == o.offset;
  }
};
struct GridPlaneHash {
  std::size_t operator()(const GridPlane& plane) const;
};

inline Wide WideDot(const GridNormal& a, const GridNormal& b) {
  return Wide(a[0]) * Wide(b[0]) + Wide(a[1]) * Wide(b[1]) +
         Wide(a[2]) * Wide(b[2]);
}
std::array<Wide, 3> WideCross(const GridNormal& a, const GridNormal& b);

// What defines a point.
struct PointDefinition {
  enum Kind : int {
    kVertex,  // a grid point: a
    kEdge,  // edge a–b cuts a plane: a + (b − a)·side_a/(side_a − side_b)
    kPlanes,  // three planes meet
  };
  Kind kind = kVertex;
  GridPoint a{}, b{};
  Int128 side_a = 0, side_b = 0;
  std::array<GridPlane, 3> planes{};
};

// x/w with w > 0.
struct Homogeneous {
  std::array<Wide, 3> x;
  Wide w;
};
Homogeneous Evaluate(const PointDefinition& point);

// Coordinates with an error of at most kPointError grid steps each.
inline constexpr double kPointError = 0x1p-10;
Eigen::Vector3d Approximate(const PointDefinition& point);

// A point with its approximation: what predicates take.
struct LocatedPoint {
  PointDefinition definition;
  Eigen::Vector3d approximate = Eigen::Vector3d::Zero();
};
LocatedPoint Locate(const PointDefinition& definition);

// The doubles nearest to the coordinates divided by `units` > 0 (ties to even):
// they depend on the point alone, not on its definition.
Eigen::Vector3d NearestDoubles(const PointDefinition& point, int units = 1);

// Sign of p[axis] − q[axis]; exact.
int CompareCoordinate(const LocatedPoint& p, const LocatedPoint& q, int axis);

// A plane in double: what tells the side of nearly every point.
class RoundedPlane {
 public:
  RoundedPlane() = default;
  explicit RoundedPlane(const GridPlane& plane);

  // Sign of normal·x − offset for a point of the grid or one that is known up
  // to kPointError; 0 where rounding could decide.
  int Side(const Eigen::Vector3d& x) const {
    const double value = normal_.dot(x) - offset_;
    return value > error_ ? 1 : value < -error_ ? -1 : 0;
  }

 private:
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  double offset_ = 0.0, error_ = 0.0;
};

// Sign of normal·p − offset; exact.
int SideOf(const GridPlane& plane, const LocatedPoint& p);
// The same where RoundedPlane does not tell.
int ExactSideOf(const GridPlane& plane, const PointDefinition& p);

bool SamePoint(const LocatedPoint& p, const LocatedPoint& q);

// Hash cells to find equal points again; equal points may have different
// approximations, so a point looks into every cell that comes near.
GridPoint HomeCell(const Eigen::Vector3d& approximate);
template <typename Visit>
void ForEachNearCell(const Eigen::Vector3d& approximate, const Visit& visit) {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(2 * kPointError);
  const GridPoint low = HomeCell(approximate - reach);
  const GridPoint high = HomeCell(approximate + reach);
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) visit({x, y, z});
    }
  }
}

// All distinct points of an arrangement, each with one id.  A point is found
// again by a hash of its approximation and told apart exactly.
class ExactPoints {
 public:
  // The id of `p`, new or known.
  int Add(const LocatedPoint& p);
  // The id of an equal point, or −1.
  int Find(const LocatedPoint& p) const;

  LocatedPoint operator[](int id) const;
  const Eigen::Vector3d& Approximate(int id) const { return approximate_[id]; }
  int size() const { return static_cast<int>(approximate_.size()); }

 private:
  struct EdgePoint {
    GridPoint a, b;
    Int128 side_a, side_b;
  };
  // Definitions are stored by kind: most points are not of the widest.
  struct Entry {
    PointDefinition::Kind kind;
    int index;
  };

  std::vector<Eigen::Vector3d> approximate_;
  std::vector<Entry> entries_;
  std::vector<GridPoint> vertex_points_;
  std::vector<EdgePoint> edge_points_;
  std::vector<std::array<int, 3>> plane_points_;  // into planes_
  std::vector<GridPlane> planes_;
  std::unordered_map<GridPlane, int, GridPlaneHash> plane_ids_;
  std::unordered_multimap<GridPoint, int, GridPointHash> cells_;
};

}  // namespace phongpd::internal
