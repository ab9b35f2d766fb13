// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <mutex>

#include "constraints/non_penetration.h"
#include "constraints/sampling_rule.h"
#include "planners/trajectory/trajectory_problem.h"
#include "planners/world/bare_length.h"
#include "problems/output/text.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/workshop.h"

namespace phongpd::python {
namespace {

// Of samples by the rule, as the optimiser has it (TrajectoryProblem).
double LongestSegment(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                      int waypoints) {
  const TrajectoryProblem problem;
  return problem.max_segment_ratio * (goal - start).norm() / (waypoints + 1);
}

// The rows of a polyline, and the branches that the caller's solver is on.
// With samples by the rule (0), N+1 rows margin + h − |p_{i+1} − p_i| come
// last: all rows ≥ margin is free motion then, as both ends keep the margin.
class Rows {
 public:
  Rows(const Workshop& workshop, const std::string& metric, const Point& start,
       const Point& goal, int waypoints, const std::string& margin,
       int samples_per_segment, double max_segment, int rows)
      : start_(ToVector(start)), goal_(ToVector(goal)), waypoints_(waypoints) {
    if (!start_.allFinite() || !goal_.allFinite()) {
      throw InputError("start and goal: expected finite numbers, found others");
    }
    const World& world = workshop.world();
    const Length wanted =
        margin.empty() ? workshop.scene().trajectory.margin
                       : ParseClearance(margin, "margin", world.diagonal(),
                                        workshop.scene().unit);
    margin_ = world.Resolve(wanted).unit;
    max_segment_ = max_segment > 0.0 ? max_segment
                                     : LongestSegment(start_, goal_, waypoints);
    is_by_rule_ = samples_per_segment == 0;
    if (is_by_rule_) {
      samples_per_segment =
          SamplesByRule(max_segment_, margin_, kMaxSamplesPerSegment);
      RequireRoomAtEnds(*workshop.Spaces().free_space);
    }
    samples_per_segment_ = samples_per_segment;
    const TrajectoryMetric chosen = ParseTrajectoryMetric(metric, "metric");
    SignedMetricOptions options = chosen.options;
    options.phong.field_options.smoothing_length =
        workshop.world().Resolve(chosen.smoothing_length).share;
    std::vector<std::shared_ptr<const SignedMetric>> metrics;
    const std::vector<ContactSpace>& spaces = workshop.Spaces().spaces;
    const Computing computing;
    for (const ContactSpace& space : spaces) {
      metrics.push_back(std::make_shared<SignedMetric>(space, options));
    }
    rows_ = std::make_unique<NonPenetrationConstraint>(
        std::move(metrics), ToVector(start), ToVector(goal), waypoints,
        std::vector<int>(static_cast<size_t>(waypoints) + 1,
                         samples_per_segment),
        rows);
    row_.resize(static_cast<size_t>(rows_->nonzeros()));
    column_.resize(row_.size());
    rows_->Sparsity(row_.data(), column_.data());
    for (int i = 0; i < segment_rows(); ++i) {
      for (int end = i - 1; end <= i; ++end) {  // its free waypoints
        if (end < 0 || end == waypoints_) continue;
        for (int axis = 0; axis < 3; ++axis) {
          row_.push_back(rows_->rows() + i);
          column_.push_back(3 * end + axis);
        }
      }
    }
  }

  size_t variables() const { return static_cast<size_t>(rows_->variables()); }
  size_t rows() const {
    return static_cast<size_t>(rows_->rows() + segment_rows());
  }
  double margin() const { return margin_; }
  double max_segment() const { return max_segment_; }
  int samples_per_segment() const { return samples_per_segment_; }
  nb::tuple Sparsity() const {
    return nb::make_tuple(Owned(row_, {row_.size()}),
                          Owned(column_, {column_.size()}));
  }

  // Cold branches at u.
  void Start(const Rows3& u) {
    const Computing computing;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    branches_ = rows_->Start(u.data(), nullptr);
  }
  void Accept(const Rows3& u) {
    const Computing computing;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    if (branches_.branches.empty()) {
      branches_ = rows_->Start(u.data(), nullptr);
    }
    rows_->Commit(u.data(), &branches_, nullptr);
  }
  // Values and entries of the pattern.
  nb::tuple Evaluate(const Rows3& u) {
    std::vector<double> values(rows()), entries(row_.size());
    {
      const Computing computing;
      const std::lock_guard<std::mutex> lock(one_at_a_time_);
      if (branches_.branches.empty()) {
        branches_ = rows_->Start(u.data(), nullptr);
      }
      if (!rows_->Evaluate(u.data(), branches_, values.data(), entries.data(),
                           nullptr)) {
        throw InputError("waypoints: expected finite numbers, found others");
      }
      AddSegments(u.data(), &values, &entries);
    }
    const size_t m = values.size(), e = entries.size();
    return nb::make_tuple(Owned(std::move(values), {m}),
                          Owned(std::move(entries), {e}));
  }

 private:
  int segment_rows() const { return is_by_rule_ ? waypoints_ + 1 : 0; }

  // Without that the rule says nothing of the first and last segment.
  void RequireRoomAtEnds(const FreeSpace& space) const {
    for (const bool at_start : {true, false}) {
      const double room = space.Clearance(at_start ? start_ : goal_);
      if (room >= margin_) continue;
      throw InputError("margin: expected at most " + FormatDouble(room) +
                       "unit, the room of the " +
                       (at_start ? "start" : "goal") + ", found " +
                       FormatDouble(margin_) +
                       "unit; less, or samples_per_segment of your own");
    }
  }

  Eigen::Vector3d Waypoint(int i, const double* u) const {
    if (i == 0) return start_;
    if (i > waypoints_) return goal_;
    return Eigen::Map<const Eigen::Vector3d>(u + 3 * (i - 1));
  }

  void AddSegments(const double* u, std::vector<double>* values,
                   std::vector<double>* entries) const {
    auto value = values->begin() + rows_->rows();
    auto entry = entries->begin() + rows_->nonzeros();
    for (int i = 0; i < segment_rows(); ++i) {
      const Eigen::Vector3d step = Waypoint(i + 1, u) - Waypoint(i, u);
      *value++ = margin_ + max_segment_ - step.norm();
      const Eigen::Vector3d along = step.stableNormalized();  // 0 of 0
      for (const int end : {i, i + 1}) {
        if (end == 0 || end == waypoints_ + 1) continue;
        for (int axis = 0; axis < 3; ++axis) {
          *entry++ = end == i ? along[axis] : -along[axis];
        }
      }
    }
  }

  const Eigen::Vector3d start_, goal_;
  const int waypoints_;
  double margin_ = 0.0, max_segment_ = 0.0;
  bool is_by_rule_ = false;
  int samples_per_segment_ = 0;
  std::unique_ptr<NonPenetrationConstraint> rows_;
  BranchSet branches_;
  std::vector<int> row_, column_;
  std::mutex one_at_a_time_;  // of Python's threads
};

}  // namespace

void BindRows(nb::module_& module) {
  nb::class_<Rows>(module, "Rows")
      .def(nb::init<const Workshop&, const std::string&, const Point&,
                    const Point&, int, const std::string&, int, double, int>())
      .def("start", &Rows::Start)
      .def("accept", &Rows::Accept)
      .def("evaluate", &Rows::Evaluate)
      .def("sparsity", &Rows::Sparsity)
      .def_prop_ro("margin", &Rows::margin)
      .def_prop_ro("max_segment", &Rows::max_segment)
      .def_prop_ro("samples_per_segment", &Rows::samples_per_segment)
      .def_prop_ro("variables", &Rows::variables)
      .def_prop_ro("rows", &Rows::rows);
}

}  // namespace phongpd::python
