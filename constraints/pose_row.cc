// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/pose_row.h"

#include <Eigen/Geometry>
#include <cmath>

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Rounding of an answer is 1e-14 of the solids, the third derivative of a
// rotation about one: 1e-5 makes both 1e-9 and less.
constexpr double kStep = 1e-5;
// Sine of the angle between the direction and the normal of its one contact:
// far above rounding, far below what two contacts make by chance.
constexpr double kParallel = 1e-7;

// Corner k of a feature in place.
Vector3d Corner(const TriangleMesh& mesh, const ContactFeature& feature,
                std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(feature.vertices[k])];
}

Vector3d Normal(const TriangleMesh& mesh, const ContactFeature& facet) {
  const Vector3d a = Corner(mesh, facet, 0);
  return (Corner(mesh, facet, 1) - a)
      .cross(Corner(mesh, facet, 2) - a)
      .stableNormalized();
}

Vector3d Along(const TriangleMesh& mesh, const ContactFeature& edge) {
  return (Corner(mesh, edge, 1) - Corner(mesh, edge, 0)).stableNormalized();
}

}  // namespace

PoseRow::PoseRow(const Solid& robot, const Solid& obstacle,
                 const DepthOptions& options)
    : query_(robot, obstacle, options), robot_(robot), obstacle_(obstacle) {}

Vector3d PoseRow::ContactNormal(const RobotPose& pose,
                                const Depth& result) const {
  const ContactFeature& a = result.robot_feature;
  const ContactFeature& b = result.obstacle_feature;
  if (b.kind == ContactFeature::kFacet) return Normal(obstacle_, b);
  if (a.kind == ContactFeature::kFacet) {
    return pose.orientation * Normal(robot_, a);
  }
  if (a.kind == ContactFeature::kEdge && b.kind == ContactFeature::kEdge) {
    const Vector3d turned = pose.orientation * Along(robot_, a);
    return turned.cross(Along(obstacle_, b)).stableNormalized();
  }
  return Vector3d::Zero();
}

Vector3d PoseRow::Differences(const RobotPose& pose) const {
  Vector3d slope;
  for (int k = 0; k < 3; ++k) {
    const auto turned = [&](double angle) {
      RobotPose other = pose;
      other.orientation =
          Eigen::AngleAxisd(angle, Vector3d::Unit(k)) * pose.orientation;
      return query_.At(other).SignedDistance();
    };
    slope[k] = (turned(kStep) - turned(-kStep)) / (2.0 * kStep);
  }
  return slope;
}

PoseRowValue PoseRow::At(const RobotPose& pose) const {
  const Depth result = query_.At(pose);
  PoseRowValue row;
  row.value = result.SignedDistance();
  row.by_translation = result.direction;
  row.status = result.status;
  row.certified = result.certified;
  if (result.robot_feature.kind == ContactFeature::kNone ||
      result.obstacle_feature.kind == ContactFeature::kNone) {
    return row;
  }
  const Vector3d normal = ContactNormal(pose, result);
  const bool is_one_contact =
      normal != Vector3d::Zero() &&
      normal.cross(result.direction).norm() <= kParallel;
  if (result.status == DepthStatus::kSeparate || is_one_contact) {
    const Vector3d r = result.on_robot - pose.position;
    row.by_rotation = r.cross(result.direction);
    row.source = RotationSource::kContact;
  } else {
    row.by_rotation = Differences(pose);
    row.source = RotationSource::kDifferences;
  }
  return row;
}

}  // namespace phongpd
