// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace phongpd::internal {

// A symmetric positive definite matrix of blocks that only know their
// neighbours, with one more row and column as a border:
//
//   ⎡ D₀  E₀          b₀ ⎤
//   ⎢ E₀ᵀ D₁  E₁      b₁ ⎥
//   ⎢     E₁ᵀ D₂  …   b₂ ⎥        x = (x₀, x₁, …, t)
//   ⎣ b₀ᵀ b₁ᵀ b₂ᵀ …   d  ⎦
//
// solved by Cholesky block by block in time and memory linear in their number.
class BlockTridiagonal {
 public:
  static constexpr int kSize = 11;
  using Block = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  // Zero.
  explicit BlockTridiagonal(int blocks);

  int blocks() const { return static_cast<int>(diagonal.size()); }
  int size() const { return kSize * blocks() + 1; }

  // y = A x.
  Eigen::VectorXd Times(const Eigen::VectorXd& x) const;

  // Replaces the entries by those of the factor.  Pivots that are not positive
  // are lifted: false then, and what is solved is another matrix.
  bool Factorize();
  // After Factorize; from right-hand side to solution.
  void Solve(Eigen::VectorXd* x) const;

  std::vector<Block> diagonal;
  std::vector<Block> above;  // E_k: block k by block k + 1; the last is unused
  std::vector<Vector> border;
  double corner = 0.0;

 private:
  // L⁻¹ of the border's column, once factorised.
  void Forward(Eigen::VectorXd* x) const;
  void Backward(Eigen::VectorXd* x) const;
};

}  // namespace phongpd::internal
