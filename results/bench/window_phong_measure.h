// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/mesh/triangle_mesh.h"
#include "results/bench/report.h"

// PhongPD (ℓ = 0) from windows beside the whole contact space.
namespace phongpd::bench {

struct WindowPhongRow {
  std::string name;
  std::size_t full_faces = 0;
  double whole_seconds = 0.0;          // CPU, the build and its metric
  std::vector<double> seconds, faces;  // per query: CPU, faces arranged
  int from_windows = 0, wrong = 0;
  double worst_error = 0.0;  // share of the diagonal
};

// Random configurations at most `depth` (a share of the diagonal) below random
// points of C_cont, each asked of two meshes from nothing; `space` took
// `full_seconds`.
WindowPhongRow MeasureWindowPhong(const std::string& name,
                                  const TriangleMesh& robot,
                                  const TriangleMesh& obstacle,
                                  const ContactSpace& space,
                                  double full_seconds, double depth,
                                  std::uint64_t seed);

NamedTable WindowPhongTable(const std::vector<WindowPhongRow>& rows);

}  // namespace phongpd::bench
