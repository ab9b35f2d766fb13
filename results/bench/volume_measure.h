// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "results/bench/report.h"

// What modelling a part costs beside modelling the whole: boxes of growing
// volume around points of C_cont, from the two meshes on.
namespace phongpd::bench {

struct VolumeRow {
  std::string pair, level;  // "free space" or "window"
  double volume = 0.0;      // of the box, share of the box of C_cont
  // CPU time, share of a full build's: median and largest over the boxes.
  double cost = 0.0, largest = 0.0;
};

// Free space: a ConvolutionModel and a hundred random motions in each box.
// Window: the part of C_cont in it, all its cells judged.  `space` took
// `full_seconds` of CPU time.
std::vector<VolumeRow> MeasureVolumes(const std::string& pair,
                                      const TriangleMesh& robot,
                                      const TriangleMesh& obstacle,
                                      const ContactSpace& space,
                                      double full_seconds, std::uint64_t seed);

NamedTable VolumeTable(const std::vector<VolumeRow>& rows);

}  // namespace phongpd::bench
