// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/window_phong.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/bvh/closest_on_triangle.h"
#include "core/bvh/triangle_corners.h"
#include "core/mesh/union_find.h"
#include "core/projection/window_reach.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Shares of D: triangles that are lower have normals that depend on where the
// field's frame is.
constexpr double kLowest = 1e-6;

// On its longest side.
double Altitude(const TriangleCorners& c) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (c[(k + 1) % 3] - c[k]).norm());
  }
  return longest > 0.0 ? (c[1] - c[0]).cross(c[2] - c[0]).norm() / longest
                       : 0.0;
}

// Which triangles have the whole's field: their patch is not cut by a wall,
// neither are those around their corners, and no sliver is there.
std::vector<char> OfTheWhole(const ContactSpace& space,
                             const std::vector<TriangleCorners>& corners,
                             double lowest) {
  const TriangleMesh& mesh = space.mesh();
  const std::vector<ContactKind>& kind = space.kind();
  const auto size = static_cast<int>(mesh.triangles.size());
  const auto is_wall = [&](int t) { return kind[t] == ContactKind::kNone; };
  internal::UnionFind patches(mesh.triangles.size());
  const auto neighbors = TriangleNeighbors(mesh);
  for (int t = 0; t < size; ++t) {
    for (const int n : neighbors[t]) {
      if (space.plane()[n] == space.plane()[t]) patches.Join(t, n);
    }
  }
  std::vector<char> is_cut(size, 0);
  for (int t = 0; t < size; ++t) {
    for (const int n : neighbors[t]) {
      if (is_wall(t) || is_wall(n)) is_cut[patches.Find(t)] = 1;
    }
  }
  std::vector<char> is_whole_around(mesh.vertices.size(), 1);
  for (int t = 0; t < size; ++t) {
    if (is_cut[patches.Find(t)] == 0 && Altitude(corners[t]) >= lowest) {
      continue;
    }
    for (const int v : mesh.triangles[t]) is_whole_around[v] = 0;
  }
  std::vector<char> is_whole(size, 1);
  for (int t = 0; t < size; ++t) {
    for (const int v : mesh.triangles[t]) {
      if (is_whole_around[v] == 0) is_whole[t] = 0;
    }
  }
  return is_whole;
}

}  // namespace

struct WindowPhong::Impl {
  // Boxes that hold all of a cube, grid steps, and what is known there.
  struct Window {
    Window(ContactSpace the_space, const BoundingBox& the_cube, double lowest,
           const PhongMetricOptions& options)
        : space(std::move(the_space)), cube(the_cube), metric(space, options) {
      const std::vector<TriangleCorners> corners = CornersOf(space.mesh());
      is_whole = OfTheWhole(space, corners, lowest);
      for (std::size_t t = 0; t < corners.size(); ++t) {
        if (is_whole[t] == 0) others.push_back(corners[t]);
      }
    }

    ContactSpace space;
    BoundingBox cube;
    std::vector<char> is_whole;
    PhongMetric metric;
    std::vector<TriangleCorners> others;  // walls too
  };

  Impl(const ConvolutionModel& the_model, const PhongMetricOptions& the_options)
      : model(the_model),
        options((the_options.Validate(), the_options)),
        boxes(model, internal::kWindowFacets) {}

  // To what lies beyond the window, or is not the whole's, at least.
  double DistanceToOthers(const Vector3d& q, const Vector3d& x) const {
    const double steps =
        (x - window->cube.min).cwiseMin(window->cube.max - x).minCoeff();
    if (steps <= 0.0) return 0.0;
    double least = steps * boxes.frame().step;
    for (const TriangleCorners& c : window->others) {
      const double squared =
          ClosestOnTriangle(c[0], c[1], c[2], q).squared_distance;
      if (squared < least * least) least = std::sqrt(squared);
    }
    return least;
  }

  // Nothing where the window cannot tell.
  std::optional<PenetrationResult> FromWindow(const Vector3d& q,
                                              const Vector3d& x) const {
    if (!window) return std::nullopt;
    const double certain = internal::kCertainShare * DistanceToOthers(q, x);
    if (certain <= 0.0) return std::nullopt;
    const PenetrationResult found = window->metric.Query(q);
    const bool is_certain =
        found.status == QueryStatus::kOk && found.triangle >= 0 &&
        window->is_whole[static_cast<std::size_t>(found.triangle)] != 0 &&
        std::abs(found.signed_distance) <= certain;
    return is_certain ? std::optional(found) : std::nullopt;
  }

  const PhongMetric& Whole() {
    if (!whole) {
      const BoundingBox everything = boxes.Around(0.0).Box();
      whole.emplace(internal::ExploreWindow(boxes.In(everything), true, &boxes)
                        .WithLength(model.bounds().Diagonal()),
                    options);
      window.reset();
    }
    return *whole;
  }

  PenetrationResult Inside(const Vector3d& q, WindowResult* out) {
    out->level = DepthLevel::kWindow;
    const Vector3d x = boxes.frame().ToGrid(q);
    if (const auto found = FromWindow(q, x)) return *found;
    const BoundingBox all = boxes.bounds();
    const double longest = (all.max - all.min).maxCoeff();
    boxes.RestartLimits();
    const std::size_t before = boxes.faces();
    std::optional<PenetrationResult> found;
    for (double reach = internal::kFirstReach * longest; !found && !whole;
         reach *= internal::kMoreReach) {
      const BoundingBox cube{x.array() - reach, x.array() + reach};
      if (options.field_options.smoothing_length > 0.0 ||
          ((cube.min.array() <= all.min.array()).all() &&
           (cube.max.array() >= all.max.array()).all())) {
        break;
      }
      window.emplace(internal::ExploreWindow(boxes.In(cube), false, &boxes),
                     cube, kLowest * model.bounds().Diagonal(), options);
      ++out->windows;
      found = FromWindow(q, x);
    }
    if (!found) {
      out->windows += whole ? 0 : 1;
      found = Whole().Query(q);
      out->level = DepthLevel::kFull;
    }
    out->arranged_faces = boxes.faces() - before;
    return *found;
  }

  std::mutex mutex;
  ConvolutionModel model;
  PhongMetricOptions options;
  internal::ExploredBoxes boxes;
  std::optional<Window> window;  // the last one
  std::optional<PhongMetric> whole;
};

WindowPhong::WindowPhong(const ConvolutionModel& model,
                         const PhongMetricOptions& options)
    : impl_(std::make_unique<Impl>(model, options)) {}
WindowPhong::~WindowPhong() = default;
WindowPhong::WindowPhong(WindowPhong&&) noexcept = default;
WindowPhong& WindowPhong::operator=(WindowPhong&&) noexcept = default;

WindowResult WindowPhong::At(const Vector3d& q) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return internal::AnswerAt(impl_->model, q, [this, &q](WindowResult* out) {
    return impl_->Inside(q, out);
  });
}

}  // namespace phongpd
