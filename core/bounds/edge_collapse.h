// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// A sequence of edge collapses on a closed mesh, cheapest first (Lindstrom
// and Turk 1998).  Every prefix of it is a mesh of its own, which need not
// have been built by whoever found the sequence: it is the image of the
// original triangles under "vertex → vertex it was merged into".
class CollapseSequence {
 public:
  // As far as about `target` triangles, or as far as topology allows.
  CollapseSequence(const TriangleMesh& mesh, std::size_t target);

  std::size_t size() const { return steps_.size(); }
  // The mesh after that many steps, used vertices only.
  TriangleMesh After(std::size_t steps) const;

 private:
  struct Step {
    int removed, kept;
    Eigen::Vector3d position;  // of the kept one from now on
  };

  TriangleMesh original_;  // with a vertex for every fan of triangles
  std::vector<Step> steps_;
};

}  // namespace phongpd::internal
