// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/surface_refinement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>
#include <sstream>
#include <utility>
#include <vector>

#include "core/contact_space/edge_length_field.h"
#include "core/contact_space/patch_mesh.h"

namespace phongpd {
namespace internal {
namespace {

using Eigen::Vector3d;

constexpr double kMaxTriangles = 4e6;
// Bound on circumradius / shortest edge; from √2 on Delaunay refinement ends
// by itself except at sharp corners.
const double kMaxRatio = std::sqrt(2.0);
// Vertices put in for quality keep this distance from others, in h.
constexpr double kSpacing = 0.25;

void CheckSize(double triangles, const RefineOptions& options) {
  if (triangles <= kMaxTriangles) return;
  std::ostringstream out;
  out << "option refine.target_edge: " << options.target_edge
      << " of the diagonal needs more than " << kMaxTriangles
      << " triangles; set a larger one";
  throw InputError(out.str());
}

Vector3d Circumcenter(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a;
  const Vector3d normal = ab.cross(ac);
  return a + (ac.squaredNorm() * normal.cross(ab) +
              ab.squaredNorm() * ac.cross(normal)) /
                 (2.0 * normal.squaredNorm());
}

class Refiner {
 public:
  Refiner(const RefineOptions& options, PatchMesh* mesh, double diagonal)
      : options_(options),
        mesh_(*mesh),
        length_(mesh->SharpEdges(options.sharp_angle_degrees * M_PI / 180.0),
                options.target_edge * diagonal, options.grading) {}

  void Run() {
    std::vector<int> changed(mesh_.Count());
    for (int t = 0; t < mesh_.Count(); ++t) changed[t] = t;
    Update(&changed);
    while (!queue_.empty()) {
      const int t = queue_.top().second;
      queue_.pop();
      const Verdict verdict = Judge(t);
      if (verdict.kind == Verdict::kGood) continue;
      changed.clear();
      if (!Improve(t, verdict.kind == Verdict::kPoor, &changed) &&
          verdict.kind == Verdict::kTooLong) {
        mesh_.SplitEdge(verdict.edge, &changed);
      }
      Update(&changed);
    }
  }

 private:
  using Edge = PatchMesh::Edge;

  struct Verdict {
    enum { kGood, kTooLong, kPoor } kind;
    Edge edge;  // the one that is too long
  };

  double Length(Edge e) const {
    return (mesh_.Point(e.triangle, e.k) - mesh_.Point(e.triangle, e.k + 1))
        .norm();
  }
  double LengthWantedAt(Edge e) const {
    return length_(0.5 * (mesh_.Point(e.triangle, e.k) +
                          mesh_.Point(e.triangle, e.k + 1)));
  }

  Verdict Judge(int t) const {
    if (mesh_.IsFrozen(t)) return {Verdict::kGood, {}};
    double lengths[3];
    int shortest = 0;
    Edge worst;
    double excess = 1.0;
    for (int k = 0; k < 3; ++k) {
      lengths[k] = Length({t, k});
      if (lengths[k] < lengths[shortest]) shortest = k;
      if (lengths[k] <= length_.Least()) continue;
      const double ratio = lengths[k] / LengthWantedAt({t, k});
      if (ratio <= excess || !mesh_.CanSplit({t, k})) continue;
      excess = ratio;
      worst = {t, k};
    }
    if (worst.triangle >= 0) return {Verdict::kTooLong, worst};
    const double area = 0.5 * (mesh_.Point(t, 1) - mesh_.Point(t, 0))
                                  .cross(mesh_.Point(t, 2) - mesh_.Point(t, 0))
                                  .norm();
    const double radius = lengths[0] * lengths[1] * lengths[2] / (4.0 * area);
    if (radius <= kMaxRatio * lengths[shortest]) return {Verdict::kGood, {}};
    // The smallest angle is opposite the shortest edge.
    const bool is_corner = mesh_.IsFixed({t, (shortest + 1) % 3}) &&
                           mesh_.IsFixed({t, (shortest + 2) % 3});
    return {is_corner ? Verdict::kGood : Verdict::kPoor, {}};
  }

  // Splits a fixed edge that is in the way, unless its halves were too short.
  bool SplitFixed(Edge e, std::vector<int>* changed) {
    return Length(e) >= 2.0 * kSpacing * LengthWantedAt(e) &&
           mesh_.SplitEdge(e, changed);
  }

  // Puts a vertex at t's circumcentre, or on a fixed edge that is in the way.
  bool Improve(int t, bool keep_distance, std::vector<int>* changed) {
    const Vector3d center =
        Circumcenter(mesh_.Point(t, 0), mesh_.Point(t, 1), mesh_.Point(t, 2));
    if (!center.allFinite()) return false;
    const Vector3d x = mesh_.Plane(t).Nearest(center);
    if (!x.allFinite()) return false;
    if (keep_distance &&
        (x - mesh_.Point(t, 0)).norm() < kSpacing * length_(x)) {
      return false;
    }
    const Edge end = mesh_.Walk(t, x);
    if (end.triangle < 0) return false;
    if (end.k >= 0) return SplitFixed(end, changed);
    const Edge encroached = LongestEncroached(end.triangle, x);
    if (encroached.triangle >= 0) return SplitFixed(encroached, changed);
    return mesh_.InsertPoint(end.triangle, x, changed);
  }

  // Of the fixed edges that would bound x's star the longest one that sees x
  // at an obtuse angle.
  Edge LongestEncroached(int start, const Vector3d& x) {
    ++round_;
    visited_.resize(mesh_.Count(), 0);
    visited_[start] = round_;
    std::vector<int> stack = {start};
    Edge longest;
    while (!stack.empty()) {
      const int t = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Edge e{t, k};
        const Vector3d &a = mesh_.Point(t, k), &b = mesh_.Point(t, k + 1);
        if (mesh_.IsFixed(e)) {
          if ((a - x).dot(b - x) < 0.0 &&
              (longest.triangle < 0 || Length(e) > Length(longest))) {
            longest = e;
          }
          continue;
        }
        const Edge f = mesh_.Opposite(e);
        if (visited_[f.triangle] == round_ ||
            !PatchMesh::InCircle(a, b, x, mesh_.Point(f.triangle, f.k + 2))) {
          continue;
        }
        visited_[f.triangle] = round_;
        stack.push_back(f.triangle);
      }
    }
    return longest;
  }

  void Update(std::vector<int>* changed) {
    if (changed->empty()) return;
    CheckSize(mesh_.Count(), options_);
    mesh_.Legalize(changed);
    std::sort(changed->begin(), changed->end());
    changed->erase(std::unique(changed->begin(), changed->end()),
                   changed->end());
    for (const int t : *changed) {
      if (Judge(t).kind == Verdict::kGood) continue;
      // Large ones first: what they are cut into may need no more.
      queue_.emplace(std::max({Length({t, 0}), Length({t, 1}), Length({t, 2})}),
                     t);
    }
  }

  const RefineOptions& options_;
  PatchMesh& mesh_;
  EdgeLengthField length_;
  std::priority_queue<std::pair<double, int>> queue_;
  std::vector<int> visited_;  // round in which a triangle was last seen
  int round_ = 0;
};

}  // namespace

void RefineSurface(const RefineOptions& options, ContactSpace* space) {
  const double diagonal = ComputeBounds(space->mesh).Diagonal();
  const double longest = options.target_edge * diagonal;
  // No triangle is larger than the equilateral one: refuse before trying.
  CheckSize(
      SurfaceArea(space->mesh) / longest / longest / (0.25 * std::sqrt(3.0)),
      options);
  PatchMesh mesh(*space);
  Refiner(options, &mesh, diagonal * mesh.Scale()).Run();
  mesh.Store(space);
}

}  // namespace internal

void RefineOptions::Validate() const {
  const auto check = [](const char* name, double value, bool ok,
                        const char* range) {
    if (ok) return;
    std::ostringstream out;
    out << "option refine." << name << " must be in " << range << ", found "
        << value;
    throw InputError(out.str());
  };
  // Written so that NaN fails.
  check("target_edge", target_edge, target_edge >= 0.0 && target_edge <= 1.0,
        "[0, 1]");
  check("grading", grading, grading > 0.0 && grading <= 1.0, "(0, 1]");
  check("sharp_angle_degrees", sharp_angle_degrees,
        sharp_angle_degrees >= 0.0 && sharp_angle_degrees <= 180.0, "[0, 180]");
}

}  // namespace phongpd
