// SPDX-License-Identifier: GPL-3.0-or-later
// 06_turning_peg PEG SLOT: a peg longer than the slot is wide must turn to pass
// it.  Rows on exact depth at poses, solved by Ipopt to a local optimum, judged
// exactly at 1,000 poses (not between them).
#include <phongpd/constraints/pose_row.h>
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/trajectory/dense_program.h>

#include <iostream>

using namespace phongpd;
using Eigen::AngleAxisd, Eigen::MatrixXd, Eigen::Vector3d, Eigen::Vector4d,
    Eigen::VectorXd;

// Waypoints (x, y, z, angle about z) from y = −1.5 to 1.5; rows at thirds.
struct Passage final : DenseProgram {
  static constexpr int kFree = 9, kThirds = 3 * (kFree + 1) - 1;
  explicit Passage(const PoseRow& the_row)
      : DenseProgram(4 * kFree, VectorXd::Constant(kThirds, 0.02),
                     VectorXd::Constant(kThirds, kNoBound)),
        row(the_row) {}

  static Vector4d At(const VectorXd& x, int i) {
    if (i == 0 || i > kFree) return {0.0, i == 0 ? -1.5 : 1.5, 0.0, 0.0};
    return x.segment<4>(4 * (i - 1));
  }
  static RobotPose Pose(const VectorXd& x, double t) {
    const int i = std::min(static_cast<int>(t), kFree);
    const Vector4d p = At(x, i) + (t - i) * (At(x, i + 1) - At(x, i));
    return {p.head<3>(),
            Eigen::Quaterniond(AngleAxisd(p[3], Vector3d::UnitZ()))};
  }
  double Value(const VectorXd& x) const override {
    double sum = 0.0;
    for (int i = 0; i <= kFree; ++i)
      sum += (At(x, i + 1) - At(x, i)).squaredNorm();
    return sum;
  }
  VectorXd Gradient(const VectorXd& x) const override {
    VectorXd g(variables());
    for (int i = 1; i <= kFree; ++i)
      g.segment<4>(4 * (i - 1)) =
          2.0 * (2.0 * At(x, i) - At(x, i - 1) - At(x, i + 1));
    return g;
  }
  VectorXd Rows(const VectorXd& x) const override {
    VectorXd d(kThirds);
    for (int k = 1; k <= kThirds; ++k)
      d[k - 1] = row.At(Pose(x, k / 3.0)).value;
    return d;
  }
  MatrixXd RowGradients(const VectorXd& x) const override {
    MatrixXd entries = MatrixXd::Zero(kThirds, variables());
    for (int k = 1; k <= kThirds; ++k) {
      const PoseRowValue at = row.At(Pose(x, k / 3.0));
      Vector4d slope;
      slope << at.by_translation, at.by_rotation.z();
      for (const int i : {k / 3, k / 3 + 1})
        if (i >= 1 && i <= kFree)
          entries.block<1, 4>(k - 1, 4 * (i - 1)) =
              (i == k / 3 ? 1.0 - (k % 3) / 3.0 : (k % 3) / 3.0) *
              slope.transpose();
    }
    return entries;
  }
  const PoseRow& row;
};

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Solid peg = ReadSolid(argv[1]), slot = ReadSolid(argv[2]);
  const PoseRow row(peg, slot);
  Passage passage(row);
  Eigen::VectorXd x(passage.variables());
  for (int i = 1; i <= Passage::kFree; ++i)  // a quarter turn half-way
    x.segment<4>(4 * (i - 1)) << 0.0, -1.5 + 0.3 * i, 0.0,
        1.57 * std::sin(3.1416 * i / 10.0);
  const IpoptRun run = SolveWithIpopt(&passage, x, DenseProgram::Settings());
  double least = 1.0, turn = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const RobotPose pose = Passage::Pose(run.x, i / 100.0);
    least = std::min(least, row.At(pose).value);
    turn = std::max(turn, AngleAxisd(pose.orientation).angle());
  }
  std::cout << ToString(run.status) << ", turned by up to " << turn
            << " rad, clearance at 1001 poses at least " << least << '\n';
}
