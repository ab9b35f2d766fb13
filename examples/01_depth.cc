// SPDX-License-Identifier: GPL-3.0-or-later
// 01_depth ROBOT OBSTACLE: how deep is the robot in the obstacle, and which way
// is out?  It is pushed into the back of the U from the left, until the other
// side is nearer: Euclidean depth flips over, PhongPD keeps to its branch.
#include <phongpd/core/contact/contact_space.h>
#include <phongpd/core/mesh/mesh_io.h>
#include <phongpd/core/projection/euclidean_metric.h>
#include <phongpd/core/projection/phong_metric.h>

#include <exception>
#include <iostream>

using Eigen::Vector3d;

namespace {

void Print(const char* name, const phongpd::PenetrationResult& result) {
  std::cout << "  " << name << " depth " << -result.signed_distance
            << ", out along " << result.direction.transpose() << '\n';
}

int Run(char** files) {
  // All positions of the robot at which the two touch, as a closed mesh.
  const phongpd::ContactSpace space = phongpd::BuildContactSpace(
      phongpd::ReadMesh(files[1]), phongpd::ReadMesh(files[2]));
  const phongpd::EuclideanMetric euclidean(space);
  const phongpd::PhongMetric phong(space);

  phongpd::Branch branch;  // empty at first, then carried from query to query
  for (const double x : {-0.1, 0.0, 0.1, 0.2, 0.3, 0.4}) {
    const Vector3d q(x, 1.1, 0.05);  // the robot's translation
    const phongpd::PenetrationResult result = phong.Query(q, branch);
    branch = result.branch;
    std::cout << "x = " << x << '\n';
    Print("Euclidean", euclidean.Query(q));
    Print("Phong", result);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: 01_depth ROBOT OBSTACLE\n";
    return 2;
  }
  try {
    return Run(argv);
  } catch (const std::exception& error) {  // one line: what, where, how to mend
    std::cerr << error.what() << '\n';
    return 2;
  }
}
