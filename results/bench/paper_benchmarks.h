// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "problems/studies/motion.h"

// The three benchmarks of the paper (section VI): ball and cone, cone and
// axes, ball and wrench.  Its meshes are unpublished; ours are rebuilt from
// their sizes.  Robot A moves, obstacle B is fixed.
namespace phongpd {

struct PaperMotion {
  std::string name;
  std::string summary;  // what it shows
  StraightMotion motion;
};

struct PaperBenchmark {
  std::string name;   // of the scene family
  std::string title;  // for people
  TriangleMesh robot;
  TriangleMesh obstacle;
  std::string paper_triangles;  // of the contact space, as printed there
  std::vector<PaperMotion> motions;
};

// All three, in the paper's order, each with straight motions of 400 frames
// that cross the medial axis off-centre.
std::vector<PaperBenchmark> PaperBenchmarks();

// Fig. 8's moment: the robot pushed over a bar, in a plane x = const of
// ball_wrench (the bar is the wrench's handle).
PaperMotion PaperMoment();

}  // namespace phongpd
