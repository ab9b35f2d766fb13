// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// How numbers are written into the data block of a page.
namespace phongpd::internal {

// Pages hold (p − center) / scale.
struct PageFrame {
  Eigen::Vector3d center;
  double scale;
};

// RFC 4648, with padding.
std::string Base64(const std::string& bytes);

template <typename Number>
void AppendNumber(std::string* bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes->append(raw, sizeof number);
}

nlohmann::ordered_json PointJson(const Eigen::Vector3d& p);
nlohmann::ordered_json PointsJson(const std::vector<Eigen::Vector3d>& points);
// [w, x, y, z]
nlohmann::ordered_json TurnJson(const Eigen::Quaterniond& turn);

// float32 triples, as the page draws them.
std::string ShownPositions(const std::vector<Eigen::Vector3d>& points,
                           const PageFrame& frame);
// uint32 triples.
std::string CornerBytes(const TriangleMesh& mesh);

}  // namespace phongpd::internal
