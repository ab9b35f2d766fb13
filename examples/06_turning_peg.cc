// SPDX-License-Identifier: GPL-3.0-or-later
// 06_turning_peg PEG SLOT: a peg longer than the slot is wide must turn to pass
// it.  Rows on exact depth at poses, solved by Ipopt to a local optimum, judged
// exactly at 1,000 poses (not between them).
#include <phongpd/constraints/pose_row.h>
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/trajectory/ipopt_solve.h>

#include <iostream>

using namespace phongpd;
using Eigen::AngleAxisd, Eigen::Vector3d, Eigen::Vector4d;

// Waypoints (x, y, z, angle about z) from y = −1.5 to 1.5; rows at thirds.
struct Passage final : NonlinearProgram {
  explicit Passage(const PoseRow& the_row) : row(the_row) {}
  static constexpr int kFree = 9, kThirds = 3 * (kFree + 1) - 1;
  static Vector4d At(const double* x, int i) {
    if (i == 0 || i > kFree) return {0.0, i == 0 ? -1.5 : 1.5, 0.0, 0.0};
    return Eigen::Map<const Vector4d>(x + 4 * (i - 1));
  }
  static RobotPose Pose(const double* x, double t) {
    const int i = std::min(static_cast<int>(t), kFree);
    const Vector4d p = At(x, i) + (t - i) * (At(x, i + 1) - At(x, i));
    return {p.head<3>(),
            Eigen::Quaterniond(AngleAxisd(p[3], Vector3d::UnitZ()))};
  }
  int variables() const override { return 4 * kFree; }
  int rows() const override { return kThirds; }
  int jacobian_nonzeros() const override { return kThirds * variables(); }
  int hessian_nonzeros() const override { return 0; }  // limited memory
  void Bounds(double* xl, double* xu, double* gl, double* gu) const override {
    std::fill(xl, xl + variables(), -kNoBound);
    std::fill(xu, xu + variables(), kNoBound);
    std::fill(gl, gl + kThirds, 0.02), std::fill(gu, gu + kThirds, kNoBound);
  }
  void JacobianPattern(int* r, int* c) const override {  // dense
    for (int i = 0; i < jacobian_nonzeros(); ++i)
      r[i] = i / variables(), c[i] = i % variables();
  }
  void HessianPattern(int*, int*) const override {}
  void Hessian(const double*, double, const double*, double*) const override {}
  double Objective(const double* x) const override {
    double sum = 0.0;
    for (int i = 0; i <= kFree; ++i)
      sum += (At(x, i + 1) - At(x, i)).squaredNorm();
    return sum;
  }
  void ObjectiveGradient(const double* x, double* g) const override {
    for (int i = 1; i <= kFree; ++i)
      Eigen::Map<Vector4d>(g + 4 * (i - 1)) =
          2.0 * (2.0 * At(x, i) - At(x, i - 1) - At(x, i + 1));
  }
  bool Constraints(const double* x, double* d, double* entries) override {
    if (entries) std::fill(entries, entries + jacobian_nonzeros(), 0.0);
    for (int k = 1; k <= kThirds; ++k) {
      const PoseRowValue at = row.At(Pose(x, k / 3.0));
      if (d) d[k - 1] = at.value;
      Vector4d slope;
      slope << at.by_translation, at.by_rotation.z();
      for (const int i : {k / 3, k / 3 + 1})
        if (entries && i >= 1 && i <= kFree)
          Eigen::Map<Vector4d>(entries + (k - 1) * variables() + 4 * (i - 1)) =
              (i == k / 3 ? 1.0 - (k % 3) / 3.0 : (k % 3) / 3.0) * slope;
    }
    return true;
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
  IpoptSettings settings;
  settings.ipopt_options = {{"hessian_approximation", "limited-memory"}};
  const IpoptRun run = SolveWithIpopt(&passage, x, settings);
  double least = 1.0, turn = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const RobotPose pose = Passage::Pose(run.x.data(), i / 100.0);
    least = std::min(least, row.At(pose).value);
    turn = std::max(turn, AngleAxisd(pose.orientation).angle());
  }
  std::cout << ToString(run.status) << ", turned by up to " << turn
            << " rad, clearance at 1001 poses at least " << least << '\n';
}
