// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace phongpd {

// The linear system of one step of an interior point method whose rows are all
// inequalities, with a slack s and a multiplier y each,
//
//   ⎡ W      Jᵀ ⎤ ⎡ x ⎤   ⎡ r_x ⎤
//   ⎢    S   C  ⎥ ⎢ s ⎥ = ⎢ r_s ⎥    S, C, E diagonal,  ES + C² > 0
//   ⎣ J  C  −E  ⎦ ⎣ y ⎦   ⎣ r_y ⎦
//
// solved by eliminating s and y row by row:
//
//   K x = r_x + Jᵀ(Θ r_y − Φ r_s),   K = W + JᵀΘJ,
//   y = Θ(J x − r_y) + Φ r_s,        s = (r_y − J x + E y)/C
//
// with Θ = S/(ES + C²) and Φ = C/(ES + C²).  However many rows there are, what
// is factorised is as large as x, and as sparse as waypoints that only know
// their neighbours leave it.  Active rows make Θ large, and K as ill
// conditioned as 1/mu: solvers refine the solution of the whole system.
class CondensedSystem {
 public:
  // Rows m ≥ 0; x, s, y is the order of the unknowns.
  explicit CondensedSystem(int rows) : rows_(rows) {}
  int rows() const { return rows_; }

  // The symmetric matrix of `size` unknowns as one triangle of entries from 1
  // on, repeated ones adding up.  False if they are not of the form above.
  // Once.
  bool Analyze(int size, int entries, const int* row, const int* col);

  enum class Inertia {
    kAsWanted,  // as many negative eigenvalues as rows: K is positive definite
    kOther,
  };
  // After Analyze; the values in the order of its entries.  Values that are not
  // finite make kOther.
  Inertia Factorize(const double* values);

  // After kAsWanted; from right-hand side to solution.
  void Solve(double* unknowns) const;

 private:
  // An entry of the matrix, and where its value goes.
  struct Target {
    int entry;
    int place;
  };
  // The product of two entries of a row of J.
  struct Product {
    int row, first, second;  // of the entries
    int place;               // in K
  };
  struct JacobianEntry {
    int entry, row, variable;
  };
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  bool Sort(int entries, const int* row, const int* col,
            std::vector<std::array<int, 3>>* of_w);
  void BuildPattern(const std::vector<std::array<int, 3>>& of_w);
  int Place(int one, int other) const;
  double Theta(int row) const { return slack_[row] * inverse_[row]; }
  double Phi(int row) const { return coupling_[row] * inverse_[row]; }

  int rows_ = 0, variables_ = 0;
  std::vector<Target> to_slack_, to_coupling_, to_diagonal_;  // S, C, −E
  std::vector<JacobianEntry> jacobian_;                       // by row
  std::vector<Target> to_k_;
  std::vector<Product> products_;
  std::vector<int> position_;  // of a variable in K
  Eigen::VectorXd slack_, coupling_, diagonal_;
  Eigen::VectorXd inverse_;          // 1/(ES + C²)
  Eigen::VectorXd jacobian_values_;  // in the order of jacobian_
  Matrix k_;                         // upper triangle
  Eigen::SimplicialLLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>>
      factor_;
};

}  // namespace phongpd
