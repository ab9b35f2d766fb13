// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/condensed_system.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>

namespace phongpd {

using Eigen::VectorXd;

// Every entry to the block it belongs to; those of W as (entry, row, column).
bool CondensedSystem::Sort(int entries, const int* row, const int* col,
                           std::vector<std::array<int, 3>>* of_w) {
  const int slacks = variables_, multipliers = variables_ + rows_;
  for (int k = 0; k < entries; ++k) {
    const int high = std::max(row[k], col[k]) - 1;
    const int low = std::min(row[k], col[k]) - 1;
    if (low < 0 || high >= variables_ + 2 * rows_) return false;
    if (high < slacks) {
      of_w->push_back({k, low, high});
    } else if (high < multipliers) {
      if (low != high) return false;
      to_slack_.push_back({k, high - slacks});
    } else if (low < slacks) {
      jacobian_.push_back({k, high - multipliers, low});
    } else if (low == high) {
      to_diagonal_.push_back({k, high - multipliers});
    } else if (low - slacks == high - multipliers) {
      to_coupling_.push_back({k, high - multipliers});
    } else {
      return false;
    }
  }
  std::stable_sort(jacobian_.begin(), jacobian_.end(),
                   [](const JacobianEntry& a, const JacobianEntry& b) {
                     return a.row < b.row;
                   });
  return true;
}

int CondensedSystem::Place(int one, int other) const {
  const int a = position_[static_cast<std::size_t>(one)];
  const int b = position_[static_cast<std::size_t>(other)];
  const int* const begin =
      k_.innerIndexPtr() + k_.outerIndexPtr()[std::max(a, b)];
  const int* const end =
      k_.innerIndexPtr() + k_.outerIndexPtr()[std::max(a, b) + 1];
  return static_cast<int>(std::lower_bound(begin, end, std::min(a, b)) -
                          k_.innerIndexPtr());
}

// K's pattern in an order that keeps its factor sparse, and where each entry
// and each product of two entries of a row goes.
void CondensedSystem::BuildPattern(
    const std::vector<std::array<int, 3>>& of_w) {
  using Triplet = Eigen::Triplet<double>;
  const int entries = static_cast<int>(jacobian_.size());
  std::vector<Triplet> pattern;
  for (int i = 0; i < variables_; ++i) pattern.emplace_back(i, i, 1.0);
  for (const auto& [entry, low, high] : of_w) {
    pattern.emplace_back(low, high, 1.0);
  }
  for (int i = 0; i < entries; ++i) {
    const JacobianEntry& a = jacobian_[static_cast<std::size_t>(i)];
    for (int j = i; j < entries; ++j) {
      const JacobianEntry& b = jacobian_[static_cast<std::size_t>(j)];
      if (b.row != a.row) break;
      products_.push_back({a.row, i, j, 0});
      pattern.emplace_back(std::min(a.variable, b.variable),
                           std::max(a.variable, b.variable), 1.0);
    }
  }
  Matrix upper(variables_, variables_);
  upper.setFromTriplets(pattern.begin(), pattern.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(upper.selfadjointView<Eigen::Upper>(), order);
  position_.resize(static_cast<std::size_t>(variables_));
  for (int i = 0; i < variables_; ++i) {
    position_[static_cast<std::size_t>(order.indices()[i])] = i;
  }
  for (Triplet& t : pattern) {
    const int a = position_[static_cast<std::size_t>(t.row())];
    const int b = position_[static_cast<std::size_t>(t.col())];
    t = Triplet(std::min(a, b), std::max(a, b), 1.0);
  }
  k_.resize(variables_, variables_);
  k_.setFromTriplets(pattern.begin(), pattern.end());
  for (const auto& [entry, low, high] : of_w) {
    to_k_.push_back({entry, Place(low, high)});
  }
  for (Product& p : products_) {
    p.place = Place(jacobian_[static_cast<std::size_t>(p.first)].variable,
                    jacobian_[static_cast<std::size_t>(p.second)].variable);
  }
  factor_.analyzePattern(k_);
}

bool CondensedSystem::Analyze(int size, int entries, const int* row,
                              const int* col) {
  variables_ = size - 2 * rows_;
  std::vector<std::array<int, 3>> of_w;
  if (variables_ < 1 || !Sort(entries, row, col, &of_w)) return false;
  BuildPattern(of_w);
  jacobian_values_.resize(static_cast<Eigen::Index>(jacobian_.size()));
  return true;
}

CondensedSystem::Inertia CondensedSystem::Factorize(const double* values) {
  const auto gather = [&](const std::vector<Target>& targets, VectorXd* out) {
    out->setZero(rows_);
    for (const Target& t : targets) (*out)[t.place] += values[t.entry];
  };
  gather(to_slack_, &slack_);
  gather(to_coupling_, &coupling_);
  gather(to_diagonal_, &diagonal_);
  // Then each pair of slack and multiplier has one eigenvalue of each sign.
  inverse_.resize(rows_);
  for (int i = 0; i < rows_; ++i) {
    const double pivot = coupling_[i] * coupling_[i] - diagonal_[i] * slack_[i];
    if (!std::isfinite(pivot) || pivot <= 0.0) return Inertia::kOther;
    inverse_[i] = 1.0 / pivot;
  }
  for (std::size_t i = 0; i < jacobian_.size(); ++i) {
    jacobian_values_[static_cast<Eigen::Index>(i)] = values[jacobian_[i].entry];
  }
  double* const k = k_.valuePtr();
  std::fill(k, k + k_.nonZeros(), 0.0);
  for (const Target& t : to_k_) k[t.place] += values[t.entry];
  for (const Product& p : products_) {
    // Two entries of one row for the same variable: both orders count.
    const bool is_twice =
        p.first != p.second &&
        jacobian_[static_cast<std::size_t>(p.first)].variable ==
            jacobian_[static_cast<std::size_t>(p.second)].variable;
    k[p.place] += (is_twice ? 2.0 : 1.0) * Theta(p.row) *
                  jacobian_values_[p.first] * jacobian_values_[p.second];
  }
  if (!k_.coeffs().allFinite()) return Inertia::kOther;
  factor_.factorize(k_);
  return factor_.info() == Eigen::Success ? Inertia::kAsWanted
                                          : Inertia::kOther;
}

void CondensedSystem::Solve(double* unknowns) const {
  Eigen::Map<VectorXd> x(unknowns, variables_);
  Eigen::Map<VectorXd> s(unknowns + variables_, rows_);
  Eigen::Map<VectorXd> y(unknowns + variables_ + rows_, rows_);
  VectorXd right(variables_);
  for (int i = 0; i < variables_; ++i) {
    right[position_[static_cast<std::size_t>(i)]] = x[i];
  }
  for (std::size_t i = 0; i < jacobian_.size(); ++i) {
    const JacobianEntry& e = jacobian_[i];
    right[position_[static_cast<std::size_t>(e.variable)]] +=
        jacobian_values_[static_cast<Eigen::Index>(i)] *
        (Theta(e.row) * y[e.row] - Phi(e.row) * s[e.row]);
  }
  const VectorXd solution = factor_.solve(right);
  for (int i = 0; i < variables_; ++i) {
    x[i] = solution[position_[static_cast<std::size_t>(i)]];
  }
  VectorXd residual = -y;  // J x − r_y
  for (std::size_t i = 0; i < jacobian_.size(); ++i) {
    const JacobianEntry& e = jacobian_[i];
    residual[e.row] +=
        jacobian_values_[static_cast<Eigen::Index>(i)] * x[e.variable];
  }
  for (int i = 0; i < rows_; ++i) {
    y[i] = Theta(i) * residual[i] + Phi(i) * s[i];
    s[i] = -(residual[i] + diagonal_[i] * y[i]) / coupling_[i];
  }
}

}  // namespace phongpd
