// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/path_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "problems/output/metric_color.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<Vector3d, Vector3d>;

Vector3d Normal(const TriangleMesh& mesh, const Triangle& t) {
  const Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a)
      .cross(mesh.vertices[t[2]] - a)
      .stableNormalized();
}

// Edges whose two facets turn by more than 20°; all of them where none does,
// as on a finely tessellated ball.
std::vector<Edge> SharpEdges(const TriangleMesh& mesh, double cosine = 0.94) {
  std::vector<Edge> edges;
  const std::vector<std::array<int, 3>> neighbors = TriangleNeighbors(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const int other = neighbors[t][k];
      if (other >= 0 && other < static_cast<int>(t)) continue;
      if (other >= 0 &&
          Normal(mesh, triangle).dot(Normal(mesh, mesh.triangles[other])) >
              cosine) {
        continue;
      }
      edges.emplace_back(mesh.vertices[triangle[k]],
                         mesh.vertices[triangle[(k + 1) % 3]]);
    }
  }
  const bool is_smooth = edges.empty() && !mesh.triangles.empty();
  return is_smooth && cosine < 2.0 ? SharpEdges(mesh, 2.0) : edges;
}

// Of the contact spaces and the paths.
BoundingBox Region(const View& view) {
  View drawn;
  drawn.paths = view.paths;
  for (const ViewMesh& mesh : view.meshes) {
    if (mesh.role == ViewRole::kContactSpace) drawn.meshes.push_back(mesh);
  }
  return ViewBounds(drawn);
}

}  // namespace

std::string PathSvg(const View& view) {
  constexpr double kWidth = 640.0, kHeight = 460.0;
  const BoundingBox box = Region(view);
  const Vector3d center = box.Center();
  const double yaw = 0.6, pitch = 0.5;
  const double scale = 0.8 * kHeight / std::max(box.Diagonal(), 1e-300);
  const auto project = [&](const Vector3d& p) {
    const Vector3d d = scale * (p - center);
    const double u = std::cos(yaw) * d.x() + std::sin(yaw) * d.y();
    const double w = -std::sin(yaw) * d.x() + std::cos(yaw) * d.y();
    return Rounded(0.5 * kWidth + 1.3 * u, 6) + "," +
           Rounded(0.5 * kHeight -
                       1.3 * (std::cos(pitch) * d.z() + std::sin(pitch) * w),
                   6);
  };
  TextStream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kWidth
      << ' ' << kHeight << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      << "<path fill=\"none\" stroke=\"#aaa\" stroke-width=\"0.8\" d=\"";
  for (const ViewMesh& mesh : view.meshes) {
    if (mesh.role != ViewRole::kContactSpace) continue;
    for (const auto& [a, b] : SharpEdges(mesh.mesh)) {
      svg << 'M' << project(a) << 'L' << project(b);
    }
  }
  svg << "\"/>\n<text x=\"12\" y=\"22\" font-weight=\"bold\">"
      << Escaped(view.title) << "</text>\n";
  std::vector<std::string> names;
  for (const NamedPath& path : view.paths) names.push_back(path.name);
  const std::vector<std::string> colors = LineColors(names);
  for (std::size_t i = 0; i < view.paths.size(); ++i) {
    const NamedPath& path = view.paths[i];
    svg << "<polyline fill=\"none\" stroke=\"" << colors[i]
        << "\" stroke-width=\"2\""
        << (path.is_free ? "" : " stroke-dasharray=\"6 4\"") << " points=\"";
    for (const Vector3d& p : path.points) svg << project(p) << ' ';
    svg << "\"/>\n<text x=\"12\" y=\"" << 42 + 18 * i << "\" fill=\""
        << colors[i] << "\">" << Escaped(path.name) << "</text>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace phongpd
