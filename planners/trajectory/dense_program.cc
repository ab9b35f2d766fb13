// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/dense_program.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void RequireSize(const char* what, Index expected, Index found) {
  if (expected == found) return;
  throw InputError(std::string("program: ") + what + ": expected " +
                   std::to_string(expected) + ", found " +
                   std::to_string(found));
}

// Quiet, unlike Eigen's (core/mesh/finite.h).
template <typename Dense>
bool IsAllFinite(const Dense& found) {
  return std::all_of(found.data(), found.data() + found.size(),
                     [](double value) { return std::isfinite(value); });
}

}  // namespace

DenseProgram::DenseProgram(int variables, Vector low, Vector high)
    : variables_(variables), low_(std::move(low)), high_(std::move(high)) {
  if (variables < 1) {
    throw InputError("program: variables: expected at least 1, found " +
                     std::to_string(variables));
  }
  RequireSize("upper bounds", low_.size(), high_.size());
  if (!(low_.array() <= high_.array()).all()) {
    throw InputError("program: bounds: expected low ≤ high, found others");
  }
  low_ = low_.cwiseMax(-kNoBound);
  high_ = high_.cwiseMin(kNoBound);
}

IpoptSettings DenseProgram::Settings() {
  IpoptSettings settings;
  settings.ipopt_options["hessian_approximation"] = "limited-memory";
  return settings;
}

void DenseProgram::OnIterate(const Vector& /*x*/) {}

void DenseProgram::Bounds(double* x_low, double* x_high, double* g_low,
                          double* g_high) const {
  Eigen::Map<VectorXd>(x_low, variables_).setConstant(-kNoBound);
  Eigen::Map<VectorXd>(x_high, variables_).setConstant(kNoBound);
  Eigen::Map<VectorXd>(g_low, rows()) = low_;
  Eigen::Map<VectorXd>(g_high, rows()) = high_;
}

void DenseProgram::JacobianPattern(int* row, int* col) const {
  for (int i = 0; i < jacobian_nonzeros(); ++i) {
    row[i] = i / variables_;
    col[i] = i % variables_;
  }
}

void DenseProgram::HessianPattern(int* /*row*/, int* /*col*/) const {}

double DenseProgram::Objective(const double* x) const { return Value(At(x)); }

void DenseProgram::ObjectiveGradient(const double* x, double* gradient) const {
  const Vector found = Gradient(At(x));
  RequireSize("entries of the gradient", variables_, found.size());
  Eigen::Map<VectorXd>(gradient, variables_) = found;
}

bool DenseProgram::Constraints(const double* x, double* values,
                               double* jacobian) {
  const Vector at = At(x);
  if (values != nullptr) {
    const Vector found = Rows(at);
    RequireSize("rows", rows(), found.size());
    if (!IsAllFinite(found)) return false;
    Eigen::Map<VectorXd>(values, rows()) = found;
  }
  if (jacobian != nullptr) {
    const Matrix found = RowGradients(at);
    RequireSize("rows of gradients", rows(), found.rows());
    RequireSize("columns of gradients", variables_, found.cols());
    if (!IsAllFinite(found)) return false;
    Eigen::Map<RowMajor>(jacobian, rows(), variables_) = found;
  }
  return true;
}

void DenseProgram::Hessian(const double* /*x*/, double /*objective_factor*/,
                           const double* /*multipliers*/,
                           double* /*values*/) const {}

int DenseProgram::Accept(const double* x) {
  OnIterate(At(x));
  return 0;
}

}  // namespace phongpd
