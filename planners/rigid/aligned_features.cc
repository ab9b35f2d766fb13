// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/aligned_features.h"

#include <algorithm>
#include <map>
#include <utility>

#include "constraints/rigid/distinct_triangles.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Faces that turn by less are one: the sine of the angle between them.
constexpr double kFlatSine = 1e-3;

// Of twice the area, by the longest edge squared: such a face has no normal.
constexpr double kThinTriangle = 1e-9;

// Zero where the triangle is too thin.
Vector3d UnitNormalOf(const TriangleMesh& mesh, const Triangle& t) {
  const auto corner = [&](std::size_t k) {
    return mesh.vertices[static_cast<std::size_t>(t[k])];
  };
  const Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
  const Vector3d normal = a.cross(b);
  const double longest =
      std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  if (!(normal.norm() > kThinTriangle * longest)) return Vector3d::Zero();
  return normal.normalized();
}

// A face at an edge, and which way it goes from there.
struct EdgeFace {
  Vector3d normal, inward;
};

// One plane goes on beyond the edge, whichever sides the faces show.
bool AreFlat(const std::vector<EdgeFace>& at) {
  return at.size() == 2 &&
         at[0].normal.cross(at[1].normal).norm() < kFlatSine &&
         at[0].inward.dot(at[1].inward) < 0.0;
}

void AddFeatures(const TriangleMesh& mesh, std::vector<EdgeFeature>* features) {
  std::map<std::pair<int, int>, std::vector<EdgeFace>> faces;
  for (const std::size_t i : DistinctTriangles(CornersOf(mesh))) {
    const Triangle& t = mesh.triangles[i];
    const Vector3d normal = UnitNormalOf(mesh, t);
    if (normal.isZero()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      const Vector3d& from = mesh.vertices[static_cast<std::size_t>(low)];
      const Vector3d along =
          (mesh.vertices[static_cast<std::size_t>(high)] - from).normalized();
      const Vector3d inward =
          mesh.vertices[static_cast<std::size_t>(t[(k + 2) % 3])] - from;
      faces[{low, high}].push_back(
          {normal, inward - inward.dot(along) * along});
    }
  }
  for (const auto& [edge, at] : faces) {
    if (AreFlat(at)) continue;
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(edge.first)];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(edge.second)];
    const Vector3d along = (b - a).normalized();
    for (const EdgeFace& face : at) {
      const Vector3d across = face.normal - face.normal.dot(along) * along;
      features->push_back({a, b, along, across.normalized()});
    }
  }
}

std::vector<EdgeFeature> FeaturesOf(const std::vector<TriangleMesh>& meshes) {
  std::vector<EdgeFeature> features;
  for (const TriangleMesh& mesh : meshes) AddFeatures(mesh, &features);
  return features;
}

const EdgeFeature& DrawOne(const std::vector<EdgeFeature>& features,
                           std::mt19937_64* random) {
  return features[(*random)() % features.size()];
}

Matrix3d FrameOf(const Vector3d& along, const Vector3d& normal) {
  Matrix3d frame;
  frame << along, normal, along.cross(normal);
  return frame;
}

}  // namespace

AlignedFeatures::AlignedFeatures(const std::vector<TriangleMesh>& robot,
                                 const std::vector<TriangleMesh>& obstacles)
    : robot_(FeaturesOf(robot)), obstacles_(FeaturesOf(obstacles)) {}

RobotPose AlignedFeatures::Draw(std::mt19937_64* random,
                                Vector3d* along) const {
  const EdgeFeature& mine = DrawOne(robot_, random);
  const EdgeFeature& its = DrawOne(obstacles_, random);
  const std::uint64_t bits = (*random)();
  const double turned = (bits & 1) != 0 ? -1.0 : 1.0;
  const double against = (bits & 2) != 0 ? -1.0 : 1.0;
  const Matrix3d rotation = FrameOf(turned * its.along, against * its.normal) *
                            FrameOf(mine.along, mine.normal).transpose();
  *along = its.along;
  RobotPose pose;
  pose.orientation = Eigen::Quaterniond(rotation).normalized();
  const Vector3d& place = (bits & 4) != 0 ? its.start : its.end;
  const Vector3d& corner = (bits & 8) != 0 ? mine.start : mine.end;
  pose.position = place - pose.orientation * corner;
  return pose;
}

}  // namespace phongpd::internal
