// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/minkowski/windows/depth_search.h"
#include "core/solid/solid.h"
#include "core/stopwatch.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Of the larger operand: beyond, a double no longer tells its vertices apart.
constexpr double kFarthest = 1e15;
// Of a way: what of it across the facet is rounding.
constexpr double kAcross = 1e-12;

std::string Described(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

// Nine tenths of the free memory, and messages with the operands' names.
ContactSpaceOptions LimitsOf(const std::string& robot,
                             const std::string& obstacle) {
  ContactSpaceOptions limits;
  limits.robot_name = robot;
  limits.obstacle_name = obstacle;
  return limits;
}

// The solids and their search at one orientation of the robot.
struct PlacedPair {
  PlacedPair(TriangleMesh the_robot, const std::string& robot_name,
             const Solid& obstacle)
      : robot(std::move(the_robot)),
        pair(internal::MakeGridPair(robot, robot_name, obstacle,
                                    obstacle.name(),
                                    internal::LatticeDivisor::kPowerOfTwo)),
        search(pair, LimitsOf(robot_name, obstacle.name())) {}

  TriangleMesh robot;  // turned
  internal::GridPair pair;
  internal::DepthSearch search;
};

Vector3d PointOf(const internal::FeaturePoint& point,
                 const std::vector<Vector3d>& vertices) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < point.count; ++k) {
    sum += point.weights[k] * vertices[point.vertices[k]];
  }
  return sum;
}

// The first vertex of `mesh` at the place of each vertex of `solid`.
std::vector<int> InputVertices(const TriangleMesh& mesh,
                               const TriangleMesh& solid) {
  std::map<std::array<double, 3>, int> ids;
  const auto key = [](const Vector3d& v) {
    return std::array<double, 3>{v[0], v[1], v[2]};
  };
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      int& id = ids.emplace(key(mesh.vertices[v]), v).first->second;
      id = std::min(id, v);
    }
  }
  std::vector<int> out;
  out.reserve(solid.vertices.size());
  for (const Vector3d& v : solid.vertices) out.push_back(ids.at(key(v)));
  return out;
}

const Solid& Present(const Solid& solid, const std::string& what) {
  RequireNotEmpty(solid, what);
  return solid;
}

}  // namespace

const char* ToString(DepthStatus status) {
  switch (status) {
    case DepthStatus::kPenetrating:
      return "penetrating";
    case DepthStatus::kTouching:
      return "touching";
    case DepthStatus::kSeparate:
      return "separate";
    case DepthStatus::kInvalid:
      break;
  }
  return "invalid";
}

const char* ToString(DepthLevel level) {
  switch (level) {
    case DepthLevel::kFull:
      return "full";
    case DepthLevel::kWindow:
      return "window";
    case DepthLevel::kNone:
      break;
  }
  return "none";
}

const char* ToString(ContactFeature::Kind kind) {
  constexpr const char* kNames[] = {"none", "vertex", "edge", "facet"};
  return kNames[kind];
}

struct DepthQuery::Impl {
  // The solids, and the meshes whose vertices features are told in.
  Impl(Solid the_robot, Solid the_obstacle, const TriangleMesh& given_robot,
       const TriangleMesh& given_obstacle, const DepthOptions& the_options)
      : options(the_options),
        robot(std::move(the_robot)),
        obstacle(std::move(the_obstacle)),
        robot_ids(InputVertices(given_robot, robot)),
        obstacle_ids(InputVertices(given_obstacle, obstacle)),
        unturned(robot, robot.name(), obstacle) {
    for (const Solid* solid : {&robot, &obstacle}) {
      for (const std::string& line :
           NamedWarnings(solid->report(), solid->name())) {
        warnings.push_back(line);
      }
    }
    if (!(options.max_radius > 0.0)) {
      throw InputError("max_radius: expected a length > 0, found " +
                       Described(options.max_radius));
    }
  }

  Depth Answer(const PlacedPair& placed, const Vector3d& q) const {
    const internal::GridFrame& frame = placed.pair.frame;
    const Vector3d x = frame.ToGrid(q);
    const double size = std::ldexp(frame.step, internal::kGridBits);
    if (!q.allFinite() ||
        !((q - frame.ToUser(Vector3d::Zero())).lpNorm<Eigen::Infinity>() <=
          kFarthest * size)) {
      throw InputError(robot.name() +
                       ": expected a finite position within 1e15 times the "
                       "operands' size, found " +
                       Described(q[0]) + "," + Described(q[1]) + "," +
                       Described(q[2]));
    }
    const internal::GridDepth found = placed.search.Find(
        x, {options.max_radius / frame.step, options.max_seconds});
    Depth result;
    result.grid_step = frame.rounding;
    result.arranged_faces = found.faces;
    result.windows = found.windows;
    for (const double reach : found.reaches) {
      result.window_reaches.push_back(reach * frame.step);
    }
    if (frame.is_turned) result.window_axes = frame.rotation.transpose();
    result.certified = found.is_certified;
    result.explored_radius = found.radius * frame.step;
    if (found.is_full) {
      result.level = DepthLevel::kFull;
    } else if (found.collides) {
      result.level = DepthLevel::kWindow;
    }
    const double length = found.distance * frame.step;
    const Vector3d way = found.point - x;
    Vector3d along = found.normal;
    const double across = (way - way.dot(along) * along).norm();
    // Straight through a facet the way is its normal, which is exact.
    if (found.distance > kShortWay &&
        !(found.collides && across <= kAcross * found.distance)) {
      along = way.normalized();
    }
    if (!found.collides) {
      result.status = DepthStatus::kSeparate;
      result.clearance = length;
      // Solids that share no point are apart, however little.
      if (!(length > 0.0)) result.clearance = frame.step * 0x1p-60;
      result.explored_radius = result.clearance;
      if (found.distance > kShortWay) along = -along;
    } else if (found.distance > 0.0) {
      result.status = DepthStatus::kPenetrating;
      result.depth = length;
    } else {
      result.status = DepthStatus::kTouching;
    }
    result.direction =
        frame.is_turned ? Vector3d(frame.rotation.transpose() * along) : along;
    result.contact = frame.ToUser(found.point);
    TellWitness(placed, found, q, &result);
    return result;
  }

  void TellWitness(const PlacedPair& placed, const internal::GridDepth& found,
                   const Vector3d& q, Depth* result) const {
    if (found.of_robot.count == 0) return;
    result->on_robot = PointOf(found.of_robot, placed.robot.vertices) + q;
    result->on_obstacle = PointOf(found.of_obstacle, obstacle.mesh().vertices);
    result->robot_feature = FeatureOf(found.of_robot, robot_ids);
    result->obstacle_feature = FeatureOf(found.of_obstacle, obstacle_ids);
  }

  static ContactFeature FeatureOf(const internal::FeaturePoint& point,
                                  const std::vector<int>& ids) {
    ContactFeature feature;
    feature.kind = static_cast<ContactFeature::Kind>(point.count);
    for (int k = 0; k < point.count; ++k) {
      feature.vertices[k] = ids[point.vertices[k]];
    }
    return feature;
  }

  // Grid steps: a way this short is rounding, and has no direction.
  static constexpr double kShortWay = 0x1p-4;

  DepthOptions options;
  std::vector<std::string> warnings;
  Solid robot, obstacle;
  std::vector<int> robot_ids, obstacle_ids;
  PlacedPair unturned;
};

DepthQuery::DepthQuery(const Solid& robot, const Solid& obstacle,
                       const DepthOptions& options)
    : impl_(std::make_unique<Impl>(Present(robot, "robot"),
                                   Present(obstacle, "obstacle"), robot,
                                   obstacle, options)) {}
DepthQuery::DepthQuery(const TriangleMesh& robot, const TriangleMesh& obstacle,
                       const DepthOptions& options)
    : impl_(std::make_unique<Impl>(MakeSolid(robot, options.robot_name),
                                   MakeSolid(obstacle, options.obstacle_name),
                                   robot, obstacle, options)) {}
DepthQuery::~DepthQuery() = default;
DepthQuery::DepthQuery(DepthQuery&&) noexcept = default;
DepthQuery& DepthQuery::operator=(DepthQuery&&) noexcept = default;

Depth DepthQuery::At(const Vector3d& q) const {
  const Stopwatch stopwatch;
  Depth result = impl_->Answer(impl_->unturned, q);
  result.seconds = stopwatch.Seconds();
  return result;
}

Depth DepthQuery::At(const RobotPose& pose) const {
  const Stopwatch stopwatch;
  CheckPose(pose, impl_->robot.name());
  // −1 and 1 are the same rotation: none.
  if (pose.orientation.vec().isZero(0.0)) return At(pose.position);
  const Eigen::Matrix3d rotation =
      pose.orientation.normalized().toRotationMatrix();
  const PlacedPair turned(Rotated(impl_->robot, rotation), impl_->robot.name(),
                          impl_->obstacle);
  Depth result = impl_->Answer(turned, pose.position);
  result.seconds = stopwatch.Seconds();
  return result;
}

const std::vector<std::string>& DepthQuery::warnings() const {
  return impl_->warnings;
}

Depth PenetrationDepth(const Solid& robot, const Solid& obstacle,
                       const RobotPose& pose, const DepthOptions& options) {
  return DepthQuery(robot, obstacle, options).At(pose);
}

Depth PenetrationDepth(const TriangleMesh& robot, const TriangleMesh& obstacle,
                       const RobotPose& pose, const DepthOptions& options) {
  return DepthQuery(robot, obstacle, options).At(pose);
}

}  // namespace phongpd
