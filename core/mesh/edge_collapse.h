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
  // The mesh the sequence starts from: as given, but with a vertex of its own
  // for every fan of triangles.
  const TriangleMesh& original() const { return original_; }

  struct Prefix {
    TriangleMesh mesh;  // used vertices only
    // Where each vertex of original() went.
    std::vector<Eigen::Vector3d> images;
  };
  Prefix After(std::size_t steps) const;

 private:
  struct Step {
    int removed, kept;
    Eigen::Vector3d position;  // of the kept one from now on
  };

  TriangleMesh original_;
  std::vector<Step> steps_;
};

}  // namespace phongpd::internal
