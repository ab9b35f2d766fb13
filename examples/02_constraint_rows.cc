// SPDX-License-Identifier: GPL-3.0-or-later
// 02_constraint_rows ROBOT OBSTACLE: non-penetration rows in your own solver.
#include <phongpd/constraints/motion_oracle.h>
#include <phongpd/constraints/non_penetration.h>
#include <phongpd/constraints/sampling_rule.h>
#include <phongpd/core/contact/contact_space.h>
#include <phongpd/core/solid/solid.h>

#include <Eigen/Dense>
#include <iostream>

using namespace phongpd;
using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Solid robot = ReadSolid(argv[1]), obstacle = ReadSolid(argv[2]);
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const auto metric = std::make_shared<SignedMetric>(space);

  // A polyline through 12 free points u; samples in each of its 13 segments by
  // the rule, for segments up to 1.6 times those of the straight line.
  constexpr double kMargin = 0.05, kWeight = 1e4;
  const Vector3d start(-1.0, 0.1, 0.0), goal(3.0, -0.1, 0.1);
  const int samples =
      SamplesByRule(1.6 * (goal - start).norm() / 13, kMargin, 1000);
  const NonPenetrationConstraint rows({metric}, start, goal, 12,
                                      std::vector<int>(13, samples));
  const int n = rows.variables(), m = rows.rows(), e = rows.nonzeros();
  Eigen::VectorXi row(e), col(e);
  rows.Sparsity(row.data(), col.data());
  // Σ |p_{i+1} − p_i|² = uᵀ L u − 2 bᵀ u + const: least on the straight line.
  MatrixXd L = 2.0 * MatrixXd::Identity(n, n);
  L.diagonal(3).setConstant(-1.0), L.diagonal(-3).setConstant(-1.0);
  VectorXd b = VectorXd::Zero(n), d(m), entries(e);
  b.head<3>() = start, b.tail<3>() = goal;
  VectorXd u = L.ldlt().solve(b);
  BranchSet branches = rows.Start(u.data(), nullptr);
  for (int k = 0; k < 60; ++k) {
    rows.Evaluate(u.data(), branches, d.data(), entries.data(), nullptr);
    if (k == 0) std::cout << "straight: d >= " << d.minCoeff() << '\n';
    // Σ |p_{i+1} − p_i|² + weight · Σ max(0, margin − d)², d taken as linear.
    const VectorXd r = (kMargin - d.array()).cwiseMax(0.0);
    MatrixXd J = MatrixXd::Zero(m, n);
    for (int i = 0; i < e; ++i)
      if (r[row[i]] > 0.0) J(row[i], col[i]) = entries[i];
    const MatrixXd Jt = kWeight * J.transpose();
    u += 0.5 * (L + Jt * J).ldlt().solve(b - L * u + Jt * r);
    rows.Commit(u.data(), &branches, nullptr);  // branches follow what is taken
  }
  rows.Evaluate(u.data(), branches, d.data(), nullptr, nullptr);
  // A second opinion: whole segments, exactly, on the original meshes.
  const MotionOracle oracle(robot, obstacle);
  bool hit =
      oracle.Collides(start, u.head<3>()) || oracle.Collides(u.tail<3>(), goal);
  for (int i = 3; i < n; i += 3) {
    hit = hit || oracle.Collides(u.segment<3>(i - 3), u.segment<3>(i));
  }
  std::cout << "solved: d >= " << d.minCoeff()
            << (hit ? ", hits\n" : ", free\n");
}
