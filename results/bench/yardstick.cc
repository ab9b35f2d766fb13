// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/yardstick.h"

#include <algorithm>
#include <cmath>

#include "core/bvh/closest_on_triangle.h"
#include "core/bvh/segment_triangle_distance.h"
#include "core/projection/phong_field.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr double kLongestEdge = 0.04;  // of D
constexpr double kSlack = 2.5;         // steps of the robot

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// A connected part of what is in reach.
struct Piece {
  std::vector<int> triangles;
  double least = 0.0;  // distance from the robot's position
};

}  // namespace

struct Yardstick::Impl {
  explicit Impl(const ContactSpace& contact) : length(contact.length()) {
    PhongFieldOptions options = PhongFieldOptions::Unsmoothed();
    options.max_edge = kLongestEdge;
    const PhongField field = BuildPhongField(contact, options);
    mesh = field.mesh;
    for (Vector3d& v : mesh.vertices) v = field.FromField(v);
    neighbors = field.neighbors;
    for (const Triangle& t : mesh.triangles) {
      const Vector3d middle = (Corner(t, 0) + Corner(t, 1) + Corner(t, 2)) / 3;
      centers.push_back(middle);
      radii.push_back(std::max({(Corner(t, 0) - middle).norm(),
                                (Corner(t, 1) - middle).norm(),
                                (Corner(t, 2) - middle).norm()}));
    }
  }

  const Vector3d& Corner(const Triangle& t, int k) const {
    return mesh.vertices[Index(t[Index(k)])];
  }

  std::vector<double> Distances(const Vector3d& q) const {
    std::vector<double> distances;
    distances.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      distances.push_back(std::sqrt(
          ClosestOnTriangle(Corner(t, 0), Corner(t, 1), Corner(t, 2), q)
              .squared_distance));
    }
    return distances;
  }

  // Triangles in reach, by the edges they share.
  std::vector<Piece> Pieces(const std::vector<double>& distances,
                            double reach) const {
    std::vector<Piece> pieces;
    std::vector<char> seen(distances.size(), 0);
    std::vector<int> stack;
    for (std::size_t seed = 0; seed < distances.size(); ++seed) {
      if (seen[seed] != 0 || distances[seed] > reach) continue;
      Piece piece;
      piece.least = distances[seed];
      seen[seed] = 1;
      stack.assign(1, static_cast<int>(seed));
      while (!stack.empty()) {
        const int t = stack.back();
        stack.pop_back();
        piece.triangles.push_back(t);
        piece.least = std::min(piece.least, distances[Index(t)]);
        for (const int other : neighbors[Index(t)]) {
          if (other < 0 || seen[Index(other)] != 0) continue;
          if (distances[Index(other)] > reach) continue;
          seen[Index(other)] = 1;
          stack.push_back(other);
        }
      }
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  // Is some edge of `a` within `limit` of `b`?
  bool EdgeComesNear(int a, int b, double limit) const {
    const Triangle& s = mesh.triangles[Index(a)];
    const Triangle& t = mesh.triangles[Index(b)];
    for (int k = 0; k < 3; ++k) {
      const double squared =
          ClosestPair(Corner(s, k), Corner(s, (k + 1) % 3), Corner(t, 0),
                      Corner(t, 1), Corner(t, 2))
              .squared_distance;
      if (squared <= limit * limit) return true;
    }
    return false;
  }

  bool ComeNear(const Piece& piece, const std::vector<char>& is_reached,
                const std::vector<int>& reached, double limit) const {
    for (const int t : piece.triangles) {
      if (is_reached[Index(t)] != 0) return true;
    }
    for (const int a : piece.triangles) {
      for (const int b : reached) {
        const double apart = (centers[Index(a)] - centers[Index(b)]).norm() -
                             radii[Index(a)] - radii[Index(b)];
        if (apart > limit) continue;
        if (EdgeComesNear(a, b, limit) || EdgeComesNear(b, a, limit)) {
          return true;
        }
      }
    }
    return false;
  }

  double length;
  TriangleMesh mesh;
  std::vector<std::array<int, 3>> neighbors;
  std::vector<Vector3d> centers;
  std::vector<double> radii;
};

Yardstick::Yardstick(const ContactSpace& contact)
    : impl_(std::make_unique<Impl>(contact)) {}
Yardstick::~Yardstick() = default;

std::vector<int> Yardstick::LeastJumps(
    const Motion& motion, const std::vector<double>& depths,
    const std::vector<double>& ratios) const {
  const double jump = kMotionJump * impl_->length;
  std::vector<int> jumps(ratios.size(), 0);
  // Triangles that can be had without a jump; none: the robot is outside.
  std::vector<std::vector<int>> reached(ratios.size());
  std::vector<char> is_reached(impl_->mesh.triangles.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double step = i == 0 ? 0.0 : (motion[i] - motion[i - 1]).norm();
    const double next =
        i + 1 == motion.size() ? 0.0 : (motion[i + 1] - motion[i]).norm();
    const bool is_inside = depths[i] > 0.0;
    const std::vector<double> distances =
        is_inside ? impl_->Distances(motion[i]) : std::vector<double>();
    for (std::size_t c = 0; c < ratios.size(); ++c) {
      std::vector<int>& now = reached[c];
      if (!is_inside) {
        now.clear();  // what was near enough to leave is not counted
        continue;
      }
      const double reach =
          ratios[c] * depths[i] + kSlack * std::max(step, next);
      const std::vector<Piece> pieces = impl_->Pieces(distances, reach);
      std::fill(is_reached.begin(), is_reached.end(), 0);
      for (const int t : now) is_reached[Index(t)] = 1;
      std::vector<int> then;
      const bool is_entry = now.empty();
      for (const Piece& piece : pieces) {
        const bool can_be_had =
            is_entry || impl_->ComeNear(piece, is_reached, now, jump + step);
        if (!can_be_had) continue;
        then.insert(then.end(), piece.triangles.begin(), piece.triangles.end());
      }
      if (then.empty()) {
        ++jumps[c];
        for (const Piece& piece : pieces) {
          then.insert(then.end(), piece.triangles.begin(),
                      piece.triangles.end());
        }
      }
      now = std::move(then);
    }
  }
  return jumps;
}

}  // namespace phongpd::bench
