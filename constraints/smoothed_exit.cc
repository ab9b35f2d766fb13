// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/smoothed_exit.h"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/projection/smoothed_normal.h"
#include "core/projection/window_reach.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Half-width of the first window, in the depth: C_cont along the ray, and half
// as much around it.
constexpr double kFirstWindow = 2.0;

}  // namespace

struct SmoothedExit::Impl {
  Impl(const ConvolutionModel& model, const Vector3d& the_q, double depth)
      : q(the_q),
        boxes(model, kWindowFacets),
        x(boxes.frame().ToGrid(q)),
        reach(kFirstWindow * depth / boxes.frame().step) {
    boxes.RestartLimits();
    Build();
  }

  void Build() {
    cube = {x.array() - reach, x.array() + reach};
    const BoundingBox all = boxes.bounds();
    is_all = (cube.min.array() <= all.min.array()).all() &&
             (cube.max.array() >= all.max.array()).all();
    const std::vector<int> part =
        boxes.In(is_all ? boxes.Around(0.0).Box() : cube);
    space.emplace(ExploreWindow(part, is_all, &boxes));
  }

  // Of a point, from the walls of the window; user's unit.
  double Margin(const Vector3d& point) const {
    if (is_all) return std::numeric_limits<double>::infinity();
    const Vector3d p = boxes.frame().ToGrid(point);
    return boxes.frame().step *
           (p - cube.min).cwiseMin(cube.max - p).minCoeff();
  }

  Vector3d q;
  ExploredBoxes boxes;
  Vector3d x;    // q in grid steps
  double reach;  // of the window; grid steps
  BoundingBox cube;
  bool is_all = false;
  std::optional<ContactSpace> space;
};

SmoothedExit::SmoothedExit(const ConvolutionModel& model, const Vector3d& q,
                           double depth)
    : impl_(std::make_unique<Impl>(model, q, depth)) {}
SmoothedExit::~SmoothedExit() = default;

Exit SmoothedExit::Along(const Vector3d& direction, double share) {
  Impl& impl = *impl_;
  const BoundingBox all = impl.boxes.bounds();
  // Beyond every sum, wherever q is among them.
  const double far = 2.0 * impl.boxes.frame().step * (all.max - all.min).norm();
  for (;; impl.reach *= kMoreReach, impl.Build()) {
    const auto hit =
        impl.space->bvh().FirstHit(impl.q, impl.q + far * direction);
    const bool is_contact =
        hit.Found() &&
        impl.space->kind()[static_cast<std::size_t>(hit.triangle)] !=
            ContactKind::kNone;
    if (is_contact) {
      const Vector3d contact = impl.q + hit.fraction * far * direction;
      const double radius = share * hit.fraction * far;
      if (radius <= impl.Margin(contact)) {
        if (!(radius > 1e-9 * impl.space->bounds().Diagonal())) return {};
        const SmoothedNormal normal =
            SmoothedNormals(*impl.space, radius).At(contact);
        if (!normal.HasDirection()) return {};
        return {true, contact, normal.Direction()};
      }
    }
    if (impl.is_all) return {};
  }
}

}  // namespace phongpd::internal
