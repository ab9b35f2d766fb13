// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/evaluated_program.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace phongpd {

double Finite(double value) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  return std::isnan(value) ? kLargest : std::clamp(value, -kLargest, kLargest);
}

EvaluatedProgram::EvaluatedProgram(NonlinearProgram* program)
    : program_(*program),
      at_(program->variables()),
      values_(program->rows()),
      jacobian_(program->jacobian_nonzeros()),
      x_low_(program->variables()),
      x_high_(program->variables()),
      g_low_(program->rows()),
      g_high_(program->rows()) {
  program->Bounds(x_low_.data(), x_high_.data(), g_low_.data(), g_high_.data());
}

bool EvaluatedProgram::IsAt(const double* x) const {
  return is_at_valid_ && std::memcmp(x, at_.data(),
                                     static_cast<std::size_t>(at_.size()) *
                                         sizeof(double)) == 0;
}

bool EvaluatedProgram::Evaluate(const double* x) {
  if (IsAt(x)) return true;
  is_at_valid_ = false;
  if (!program_.Constraints(x, values_.data(), jacobian_.data())) return false;
  std::copy(x, x + at_.size(), at_.data());
  is_at_valid_ = true;
  return true;
}

double EvaluatedProgram::Objective(const double* x) const {
  return Finite(program_.Objective(x));
}

double EvaluatedProgram::Violation(const double* x) {
  if (!Evaluate(x)) return std::numeric_limits<double>::max();
  double most = 0.0;
  for (Eigen::Index i = 0; i < values_.size(); ++i) {
    most = std::max({most, g_low_[i] - values_[i], values_[i] - g_high_[i]});
  }
  for (Eigen::Index i = 0; i < at_.size(); ++i) {
    most = std::max({most, x_low_[i] - x[i], x[i] - x_high_[i]});
  }
  return Finite(most);
}

}  // namespace phongpd
