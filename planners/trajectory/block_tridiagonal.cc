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

// L⁻¹ from the left.  Eigen's own way with triangles is made for large ones; of
// a block whose size is known it takes several times as long.
template <typename Block, typename Columns>
void SolveLower(const Block& lower, Columns* columns) {
  if constexpr (Block::SizeAtCompileTime == Eigen::Dynamic) {
    lower.template triangularView<Eigen::Lower>().solveInPlace(*columns);
  } else {
    constexpr int kRows = Block::RowsAtCompileTime;
    constexpr int kColumns = Columns::ColsAtCompileTime;
    // Row after row: all columns at once.
    Eigen::Matrix<double, kRows, kColumns,
                  kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor>
        rows = *columns;
    for (int j = 0; j < kRows; ++j) {
      rows.row(j) /= lower(j, j);
      for (int i = j + 1; i < kRows; ++i) {
        rows.row(i) -= lower(i, j) * rows.row(j);
      }
    }
    *columns = rows;
  }
}

// *from −= A·x, and Aᵀ·x.
template <typename Block, typename From, typename Column>
void Subtract(const Block& a, const Column& x, From* from) {
  for (Eigen::Index j = 0; j < a.cols(); ++j) *from -= x[j] * a.col(j);
}

template <typename Block, typename From, typename Column>
void SubtractTransposed(const Block& a, const Column& x, From* from) {
  for (Eigen::Index j = 0; j < a.cols(); ++j) (*from)[j] -= a.col(j).dot(x);
}

// L⁻ᵀ of a column.
template <typename Block, typename Column>
void SolveTransposed(const Block& lower, Column* column) {
  if constexpr (Block::SizeAtCompileTime == Eigen::Dynamic) {
    lower.transpose().template triangularView<Eigen::Upper>().solveInPlace(
        *column);
  } else {
    for (int j = Block::RowsAtCompileTime - 1; j >= 0; --j) {
      double value = (*column)[j];
      for (int i = j + 1; i < Block::RowsAtCompileTime; ++i) {
        value -= lower(i, j) * (*column)[i];
      }
      (*column)[j] = value / lower(j, j);
    }
  }
}

// *from −= upᵀ·up.
template <typename Block>
void SubtractSquare(const Block& up, Block* from) {
  if constexpr (Block::SizeAtCompileTime == Eigen::Dynamic) {
    from->noalias() -= up.transpose() * up;
  } else {
    const Block rows = up.transpose();
    for (int j = 0; j < Block::ColsAtCompileTime; ++j) {
      auto column = from->col(j);
      Eigen::Matrix<double, Block::RowsAtCompileTime, 1> sum = column;
      for (int k = 0; k < Block::RowsAtCompileTime; ++k) {
        sum -= rows(j, k) * rows.col(k);
      }
      column = sum;
    }
  }
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
    if (k > 0) SubtractSquare(above[k - 1], &diagonal[k]);  // of L⁻¹ E
    is_definite = Cholesky(&diagonal[k]) && is_definite;
    if (k + 1 < blocks()) SolveLower(diagonal[k], &above[k]);
    if (k > 0) SubtractTransposed(above[k - 1], border[k - 1], &border[k]);
    SolveLower(diagonal[k], &border[k]);
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
    if (k > 0) SubtractTransposed(above[k - 1], Part(x, k - 1), &here);
    SolveLower(diagonal[k], &here);
  }
}

template <int kSize>
void BlockTridiagonalOf<kSize>::Backward(Eigen::VectorXd* x) const {
  for (int k = blocks() - 1; k >= 0; --k) {
    auto here = Part(x, k);
    if (k + 1 < blocks()) Subtract(above[k], Part(x, k + 1), &here);
    SolveTransposed(diagonal[k], &here);
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
