// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/mesh/triangle_mesh.h"
#include "results/bench/report.h"

// Free space from the convolution alone beside the whole contact space.
namespace phongpd::bench {

// The median CPU time of five runs.
double MedianCpuSeconds(const std::function<void()>& work);

struct FreeSpaceRow {
  std::string name;
  std::size_t robot = 0, obstacle = 0;   // triangles
  double full_seconds = 0.0;             // CPU
  double seconds = 0.0;                  // CPU, until questions can be asked
  double first_milliseconds = 0.0;       // CPU, of the first motion check
  std::size_t facets = 0, modelled = 0;  // of the convolution; of it by all
                                         // checks, some several times
  int segments = 0, free = 0, disagreements = 0;
  double worst_clearance = 0.0;  // difference, share of D
  // CPU, per motion check: of all, what they model included, and once more.
  double full_microseconds = 0.0, microseconds = 0.0, again_microseconds = 0.0;
};

// Random segments in the box of the contact space, a tenth of its size on
// average; `space` took `full_seconds`.
FreeSpaceRow MeasureFreeSpace(const std::string& name,
                              const TriangleMesh& robot,
                              const TriangleMesh& obstacle,
                              const ContactSpace& space, double full_seconds,
                              int segments, std::uint64_t seed);

NamedTable FreeSpaceTable(const std::vector<FreeSpaceRow>& rows);

}  // namespace phongpd::bench
