// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/feature_contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/bvh/closest_on_triangle.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A slope within a surface, relative to the lengths, that is none.
constexpr double kLevel = 1e-9;
// Of the length of an edge, off its ends.
constexpr double kInside = 1e-9;

// A part of a surface: a triangle, an edge or a corner of it.
struct Feature {
  enum Kind { kFace, kEdge, kPoint } kind = kFace;
  std::size_t number = 0;

  bool operator<(const Feature& other) const {
    return std::pair(kind, number) < std::pair(other.kind, other.number);
  }
};

// Where the point Σ λ_i q_i of a triangle lies.
Feature FeatureAt(const SurfaceFeatures& surface, std::size_t triangle,
                  const Vector3d& lambda) {
  int zeros = 0;
  for (const double x : lambda) zeros += x <= 0.0;
  if (zeros == 0) return {Feature::kFace, triangle};
  Eigen::Index k = 0;
  if (zeros == 1) {  // opposite of the corner that has no part
    lambda.minCoeff(&k);
    const auto edge = static_cast<std::size_t>(k + 1) % 3;
    return {Feature::kEdge, surface.edges[triangle][edge]};
  }
  lambda.maxCoeff(&k);
  return {Feature::kPoint,
          surface.corners[triangle][static_cast<std::size_t>(k)]};
}

// Parameters s, t of the closest points of two lines a + s u, b + t v; false
// where they are parallel.
bool ClosestOfLines(const Vector3d& a, const Vector3d& u, const Vector3d& b,
                    const Vector3d& v, double* s, double* t) {
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double det = uu * vv - uv * uv;
  if (!(det > 1e-12 * uu * vv)) return false;
  const Vector3d between = b - a;
  const double bu = between.dot(u), bv = between.dot(v);
  *s = (bu * vv - bv * uv) / det;
  *t = (bu * uv - bv * uu) / det;
  return true;
}

bool IsInside(double share) { return share > kInside && share < 1.0 - kInside; }

class Search {
 public:
  Search(const SurfaceFeatures& robot, const SurfaceFeatures& obstacle,
         const RobotPose& pose, double radius,
         std::vector<PoseContact>* contacts)
      : robot_(robot),
        obstacle_(obstacle),
        rotation_(pose.orientation.toRotationMatrix()),
        position_(pose.position),
        radius_(radius),
        contacts_(*contacts) {}

  void Visit(std::size_t i, std::size_t j, const TriangleCorners& a,
             const TriangleCorners& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d mine = ClosestOnTriangle(b[0], b[1], b[2], a[k]).lambda;
      Keep({Feature::kPoint, robot_.corners[i][k]},
           FeatureAt(obstacle_, j, mine), a[k],
           mine[0] * b[0] + mine[1] * b[1] + mine[2] * b[2]);
      const Vector3d its = ClosestOnTriangle(a[0], a[1], a[2], b[k]).lambda;
      Keep(FeatureAt(robot_, i, its),
           {Feature::kPoint, obstacle_.corners[j][k]},
           its[0] * a[0] + its[1] * a[1] + its[2] * a[2], b[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l) {
        const Vector3d u = a[(k + 1) % 3] - a[k], v = b[(l + 1) % 3] - b[l];
        double s = 0.0, t = 0.0;
        if (!ClosestOfLines(a[k], u, b[l], v, &s, &t)) continue;
        if (!IsInside(s) || !IsInside(t)) continue;
        Keep({Feature::kEdge, robot_.edges[i][k]},
             {Feature::kEdge, obstacle_.edges[j][l]}, a[k] + s * u,
             b[l] + t * v);
      }
    }
  }

 private:
  void Keep(const Feature& mine, const Feature& its, const Vector3d& on_robot,
            const Vector3d& on_obstacle) {
    const double gap = (on_robot - on_obstacle).norm();
    if (!(gap > 0.0 && gap <= radius_)) return;
    if (!known_.insert({mine, its}).second) return;
    const Vector3d n = (on_robot - on_obstacle) / gap;
    for (const std::size_t w : Around(robot_, mine)) {
      const Vector3d way = rotation_ * robot_.points[w] + position_ - on_robot;
      if (n.dot(way) < -kLevel * way.norm()) return;
    }
    for (const std::size_t w : Around(obstacle_, its)) {
      const Vector3d way = obstacle_.points[w] - on_obstacle;
      if (n.dot(way) > kLevel * way.norm()) return;
    }
    contacts_.push_back({n, on_robot - position_, gap});
  }

  static const std::vector<std::size_t>& Around(const SurfaceFeatures& surface,
                                                const Feature& feature) {
    static const std::vector<std::size_t> kNone;
    if (feature.kind == Feature::kFace) return kNone;
    return feature.kind == Feature::kEdge
               ? surface.around_edge[feature.number]
               : surface.around_point[feature.number];
  }

  const SurfaceFeatures& robot_;
  const SurfaceFeatures& obstacle_;
  const Matrix3d rotation_;
  const Vector3d position_;
  const double radius_;
  std::vector<PoseContact>& contacts_;
  std::set<std::pair<Feature, Feature>> known_;
};

}  // namespace

SurfaceFeatures::SurfaceFeatures(const ContactSurface& surface) {
  std::map<std::array<double, 3>, std::size_t> numbers;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edge_numbers;
  for (const TriangleCorners& triangle : surface.corners) {
    std::array<std::size_t, 3> own{}, own_edges{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = triangle[k];
      const auto [at, is_new] =
          numbers.insert({{p.x(), p.y(), p.z()}, points.size()});
      if (is_new) points.push_back(p);
      own[k] = at->second;
    }
    around_point.resize(points.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = own[k], to = own[(k + 1) % 3];
      const auto [at, is_new] =
          edge_numbers.insert({std::minmax(from, to), around_edge.size()});
      if (is_new) around_edge.emplace_back();
      own_edges[k] = at->second;
      around_edge[at->second].push_back(own[(k + 2) % 3]);
      around_point[from].push_back(to);
      around_point[from].push_back(own[(k + 2) % 3]);
    }
    corners.push_back(own);
    edges.push_back(own_edges);
  }
}

bool FeatureContacts::Find(const RobotPose& pose, double radius,
                           std::vector<PoseContact>* contacts, long* tests,
                           RigidStop* stop) const {
  contacts->clear();
  Search search(robot_features_, obstacle_features_, pose, radius, contacts);
  const auto visit = [&](std::size_t i, std::size_t j,
                         const TriangleCorners& placed) {
    search.Visit(i, j, placed, obstacle_.corners[j]);
  };
  const bool is_whole =
      ForEachClosePair(robot_, obstacle_, pose, radius, visit, tests, stop);
  std::sort(
      contacts->begin(), contacts->end(),
      [](const PoseContact& a, const PoseContact& b) { return a.gap < b.gap; });
  return is_whole;
}

}  // namespace phongpd::internal
