// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact/depth.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {

// The largest file of points that is read.
inline constexpr std::uintmax_t kMaxPointsBytes = std::uintmax_t{1} << 31;

// Reads the columns x, y and z of a comma-separated file whose first line
// names its columns (any order, others are ignored; a byte-order mark, spaces
// around cells, CRLF and blank lines are accepted).  Throws InputError naming
// file, line and column for anything that is not a finite number, and what
// ReadInputFile refuses (core/mesh/input_file.h).  The file may be a pipe.
std::vector<Eigen::Vector3d> ReadPointsCsv(const std::string& path);

// The same from the content of `file`, which appears in messages.
std::vector<Eigen::Vector3d> ParsePointsCsv(std::string_view content,
                                            const std::string& file);

// The same for poses: columns x, y, z, qw, qx, qy and qz, the quaternion of
// unit length to 1e-9 (CheckPose).
std::vector<RobotPose> ReadPosesCsv(const std::string& path);
std::vector<RobotPose> ParsePosesCsv(std::string_view content,
                                     const std::string& file);

}  // namespace phongpd
