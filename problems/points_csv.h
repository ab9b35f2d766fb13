// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"

namespace phongpd {

// Reads the columns x, y and z of a comma-separated file whose first line
// names its columns (any order, others are ignored; a byte-order mark, spaces
// around cells, CRLF and blank lines are accepted).  Throws InputError naming
// file, line and column for anything that is not a finite number.
std::vector<Eigen::Vector3d> ReadPointsCsv(const std::string& path);

}  // namespace phongpd
