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
// Of blocks of a size that is known, or of any, Eigen::Dynamic.
template <int kBlockSize>
class BlockTridiagonalOf {
 public:
  static constexpr int kSize = kBlockSize;
  using Block = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  // Zero.
  explicit BlockTridiagonalOf(int blocks, int block_size = kBlockSize);

  int blocks() const { return static_cast<int>(diagonal.size()); }
  int block_size() const { return block_size_; }
  int size() const { return block_size_ * blocks() + 1; }

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
  auto Part(Eigen::VectorXd* x, int block) const {
    return x->segment<kSize>(block_size_ * block, block_size_);
  }
  auto Part(const Eigen::VectorXd& x, int block) const {
    return x.segment<kSize>(block_size_ * block, block_size_);
  }

  int block_size_;
};

using BlockTridiagonal = BlockTridiagonalOf<11>;
using WideTridiagonal = BlockTridiagonalOf<Eigen::Dynamic>;

}  // namespace phongpd::internal
