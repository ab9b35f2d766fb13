// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The triangles of a closed part of the mesh that winds around one of two
// points more often than around the other, so that every path between them
// crosses it; the smallest such part, empty if there is none.  A part is
// connected through edges, where more than two triangles meet in one those
// about the same free space (free_neighbors.h), and closed when every edge is
// passed as often one way as the other.  Winding numbers are exact, whether or
// not the mesh crosses itself; the points must be finite and not on the mesh.
std::vector<int> FindSeparatingPart(const TriangleMesh& mesh,
                                    const Eigen::Vector3d& one,
                                    const Eigen::Vector3d& other);

}  // namespace phongpd
