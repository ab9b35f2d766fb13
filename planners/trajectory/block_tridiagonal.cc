// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/block_tridiagonal.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

// Of the largest entry on the diagonal: smaller pivots are lifted to it.
constexpr double kLeastPivot = 1e-14;

// In place, lower triangle, the rest zero.
template <typename Block>
bool Cholesky(Block* a) {
  const Eigen::Index n = a->rows();
  bool is_definite = true;
  const double least = kLeastPivot * a->diagonal().cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < n; ++j) {
    double pivot = (*a)(j, j);
    if (!(pivot > least)) {
      is_definite = false;
      pivot = least > 0.0 ? least : 1.0;
    }
    const double root = std::sqrt(pivot);
    (*a)(j, j) = root;
    for (Eigen::Index i = j + 1; i < n; ++i) (*a)(i, j) /= root;
    for (Eigen::Index k = j + 1; k < n; ++k) {
      const double by = (*a)(k, j);
      for (Eigen::Index i = k; i < n; ++i) (*a)(i, k) -= (*a)(i, j) * by;
    }
    for (Eigen::Index k = j + 1; k < n; ++k) (*a)(j, k) = 0.0;
  }
  return is_definite;
}

}  // namespace

template <int kSize>
BlockTridiagonalOf<kSize>::BlockTridiagonalOf(int blocks, int block_size)
    : diagonal(blocks, Block::Zero(block_size, block_size)),
      above(blocks, Block::Zero(block_size, block_size)),
      border(blocks, Vector::Zero(block_size)),
      block_size_(block_size) {}

template <int kSize>
Eigen::VectorXd BlockTridiagonalOf<kSize>::Times(
    const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  const double t = x[size() - 1];
  for (int k = 0; k < blocks(); ++k) {
    const auto here = Part(x, k);
    Part(&y, k) += diagonal[k] * here + t * border[k];
    y[size() - 1] += border[k].dot(here);
    if (k + 1 < blocks()) {
      Part(&y, k) += above[k] * Part(x, k + 1);
      Part(&y, k + 1) += above[k].transpose() * here;
    }
  }
  y[size() - 1] += corner * t;
  return y;
}

template <int kSize>
bool BlockTridiagonalOf<kSize>::Factorize() {
  bool is_definite = true;
  for (int k = 0; k < blocks(); ++k) {
    if (k > 0) {
      const Block& up = above[k - 1];  // L⁻¹ E
      diagonal[k].noalias() -= up.transpose() * up;
    }
    is_definite = Cholesky(&diagonal[k]) && is_definite;
    if (k + 1 < blocks()) {
      diagonal[k].template triangularView<Eigen::Lower>().solveInPlace(
          above[k]);
    }
    if (k > 0) border[k].noalias() -= above[k - 1].transpose() * border[k - 1];
    diagonal[k].template triangularView<Eigen::Lower>().solveInPlace(border[k]);
  }
  const double whole = std::abs(corner);
  for (const Vector& column : border) corner -= column.squaredNorm();
  if (!(corner > kLeastPivot * whole)) {
    is_definite = false;
    corner = whole > 0.0 ? kLeastPivot * whole : 1.0;
  }
  return is_definite;
}

template <int kSize>
void BlockTridiagonalOf<kSize>::Forward(Eigen::VectorXd* x) const {
  for (int k = 0; k < blocks(); ++k) {
    auto here = Part(x, k);
    if (k > 0) {
      here -= above[k - 1].transpose() * Part(x, k - 1);
    }
    diagonal[k].template triangularView<Eigen::Lower>().solveInPlace(here);
  }
}

template <int kSize>
void BlockTridiagonalOf<kSize>::Backward(Eigen::VectorXd* x) const {
  for (int k = blocks() - 1; k >= 0; --k) {
    auto here = Part(x, k);
    if (k + 1 < blocks()) {
      here -= above[k] * Part(x, k + 1);
    }
    diagonal[k]
        .transpose()
        .template triangularView<Eigen::Upper>()
        .solveInPlace(here);
  }
}

template <int kSize>
void BlockTridiagonalOf<kSize>::Solve(Eigen::VectorXd* x) const {
  Forward(x);
  double& t = (*x)[size() - 1];
  for (int k = 0; k < blocks(); ++k) {
    t -= border[k].dot(Part(x, k));
  }
  t /= corner;
  for (int k = 0; k < blocks(); ++k) {
    Part(x, k) -= t * border[k];
  }
  Backward(x);
}

template class BlockTridiagonalOf<11>;
template class BlockTridiagonalOf<Eigen::Dynamic>;

}  // namespace phongpd::internal
