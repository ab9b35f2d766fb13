// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the same matrix, dense, by Eigen's LDLT.
#include "planners/trajectory/block_tridiagonal.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace phongpd::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSize = BlockTridiagonal::kSize;

struct Pair {
  BlockTridiagonal banded{0};
  MatrixXd dense;
};

// Positive definite: the sum of squares of rows over two neighbours and the
// border, as programs of knots have them.
Pair MakePair(int blocks, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  Pair pair;
  pair.banded = BlockTridiagonal(blocks);
  const int size = kSize * blocks + 1;
  pair.dense = 1e-3 * MatrixXd::Identity(size, size);
  for (int k = 0; k < blocks; ++k) {
    for (int i = 0; i < 2 * kSize; ++i) {
      VectorXd row = VectorXd::Zero(size);
      const int length = k + 1 < blocks ? 2 * kSize : kSize;
      for (int j = 0; j < length; ++j) row[kSize * k + j] = normal(*random);
      row[size - 1] = normal(*random);
      pair.dense += row * row.transpose();
    }
  }
  for (int k = 0; k < blocks; ++k) {
    const int at = kSize * k;
    pair.banded.diagonal[k] = pair.dense.block<kSize, kSize>(at, at);
    if (k + 1 < blocks) {
      pair.banded.above[k] = pair.dense.block<kSize, kSize>(at, at + kSize);
    }
    pair.banded.border[k] = pair.dense.block<kSize, 1>(at, size - 1);
  }
  pair.banded.corner = pair.dense(size - 1, size - 1);
  return pair;
}

TEST(BlockTridiagonal, SolvesAsTheDenseMatrixDoes) {
  std::mt19937_64 random(1);
  for (const int blocks : {1, 2, 3, 17}) {
    Pair pair = MakePair(blocks, &random);
    const VectorXd b = VectorXd::Random(pair.banded.size());
    EXPECT_LT((pair.banded.Times(b) - pair.dense * b).norm(),
              1e-13 * pair.dense.norm() * b.norm());
    const VectorXd truth = pair.dense.ldlt().solve(b);
    ASSERT_TRUE(pair.banded.Factorize());
    VectorXd x = b;
    pair.banded.Solve(&x);
    EXPECT_LT((x - truth).norm(), 1e-9 * truth.norm()) << blocks;
  }
}

TEST(BlockTridiagonal, SaysWhatIsNotPositiveDefinite) {
  std::mt19937_64 random(2);
  for (const int block : {0, 2, 4}) {
    Pair pair = MakePair(5, &random);
    pair.banded.diagonal[block](3, 3) = -1.0;
    EXPECT_FALSE(pair.banded.Factorize()) << block;
  }
  Pair pair = MakePair(5, &random);
  pair.banded.corner = -1.0;
  EXPECT_FALSE(pair.banded.Factorize());
  EXPECT_FALSE(BlockTridiagonal(3).Factorize());
}

// Blocks of any size, and of the one that is known, are the same numbers.
TEST(BlockTridiagonal, IsTheSameOfAnySize) {
  std::mt19937_64 random(3);
  Pair pair = MakePair(6, &random);
  WideTridiagonal wide(6, kSize);
  for (int k = 0; k < 6; ++k) {
    wide.diagonal[k] = pair.banded.diagonal[k];
    wide.above[k] = pair.banded.above[k];
    wide.border[k] = pair.banded.border[k];
  }
  wide.corner = pair.banded.corner;
  ASSERT_EQ(wide.size(), pair.banded.size());
  VectorXd x = VectorXd::Random(wide.size()), y = x;
  EXPECT_LT((wide.Times(x) - pair.banded.Times(x)).norm(), 1e-9 * x.norm());
  ASSERT_TRUE(wide.Factorize());
  ASSERT_TRUE(pair.banded.Factorize());
  wide.Solve(&x);
  pair.banded.Solve(&y);
  EXPECT_LT((x - y).norm(), 1e-9 * y.norm());
}

}  // namespace
}  // namespace phongpd::internal
