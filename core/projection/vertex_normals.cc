// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/vertex_normals.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/projection/intrinsic_delaunay.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Altitude, relative to the bounding box's diagonal, below which rounding of
// coordinates (1e-16 of it) turns a facet normal by more than 1e-4.
constexpr double kFlatAltitude = 1e-12;
// Length of a normalised weighted sum below which its direction is rounding.
constexpr double kVanishing = 1e-12;

bool LexicographicLess(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(),
                                      b.data() + 3);
}

// 2·area·N_f, from the corner where the two shortest edges meet: the cross
// product's error grows with the product of its factors' lengths.  Ties are
// broken by coordinates, so the first vertex of the triple does not matter.
Vector3d AreaVector(const TriangleMesh& mesh, const Triangle& t,
                    double* longest) {
  double best = -1.0;
  Vector3d result = Vector3d::Zero();
  Vector3d apex = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[k])];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
    const Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[(k + 2) % 3])];
    const double opposite = (c - b).squaredNorm();
    if (opposite > best || (opposite == best && LexicographicLess(a, apex))) {
      best = opposite;
      apex = a;
      result = (b - a).cross(c - a);
    }
  }
  *longest = std::sqrt(std::max(best, 0.0));
  return result;
}

// The contributions of all facets to each vertex, sorted by value.
struct Contribution {
  int vertex;
  double weight;
  Vector3d normal;
};

void SortByValue(std::vector<Contribution>* list) {
  std::sort(list->begin(), list->end(),
            [](const Contribution& a, const Contribution& b) {
              if (a.vertex != b.vertex) return a.vertex < b.vertex;
              if (a.weight != b.weight) return a.weight < b.weight;
              return LexicographicLess(a.normal, b.normal);
            });
}

// Weighted means, optionally normalised; zero where they vanish.
std::vector<Vector3d> Average(std::vector<Contribution> list,
                              std::size_t vertices, bool unit) {
  SortByValue(&list);
  std::vector<Vector3d> sum(vertices, Vector3d::Zero());
  std::vector<double> total(vertices, 0.0);
  for (const Contribution& c : list) {
    const auto v = static_cast<std::size_t>(c.vertex);
    sum[v] += c.weight * c.normal;
    total[v] += c.weight;
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const double length = sum[v].norm();
    if (total[v] <= 0.0 || (unit && length <= kVanishing * total[v])) {
      sum[v].setZero();
    } else {
      sum[v] /= unit ? length : total[v];
    }
  }
  return sum;
}

double Area(const TriangleMesh& mesh, const Triangle& t) {
  double longest = 0.0;
  return 0.5 * AreaVector(mesh, t, &longest).norm();
}

}  // namespace

std::vector<Vector3d> FacetNormals(const TriangleMesh& mesh) {
  const double flat = kFlatAltitude * ComputeBounds(mesh).Diagonal();
  std::vector<Vector3d> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    double longest = 0.0;
    const Vector3d cross = AreaVector(mesh, t, &longest);
    const double length = cross.norm();
    normals.push_back(length <= flat * longest ? Vector3d(Vector3d::Zero())
                                               : Vector3d(cross / length));
  }
  return normals;
}

std::vector<Vector3d> VertexNormals(
    const TriangleMesh& mesh, const std::vector<Vector3d>& facet_normals) {
  std::vector<Contribution> list;
  list.reserve(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Vector3d& normal = facet_normals[f];
    if (normal.isZero(0.0)) continue;
    const Triangle& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& v = mesh.vertices[static_cast<std::size_t>(t[k])];
      const Vector3d a =
          mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])] - v;
      const Vector3d b =
          mesh.vertices[static_cast<std::size_t>(t[(k + 2) % 3])] - v;
      list.push_back({t[k], std::atan2(a.cross(b).norm(), a.dot(b)), normal});
    }
  }
  return Average(std::move(list), mesh.vertices.size(), true);
}

std::vector<Vector3d> MeanNormals(const TriangleMesh& mesh,
                                  const std::vector<Vector3d>& facet_normals) {
  std::vector<Contribution> list;
  list.reserve(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double area = Area(mesh, mesh.triangles[f]);
    for (const int v : mesh.triangles[f]) {
      list.push_back({v, area, facet_normals[f]});
    }
  }
  return Average(std::move(list), mesh.vertices.size(), false);
}

std::vector<Vector3d> DiffuseNormals(const TriangleMesh& mesh,
                                     const std::vector<Vector3d>& n0,
                                     double ell) {
  const auto n = static_cast<Eigen::Index>(mesh.vertices.size());
  std::vector<double> mass(mesh.vertices.size(), 0.0);
  double total = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double third = Area(mesh, t) / 3.0;
    total += third;
    for (const int v : t) mass[static_cast<std::size_t>(v)] += third;
  }
  // Vertices with degenerate facets only still take part: 1e-12 of the mean
  // mass keeps the matrix definite and is far below what a result can show.
  const double floor_mass = 1e-12 * total / static_cast<double>(n);
  for (double& m : mass) m = std::max(m, floor_mass);

  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> diagonal = mass;
  for (const CotangentWeight& w : IntrinsicDelaunayWeights(mesh)) {
    const double conductance = ell * ell * w.weight;
    if (w.i == w.j || conductance <= 0.0) continue;
    entries.emplace_back(std::max(w.i, w.j), std::min(w.i, w.j), -conductance);
    diagonal[static_cast<std::size_t>(w.i)] += conductance;
    diagonal[static_cast<std::size_t>(w.j)] += conductance;
  }
  Eigen::MatrixXd load(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto v = static_cast<std::size_t>(i);
    entries.emplace_back(i, i, diagonal[v]);
    load.row(i) = mass[v] * n0[v].transpose();
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) {
    throw std::logic_error(
        "DiffuseNormals: M + ℓ²L was not factorised, so every triangle must "
        "be degenerate");
  }
  const Eigen::MatrixXd solution = solver.solve(load);
  std::vector<Vector3d> result(mesh.vertices.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    result[static_cast<std::size_t>(i)] = solution.row(i).transpose();
  }
  return result;
}

}  // namespace phongpd
