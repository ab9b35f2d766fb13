// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/block_tridiagonal.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

// Of the largest entry on the diagonal: smaller pivots are lifted to it.
constexpr double kLeastPivot = 1e-14;

// In place, lower triangle, the rest zero.
bool Cholesky(BlockTridiagonal::Block* a) {
  constexpr int n = BlockTridiagonal::kSize;
  bool is_definite = true;
  const double least = kLeastPivot * a->diagonal().cwiseAbs().maxCoeff();
  for (int j = 0; j < n; ++j) {
    double pivot = (*a)(j, j);
    if (!(pivot > least)) {
      is_definite = false;
      pivot = least > 0.0 ? least : 1.0;
    }
    const double root = std::sqrt(pivot);
    (*a)(j, j) = root;
    for (int i = j + 1; i < n; ++i) (*a)(i, j) /= root;
    for (int k = j + 1; k < n; ++k) {
      const double by = (*a)(k, j);
      for (int i = k; i < n; ++i) (*a)(i, k) -= (*a)(i, j) * by;
    }
    for (int k = j + 1; k < n; ++k) (*a)(j, k) = 0.0;
  }
  return is_definite;
}

}  // namespace

BlockTridiagonal::BlockTridiagonal(int blocks)
    : diagonal(blocks, Block::Zero()),
      above(blocks, Block::Zero()),
      border(blocks, Vector::Zero()) {}

Eigen::VectorXd BlockTridiagonal::Times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  const double t = x[size() - 1];
  for (int k = 0; k < blocks(); ++k) {
    const auto here = x.segment<kSize>(kSize * k);
    y.segment<kSize>(kSize * k) += diagonal[k] * here + t * border[k];
    y[size() - 1] += border[k].dot(here);
    if (k + 1 < blocks()) {
      y.segment<kSize>(kSize * k) +=
          above[k] * x.segment<kSize>(kSize * (k + 1));
      y.segment<kSize>(kSize * (k + 1)) += above[k].transpose() * here;
    }
  }
  y[size() - 1] += corner * t;
  return y;
}

bool BlockTridiagonal::Factorize() {
  bool is_definite = true;
  for (int k = 0; k < blocks(); ++k) {
    if (k > 0) {
      const Block& up = above[k - 1];  // L⁻¹ E
      diagonal[k].noalias() -= up.transpose() * up;
    }
    is_definite = Cholesky(&diagonal[k]) && is_definite;
    if (k + 1 < blocks()) {
      diagonal[k].triangularView<Eigen::Lower>().solveInPlace(above[k]);
    }
    if (k > 0) border[k].noalias() -= above[k - 1].transpose() * border[k - 1];
    diagonal[k].triangularView<Eigen::Lower>().solveInPlace(border[k]);
  }
  const double whole = std::abs(corner);
  for (const Vector& column : border) corner -= column.squaredNorm();
  if (!(corner > kLeastPivot * whole)) {
    is_definite = false;
    corner = whole > 0.0 ? kLeastPivot * whole : 1.0;
  }
  return is_definite;
}

void BlockTridiagonal::Forward(Eigen::VectorXd* x) const {
  for (int k = 0; k < blocks(); ++k) {
    auto here = x->segment<kSize>(kSize * k);
    if (k > 0) {
      here -= above[k - 1].transpose() * x->segment<kSize>(kSize * (k - 1));
    }
    diagonal[k].triangularView<Eigen::Lower>().solveInPlace(here);
  }
}

void BlockTridiagonal::Backward(Eigen::VectorXd* x) const {
  for (int k = blocks() - 1; k >= 0; --k) {
    auto here = x->segment<kSize>(kSize * k);
    if (k + 1 < blocks()) {
      here -= above[k] * x->segment<kSize>(kSize * (k + 1));
    }
    diagonal[k].transpose().triangularView<Eigen::Upper>().solveInPlace(here);
  }
}

void BlockTridiagonal::Solve(Eigen::VectorXd* x) const {
  Forward(x);
  double& t = (*x)[size() - 1];
  for (int k = 0; k < blocks(); ++k) {
    t -= border[k].dot(x->segment<kSize>(kSize * k));
  }
  t /= corner;
  for (int k = 0; k < blocks(); ++k) {
    x->segment<kSize>(kSize * k) -= t * border[k];
  }
  Backward(x);
}

}  // namespace phongpd::internal
