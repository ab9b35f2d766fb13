// SPDX-License-Identifier: GPL-3.0-or-later
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <mutex>

#include "planners/world/non_penetration_rows.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"
#include "python/src/workshop.h"

namespace phongpd::python {
namespace {

// NonPenetrationRows for Python's threads.
class Rows {
 public:
  Rows(const Workshop& workshop, const std::string& metric, const Point& start,
       const Point& goal, int waypoints, const std::string& margin,
       int samples_per_segment, double max_segment, int rows) {
    RowsOptions options;
    options.waypoints = waypoints;
    options.margin = margin.empty() ? workshop.scene().trajectory.margin
                                    : workshop.Clearance(margin, "margin");
    options.penetration = ParsePenetration(metric, "metric");
    options.samples_per_segment = samples_per_segment;
    options.max_segment = max_segment;
    options.rows_per_sample = rows;
    workshop.Spaces();  // Ctrl-C stops that
    const Computing computing;
    rows_ = std::make_unique<NonPenetrationRows>(
        workshop.world(), ToVector(start), ToVector(goal), options);
  }

  const NonPenetrationRows& rows() const { return *rows_; }
  nb::tuple Sparsity() const {
    const size_t count = rows_->row().size();
    return nb::make_tuple(Owned(rows_->row(), {count}),
                          Owned(rows_->column(), {count}));
  }

  // Cold branches at u.
  void Start(const Rows3& u) {
    const Computing computing;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    rows_->Start(Flat(u));
  }
  void Accept(const Rows3& u) {
    const Computing computing;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    rows_->Accept(Flat(u));
  }
  // Values and entries of the pattern.
  nb::tuple Evaluate(const Rows3& u) {
    const auto m = static_cast<size_t>(rows_->rows());
    const auto e = static_cast<size_t>(rows_->nonzeros());
    std::vector<double> values(m), entries(e);
    {
      const Computing computing;
      const std::lock_guard<std::mutex> lock(one_at_a_time_);
      rows_->Evaluate(Flat(u), Flat(&values), Flat(&entries));
    }
    return nb::make_tuple(Owned(std::move(values), {m}),
                          Owned(std::move(entries), {e}));
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> Flat(const Rows3& u) {
    return {u.data(), static_cast<Eigen::Index>(u.size())};
  }
  static Eigen::Map<Eigen::VectorXd> Flat(std::vector<double>* numbers) {
    return {numbers->data(), static_cast<Eigen::Index>(numbers->size())};
  }

  std::unique_ptr<NonPenetrationRows> rows_;
  std::mutex one_at_a_time_;
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
      .def_prop_ro("margin", [](const Rows& r) { return r.rows().margin(); })
      .def_prop_ro("max_segment",
                   [](const Rows& r) { return r.rows().max_segment(); })
      .def_prop_ro("samples_per_segment",
                   [](const Rows& r) { return r.rows().samples_per_segment(); })
      .def_prop_ro("variables",
                   [](const Rows& r) { return r.rows().variables(); })
      .def_prop_ro("rows", [](const Rows& r) { return r.rows().rows(); });
}

}  // namespace phongpd::python
