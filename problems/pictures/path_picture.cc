// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/pictures/path_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "problems/output/text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<Vector3d, Vector3d>;

constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73",
                                   "#cc79a7", "#e69f00", "#56b4e9"};

const char* Color(std::size_t path) { return kColors[path % 6]; }

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

BoundingBox Region(const PathScene& scene) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : scene.contact_meshes) all = Joined(all, mesh);
  BoundingBox box = ComputeBounds(all);
  for (const NamedPath& path : scene.paths) {
    for (const Vector3d& p : path.points) {
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
  }
  return box;
}

std::string JsonPoint(const Vector3d& p) {
  return "[" + Rounded(p.x(), 7) + "," + Rounded(p.y(), 7) + "," +
         Rounded(p.z(), 7) + "]";
}

std::string JsonEdges(const std::vector<Edge>& edges) {
  std::string text = "[";
  for (const auto& [a, b] : edges) {
    if (text.size() > 1) text += ",";
    text += "[" + JsonPoint(a) + "," + JsonPoint(b) + "]";
  }
  return text + "]";
}

constexpr char kScript[] = R"(
const canvas = document.querySelector('canvas'), g = canvas.getContext('2d');
const slider = document.querySelector('input');
let yaw = 0.6, pitch = 0.5, zoom = 1;
function view(p) {
  const [x, y, z] = p.map((v, k) => (v - scene.center[k]) / scene.size);
  const c = Math.cos(yaw), s = Math.sin(yaw);
  const u = c * x + s * y, w = -s * x + c * y;
  const scale = 0.9 * zoom * Math.min(canvas.width, canvas.height);
  return [canvas.width / 2 + scale * u, canvas.height / 2 -
    scale * (Math.cos(pitch) * z + Math.sin(pitch) * w)];
}
function lines(edges, move, color, width) {
  g.strokeStyle = color; g.lineWidth = width; g.beginPath();
  for (const [a, b] of edges) {
    g.moveTo(...view(a.map((v, k) => v + move[k])));
    g.lineTo(...view(b.map((v, k) => v + move[k])));
  }
  g.stroke();
}
function along(points, t) {
  const steps = [];
  let total = 0;
  for (let i = 1; i < points.length; ++i) {
    steps.push(Math.hypot(...points[i].map((v, k) => v - points[i - 1][k])));
    total += steps[i - 1];
  }
  let left = t * total;
  for (let i = 0; i < steps.length; ++i) {
    if (left <= steps[i] && steps[i] > 0) {
      return points[i].map((v, k) =>
        v + left / steps[i] * (points[i + 1][k] - v));
    }
    left -= steps[i];
  }
  return points[points.length - 1];
}
function draw() {
  canvas.width = canvas.clientWidth; canvas.height = canvas.clientHeight;
  lines(scene.contact, [0, 0, 0], '#999', 1);
  for (const path of scene.paths) {
    g.setLineDash(path.free ? [] : [6, 4]);
    const edges = path.points.slice(1).map((p, i) => [path.points[i], p]);
    lines(edges, [0, 0, 0], path.color, 2.5);
  }
  g.setLineDash([]);
  if (scene.paths.length && scene.paths[0].points.length) {
    lines(scene.robot, along(scene.paths[0].points, slider.value / 1000),
      '#000', 1);
  }
}
canvas.onpointermove = e => {
  if (!e.buttons) return;
  yaw += e.movementX / 150; pitch += e.movementY / 150; draw();
};
canvas.onwheel = e => {
  zoom *= Math.exp(-e.deltaY / 600); draw(); e.preventDefault();
};
slider.oninput = draw; window.onresize = draw; draw();
)";

}  // namespace

std::string PathSvg(const PathScene& scene) {
  constexpr double kWidth = 640.0, kHeight = 460.0;
  const BoundingBox box = Region(scene);
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
  for (const TriangleMesh& mesh : scene.contact_meshes) {
    for (const auto& [a, b] : SharpEdges(mesh)) {
      svg << 'M' << project(a) << 'L' << project(b);
    }
  }
  svg << "\"/>\n<text x=\"12\" y=\"22\" font-weight=\"bold\">"
      << Escaped(scene.title) << "</text>\n";
  for (std::size_t i = 0; i < scene.paths.size(); ++i) {
    const NamedPath& path = scene.paths[i];
    svg << "<polyline fill=\"none\" stroke=\"" << Color(i)
        << "\" stroke-width=\"2\""
        << (path.is_free ? "" : " stroke-dasharray=\"6 4\"") << " points=\"";
    for (const Vector3d& p : path.points) svg << project(p) << ' ';
    svg << "\"/>\n<text x=\"12\" y=\"" << 42 + 18 * i << "\" fill=\""
        << Color(i) << "\">" << Escaped(path.name) << "</text>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

std::string PathPage(const PathScene& scene) {
  const BoundingBox box = Region(scene);
  std::vector<Edge> contact;
  for (const TriangleMesh& mesh : scene.contact_meshes) {
    const std::vector<Edge> edges = SharpEdges(mesh);
    contact.insert(contact.end(), edges.begin(), edges.end());
  }
  TextStream page;
  page << "<!doctype html>\n<meta charset=\"utf-8\">\n<title>"
       << Escaped(scene.title)
       << "</title>\n<style>body{font:14px sans-serif;margin:1em}"
          "canvas{width:100%;height:75vh;border:1px solid #ccc;"
          "touch-action:none}input{width:100%}</style>\n<h1>"
       << Escaped(scene.title)
       << "</h1>\n<p>Grey: contact space. Drag to turn, wheel to zoom; the "
          "slider moves the robot along the first path.";
  for (std::size_t i = 0; i < scene.paths.size(); ++i) {
    page << " <b style=\"color:" << Color(i) << "\">"
         << Escaped(scene.paths[i].name) << "</b>";
  }
  page << "</p>\n<canvas></canvas>\n<input type=\"range\" max=\"1000\" "
          "value=\"300\">\n<script>\nconst scene = {center: "
       << JsonPoint(box.Center())
       << ", size: " << Rounded(std::max(box.Diagonal(), 1e-300), 7)
       << ",\n contact: " << JsonEdges(contact)
       << ",\n robot: " << JsonEdges(SharpEdges(scene.robot)) << ",\n paths: [";
  for (std::size_t i = 0; i < scene.paths.size(); ++i) {
    page << (i > 0 ? ",\n" : "") << "{color: \"" << Color(i)
         << "\", free: " << (scene.paths[i].is_free ? "true" : "false")
         << ", points: [";
    for (std::size_t k = 0; k < scene.paths[i].points.size(); ++k) {
      page << (k > 0 ? "," : "") << JsonPoint(scene.paths[i].points[k]);
    }
    page << "]}";
  }
  page << "]};\n" << kScript << "</script>\n";
  return page.str();
}

}  // namespace phongpd
