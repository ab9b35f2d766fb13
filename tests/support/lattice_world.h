// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "planners/world/workspace.h"

namespace phongpd::testing {

// A robot and obstacles made of boxes with integer corners, and what is known
// of their free space without any planner.
//
// C_obj is the union of the sums of their boxes, closed boxes with integer
// corners.  Per axis a configuration is at an integer or between two, so free
// space is a set of cells of the lattice of halves: x ↦ 2x.  It is open, so two
// of them are connected iff steps of one half between free cells connect them.
//
// The whole may be mapped by an integer matrix, which moves no point off the
// integers and turns boxes into oblique prisms.
struct LatticeWorld {
  using Cell = std::array<int, 3>;  // twice the coordinates

  enum class Family { kBox, kL, kU, kSlots, kVoxels };
  static constexpr int kFamilies = 5;

  std::string name;
  Workspace workspace;  // before the map; sets bounds in some worlds
  std::vector<std::array<Eigen::Vector3i, 2>> boxes;  // of C_obj
  Eigen::Matrix3i map = Eigen::Matrix3i::Identity();
  TriangleMesh contact_space;  // mapped
  Cell min, max;               // cells that are labelled
  std::vector<int> labels;     // of cells, −1: not free

  // Of a free cell the number of its connected part, −1: not free.
  int Label(const Cell& cell) const;
  Eigen::Vector3d Point(const Cell& cell) const;  // mapped
  Cell RandomCell(std::mt19937_64* random) const;

  // By rational arithmetic on the boxes: does the path keep off all of them,
  // and within the bounds?
  bool IsFree(const std::vector<Eigen::Vector3d>& path) const;
};

// Any integer from low to high, and a point of three.
int Pick(int low, int high, std::mt19937_64* random);
Eigen::Vector3i PickPoint(int low, int high, std::mt19937_64* random);

// Sets min, max and labels by boxes and bounds.
void LabelCells(LatticeWorld* world);

LatticeWorld MakeLatticeWorld(LatticeWorld::Family family, bool mapped,
                              std::mt19937_64* random);

}  // namespace phongpd::testing
