// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/defect_mesh.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "core/mesh/mesh_error.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

const char* Color(DefectKind kind) {
  switch (kind) {
    case DefectKind::kOpenEdge:
      return "220 30 30";
    case DefectKind::kNonManifoldEdge:
      return "240 140 0";
    case DefectKind::kMisorientedEdge:
      return "30 90 220";
    case DefectKind::kSelfIntersection:
      break;
  }
  return "200 30 200";
}

bool IsPly(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (extension != ".ply" && extension != ".off" && path != "-") {
    throw InputError(path + ": expected a name that ends in .off or .ply, " +
                     "found another");
  }
  return extension == ".ply";
}

std::string PlyHeader(std::size_t vertices, std::size_t faces) {
  return "ply\nformat ascii 1.0\ncomment defects by phongpd\nelement vertex " +
         std::to_string(vertices) +
         "\nproperty double x\nproperty double y\nproperty double z\n"
         "element face " +
         std::to_string(faces) +
         "\nproperty list uchar int vertex_indices\nproperty uchar red\n"
         "property uchar green\nproperty uchar blue\nend_header\n";
}

}  // namespace

std::string DefectMeshContent(const TriangleMesh& mesh,
                              const std::vector<MeshDefect>& defects,
                              const std::string& path) {
  const bool is_ply = IsPly(path);
  std::map<int, DefectKind> marked;
  for (const MeshDefect& defect : defects) {
    for (const int t : defect.triangles) {
      const auto at = marked.emplace(t, defect.kind).first;
      at->second = std::min(at->second, defect.kind);
    }
  }
  std::map<int, std::size_t> ids;
  std::string vertices, faces;
  for (const auto& [t, kind] : marked) {
    faces += "3";
    for (const int v : mesh.triangles.at(static_cast<std::size_t>(t))) {
      const auto [at, is_new] = ids.emplace(v, ids.size());
      if (is_new) {
        const Eigen::Vector3d& p = mesh.vertices[static_cast<std::size_t>(v)];
        vertices += FormatDouble(p[0]) + ' ' + FormatDouble(p[1]) + ' ' +
                    FormatDouble(p[2]) + '\n';
      }
      faces += ' ' + std::to_string(at->second);
    }
    faces += std::string(" ") + Color(kind) + '\n';
  }
  const std::string header = is_ply
                                 ? PlyHeader(ids.size(), marked.size())
                                 : "OFF\n" + std::to_string(ids.size()) + ' ' +
                                       std::to_string(marked.size()) + " 0\n";
  return header + vertices + faces;
}

}  // namespace phongpd
