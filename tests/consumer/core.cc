// SPDX-License-Identifier: GPL-3.0-or-later
// The README's example: how deep is a small box in a large one?
#include <phongpd/core/contact/contact_space.h>
#include <phongpd/core/mesh/mesh_io.h>
#include <phongpd/core/projection/phong_metric.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const phongpd::TriangleMesh robot = phongpd::ReadMesh(argv[1]);
  const phongpd::TriangleMesh obstacle = phongpd::ReadMesh(argv[2]);
  const phongpd::ContactSpace space =
      phongpd::BuildContactSpace(robot, obstacle);
  const phongpd::PhongMetric metric(space);

  phongpd::Branch branch;  // carried from query to query
  for (double x = -2.0; x <= 2.0; x += 0.5) {
    const Eigen::Vector3d q(x, 0.1, 0.2);
    const phongpd::PenetrationResult result = metric.Query(q, branch);
    branch = result.branch;
    std::cout << x << ": " << result.signed_distance << '\n';
  }
}
