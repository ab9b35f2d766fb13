// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/page_numbers.h"

#include <cstdint>

namespace phongpd::internal {

using Eigen::Vector3d;

std::string Base64(const std::string& bytes) {
  constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group <<= 8U;
      if (i + k < bytes.size())
        group |= static_cast<unsigned char>(bytes[i + k]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_padding = i + k > bytes.size();
      text += is_padding ? '=' : kDigits[(group >> (18U - 6U * k)) & 63U];
    }
  }
  return text;
}

nlohmann::ordered_json PointJson(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

nlohmann::ordered_json PointsJson(const std::vector<Eigen::Vector3d>& points) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Eigen::Vector3d& p : points) json.push_back(PointJson(p));
  return json;
}

nlohmann::ordered_json TurnJson(const Eigen::Quaterniond& turn) {
  return {turn.w(), turn.x(), turn.y(), turn.z()};
}

std::string ShownPositions(const std::vector<Vector3d>& points,
                           const PageFrame& frame) {
  std::string bytes;
  for (const Vector3d& p : points) {
    for (int k = 0; k < 3; ++k) {
      AppendNumber(&bytes,
                   static_cast<float>((p[k] - frame.center[k]) / frame.scale));
    }
  }
  return bytes;
}

std::string CornerBytes(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) AppendNumber(&bytes, static_cast<std::uint32_t>(v));
  }
  return bytes;
}

}  // namespace phongpd::internal
