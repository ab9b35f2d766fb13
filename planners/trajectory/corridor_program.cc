// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/corridor_program.h"

#include <algorithm>

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// A triangle this far above a plane, in units of D, still counts as behind it.
constexpr double kRounding = 1e-12;
// Shortfalls below this, in units of D, are not worth a variable.
constexpr double kLeastMissing = 1e-6;

// Planes whose normals have a smaller product face each other.
constexpr double kOpposite = -0.95;
// Share of half a gap that is wanted; all of it would leave nothing to choose.
constexpr double kCentred = 0.95;

// The clearance a segment between the planes can reach, at most the margin.
// Between two opposite planes with c = n_j·n_k a move along n_j makes both
// distances equal at (d_k − c d_j)/(1 − c).
double Attainable(const std::vector<Corridor::Plane>& planes, double margin) {
  double wanted = margin;
  for (std::size_t j = 0; j < planes.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      const double c = planes[j].normal.dot(planes[k].normal);
      if (c > kOpposite) continue;
      const double middle =
          (planes[k].distance - c * planes[j].distance) / (1.0 - c);
      wanted = std::min(wanted, kCentred * middle);
    }
  }
  return wanted;
}

}  // namespace

int Corridor::CountPlanes() const {
  std::size_t count = 0;
  for (const auto& of_segment : planes) count += of_segment.size();
  return static_cast<int>(count);
}

double Corridor::TotalMissing() const {
  double sum = 0.0;
  for (const double one : missing) sum += one;
  return sum;
}

Corridor FindCorridor(const TrajectoryProblem& problem,
                      const PathSprings& springs, const Path& path,
                      double reach) {
  Corridor corridor;
  const double unit = springs.unit;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const std::vector<Separator> separators =
        problem.free_space->FindSeparators(path[i], path[i + 1], reach * unit,
                                           kRounding * unit);
    std::vector<Corridor::Plane> planes;
    for (const Separator& one : separators) {
      planes.push_back({one.normal,
                        (one.level - one.normal.dot(springs.center)) / unit,
                        one.distance / unit});
    }
    const double wanted = Attainable(planes, problem.margin);
    const double clearance = planes.empty() ? wanted : planes[0].distance;
    corridor.wanted.push_back(wanted);
    corridor.missing.push_back(std::max(0.0, wanted - clearance));
    corridor.planes.push_back(std::move(planes));
  }
  return corridor;
}

CorridorProgram::CorridorProgram(const TrajectoryProblem& problem,
                                 const PathSprings& springs,
                                 const Corridor& corridor, const VectorXd& now,
                                 double trust, double price)
    : problem_(problem),
      springs_(springs),
      now_(now),
      trust_(trust),
      price_(price) {
  for (int i = 0; i <= springs.waypoints; ++i) {
    const double missing = corridor.missing[static_cast<std::size_t>(i)];
    const double wanted = corridor.wanted[static_cast<std::size_t>(i)];
    int elastic = -1;
    if (missing > kLeastMissing && price > 0.0) {
      elastic = 3 * springs.waypoints + static_cast<int>(missing_.size());
      missing_.push_back(missing);
    }
    for (const auto& plane : corridor.planes[static_cast<std::size_t>(i)]) {
      for (const int waypoint : {i - 1, i}) {
        if (waypoint < 0 || waypoint >= springs.waypoints) continue;
        // What little is missing without a variable must not make the present
        // path infeasible.
        const double shortfall = elastic < 0 ? missing : 0.0;
        planes_.push_back({waypoint, elastic, plane.normal,
                           plane.level + wanted - shortfall});
        plane_nonzeros_ += elastic < 0 ? 3 : 4;
      }
    }
  }
}

VectorXd CorridorProgram::Start() const {
  VectorXd x(variables());
  x.head(now_.size()) = now_;
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    x[now_.size() + static_cast<Eigen::Index>(i)] = missing_[i];
  }
  return x;
}

int CorridorProgram::variables() const {
  return 3 * springs_.waypoints + static_cast<int>(missing_.size());
}
int CorridorProgram::rows() const {
  return static_cast<int>(planes_.size()) + springs_.rows();
}
int CorridorProgram::jacobian_nonzeros() const {
  return plane_nonzeros_ + springs_.jacobian_nonzeros();
}

void CorridorProgram::Bounds(double* x_low, double* x_high, double* g_low,
                             double* g_high) const {
  const BoundingBox& bounds = problem_.free_space->bounds();
  for (int i = 0; i < 3 * springs_.waypoints; ++i) {
    x_low[i] = now_[i] - trust_;
    x_high[i] = now_[i] + trust_;
    if (bounds.IsEmpty()) continue;
    // The margin from the bounds, or what there is now.
    const double c = springs_.center[i % 3];
    const double low = (bounds.min[i % 3] - c) / springs_.unit;
    const double high = (bounds.max[i % 3] - c) / springs_.unit;
    x_low[i] = std::max(x_low[i], std::min(now_[i], low + problem_.margin));
    x_high[i] = std::min(x_high[i], std::max(now_[i], high - problem_.margin));
  }
  std::fill(x_low + 3 * springs_.waypoints, x_low + variables(), 0.0);
  std::copy(missing_.begin(), missing_.end(), x_high + 3 * springs_.waypoints);
  for (const Row& row : planes_) *g_low++ = row.level;
  std::fill(g_low, g_low + springs_.rows(), -kNoBound);
  std::fill(g_high, g_high + planes_.size(), kNoBound);
  std::fill(g_high + planes_.size(), g_high + rows(), springs_.eta);
}

void CorridorProgram::JacobianPattern(int* row, int* col) const {
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      *row++ = static_cast<int>(i);
      *col++ = 3 * planes_[i].waypoint + axis;
    }
    if (planes_[i].elastic < 0) continue;
    *row++ = static_cast<int>(i);
    *col++ = planes_[i].elastic;
  }
  springs_.JacobianPattern(static_cast<int>(planes_.size()), row, col);
}

void CorridorProgram::HessianPattern(int* row, int* col) const {
  springs_.HessianPattern(row, col);
}

double CorridorProgram::Objective(const double* x) const {
  double missing = 0.0;
  for (int i = 3 * springs_.waypoints; i < variables(); ++i) missing += x[i];
  return springs_.Energy(x) + price_ * missing;
}

void CorridorProgram::ObjectiveGradient(const double* x,
                                        double* gradient) const {
  springs_.Gradient(x, gradient);
  std::fill(gradient + 3 * springs_.waypoints, gradient + variables(), price_);
}

bool CorridorProgram::Constraints(const double* x, double* values,
                                  double* jacobian) {
  for (const Row& row : planes_) {
    const Eigen::Map<const Vector3d> u(x + 3 * row.waypoint);
    *values = row.normal.dot(u);
    for (int axis = 0; axis < 3; ++axis) *jacobian++ = row.normal[axis];
    if (row.elastic >= 0) {
      *values += x[row.elastic];
      *jacobian++ = 1.0;
    }
    ++values;
  }
  return springs_.Lengths(x, values, jacobian);
}

void CorridorProgram::Hessian(const double* /*x*/, double objective_factor,
                              const double* multipliers, double* values) const {
  springs_.Hessian(objective_factor, multipliers + planes_.size(), values);
}

}  // namespace phongpd
