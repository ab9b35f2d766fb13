// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <mutex>

#include "constraints/non_penetration.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/workshop.h"

namespace phongpd::python {
namespace {

// The rows of a polyline, and the branches that the caller's solver is on.
class Rows {
 public:
  Rows(const Workshop& workshop, const std::string& metric, const Point& start,
       const Point& goal, int waypoints, int samples_per_segment, int rows) {
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
  }

  size_t variables() const { return static_cast<size_t>(rows_->variables()); }
  size_t rows() const { return static_cast<size_t>(rows_->rows()); }
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
    }
    const size_t m = values.size(), e = entries.size();
    return nb::make_tuple(Owned(std::move(values), {m}),
                          Owned(std::move(entries), {e}));
  }

 private:
  std::unique_ptr<NonPenetrationConstraint> rows_;
  BranchSet branches_;
  std::vector<int> row_, column_;
  std::mutex one_at_a_time_;  // of Python's threads
};

}  // namespace

void BindRows(nb::module_& module) {
  nb::class_<Rows>(module, "Rows")
      .def(nb::init<const Workshop&, const std::string&, const Point&,
                    const Point&, int, int, int>())
      .def("start", &Rows::Start)
      .def("accept", &Rows::Accept)
      .def("evaluate", &Rows::Evaluate)
      .def("sparsity", &Rows::Sparsity)
      .def_prop_ro("variables", &Rows::variables)
      .def_prop_ro("rows", &Rows::rows);
}

}  // namespace phongpd::python
