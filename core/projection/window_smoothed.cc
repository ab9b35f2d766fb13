// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/window_smoothed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/projection/window_reach.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Half-width of the first window, in what is known to be needed.
constexpr double kFirstShare = 1.1;

}  // namespace

struct WindowSmoothed::Impl {
  // Boxes that hold all of a cube, grid steps; of everything, without walls.
  struct Window {
    ContactSpace space;
    SmoothedMetric metric;
    BoundingBox cube;
    bool is_all = false;
  };

  Impl(const ConvolutionModel& the_model, double the_length, SmoothedAt the_at)
      : model(the_model),
        smoothing_length(the_length),
        at(the_at),
        radius(SmoothedRadius(smoothing_length, model.bounds().Diagonal())),
        boxes(model, internal::kWindowFacets) {}

  // From q to the cube's walls at most, user's unit; < 0 outside.
  double MarginOf(const Window& of, const Vector3d& x) const {
    if (of.is_all) return std::numeric_limits<double>::infinity();
    return internal::kCertainShare * boxes.frame().step *
           (x - of.cube.min).cwiseMin(of.cube.max - x).minCoeff();
  }

  // Nothing where the window cannot tell.
  std::optional<PenetrationResult> FromWindow(const Vector3d& q,
                                              const Vector3d& x) const {
    if (!window) return std::nullopt;
    const double margin = MarginOf(*window, x);
    if (!(margin > 0.0)) return std::nullopt;
    const PenetrationResult found = window->metric.Query(q);
    const double depth = std::abs(found.signed_distance);
    const double needed =
        at == SmoothedAt::kContact ? depth + radius : std::max(depth, radius);
    const auto triangle = static_cast<std::size_t>(found.triangle);
    const bool is_certain =
        needed <= margin && found.triangle >= 0 &&
        window->space.kind()[triangle] != ContactKind::kNone;
    return is_certain ? std::optional(found) : std::nullopt;
  }

  void Build(const BoundingBox& cube, bool is_all) {
    const std::vector<int> part =
        boxes.In(is_all ? boxes.Around(0.0).Box() : cube);
    const ContactSpace space = internal::ExploreWindow(part, is_all, &boxes)
                                   .WithLength(model.bounds().Diagonal());
    window.emplace(Window{space, SmoothedMetric(space, smoothing_length, at),
                          cube, is_all});
  }

  PenetrationResult Inside(const Vector3d& q, WindowResult* out) {
    const Vector3d x = boxes.frame().ToGrid(q);
    boxes.RestartLimits();
    const std::size_t before = boxes.faces();
    const BoundingBox all = boxes.bounds();
    double reach =
        std::max(kFirstShare * radius / boxes.frame().step,
                 internal::kFirstReach * (all.max - all.min).maxCoeff());
    std::optional<PenetrationResult> found = FromWindow(q, x);
    for (; !found; reach *= internal::kMoreReach) {
      const BoundingBox cube{x.array() - reach, x.array() + reach};
      Build(cube, (cube.min.array() <= all.min.array()).all() &&
                      (cube.max.array() >= all.max.array()).all());
      ++out->windows;
      found = FromWindow(q, x);
    }
    out->level = window->is_all ? DepthLevel::kFull : DepthLevel::kWindow;
    out->arranged_faces = boxes.faces() - before;
    return *found;
  }

  std::mutex mutex;
  ConvolutionModel model;
  double smoothing_length;
  SmoothedAt at;
  double radius;  // ρ, user's unit
  internal::ExploredBoxes boxes;
  std::optional<Window> window;  // the last one
};

WindowSmoothed::WindowSmoothed(const ConvolutionModel& model,
                               double smoothing_length, SmoothedAt at)
    : impl_(std::make_unique<Impl>(model, smoothing_length, at)) {}
WindowSmoothed::~WindowSmoothed() = default;
WindowSmoothed::WindowSmoothed(WindowSmoothed&&) noexcept = default;
WindowSmoothed& WindowSmoothed::operator=(WindowSmoothed&&) noexcept = default;

WindowResult WindowSmoothed::At(const Vector3d& q) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return internal::AnswerAt(impl_->model, q, [this, &q](WindowResult* out) {
    return impl_->Inside(q, out);
  });
}

}  // namespace phongpd
