// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/phong_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/projection/edge_split.h"
#include "core/projection/normal_cone.h"
#include "core/projection/vertex_normals.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// n_i·n_j at or below which an edge counts as obtuse.  The determinant of
// T_j T_iᵀ is n_i·n_j, and its sign decides between a rotation and a
// reflection: 1e-6 leaves ten digits to rounding.
constexpr double kObtuseDot = 1e-6;
// Splitting halves the angle between the ends of an edge, so two rounds do for
// admissible vertices; the rest is for inadmissible ones.
constexpr int kObtuseRounds = 8;
// Edges at inadmissible vertices are halved this often: the field is out of
// order only within 2^-rounds of their length.
constexpr int kConfineRounds = 3;
constexpr int kLengthRounds = 64;
constexpr std::size_t kMaxTriangles = 4000000;
// Edges are split to this multiple of ℓ, see MaxEdge.
constexpr double kEdgePerEll = 1.0;

std::size_t At(int k) { return static_cast<std::size_t>(k); }

[[noreturn]] void Refuse(const std::string& what) {
  throw InputError("Phong field: " + what);
}

void CheckRange(const char* name, double value, bool ok, const char* range) {
  if (ok) return;
  std::ostringstream out;
  out << "option " << name << " must be in " << range << ", found " << value;
  Refuse(out.str());
}

void CheckMesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) Refuse("the contact mesh has no triangle");
  std::size_t bad = 0;
  const int n = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) bad += v < 0 || v >= n ? 1 : 0;
  }
  if (bad > 0) {
    Refuse("expected vertex indices below " + std::to_string(n) + ", found " +
           std::to_string(bad) + " others");
  }
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) bad += mesh.vertices[At(v)].allFinite() ? 0 : 1;
  }
  if (bad > 0) {
    Refuse("expected finite vertices, found " + std::to_string(bad) +
           " triangle corners that are not");
  }
  MakeEdgeTable(mesh.triangles, &bad);
  if (bad > 0) {
    Refuse("expected a closed, consistently oriented surface, found " +
           std::to_string(bad) +
           " edges that do not have one triangle on each side");
  }
}

// Builds the field step by step; all coordinates in the field frame.
class FieldBuilder {
 public:
  FieldBuilder(const TriangleMesh& contact_mesh,
               const PhongFieldOptions& options)
      : options_(options) {
    EnterFrame(contact_mesh);
    facets_ = FacetNormals(field_.mesh);
    source_.resize(field_.mesh.triangles.size());
    std::iota(source_.begin(), source_.end(), 0);
    AverageFacets();
    ConfineInadmissible();
    SplitLongEdges();
    field_.normals = base_;
    if (options_.smoothing_length > 0.0) Smooth();
    SplitObtuseEdges();
  }

  PhongField Take() {
    PhongFieldReport& report = field_.report;
    report.limited_vertices = static_cast<std::size_t>(
        std::count(limited_.begin(), limited_.end(), 1));
    report.inadmissible_vertices = static_cast<std::size_t>(
        std::count(inadmissible_.begin(), inadmissible_.end(), 1));
    for (std::size_t t = 0; t < source_.size(); ++t) {
      const Vector3d& facet = facets_[At(source_[t])];
      if (facet.isZero(0.0)) continue;
      for (const int v : field_.mesh.triangles[t]) {
        report.min_normal_dot =
            std::min(report.min_normal_dot, field_.normals[At(v)].dot(facet));
      }
    }
    field_.source_triangle.reserve(source_.size());
    for (const int s : source_) {
      field_.source_triangle.push_back(contact_triangle_[At(s)]);
    }
    field_.neighbors = TriangleNeighbors(field_.mesh);
    return std::move(field_);
  }

 private:
  // Moves the mesh into the field frame and into canonical order: vertices by
  // coordinates, triangles by their vertices, smallest vertex first.
  void EnterFrame(const TriangleMesh& mesh) {
    const BoundingBox box = ComputeBounds(mesh);
    const double diagonal = box.Diagonal();
    int exponent = 0;
    std::frexp(diagonal, &exponent);
    field_.center = box.Center();
    field_.scale = std::ldexp(1.0, 1 - exponent);
    if (!std::isnormal(diagonal) || !std::isnormal(field_.scale)) {
      Refuse("expected a bounding box of finite, positive diagonal");
    }
    diagonal_ = diagonal * field_.scale;

    std::vector<Vector3d> points(mesh.vertices.size());
    std::vector<char> used(mesh.vertices.size(), 0);
    for (const Triangle& t : mesh.triangles) {
      for (const int v : t) used[At(v)] = 1;
    }
    std::vector<int> order;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (!used[v]) continue;
      points[v] = field_.ToField(mesh.vertices[v]);
      order.push_back(static_cast<int>(v));
    }
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const Vector3d& p = points[At(a)];
      const Vector3d& q = points[At(b)];
      for (int k = 0; k < 3; ++k) {
        if (p[k] != q[k]) return p[k] < q[k];
      }
      return a < b;
    });
    std::vector<int> rank(points.size(), -1);
    for (const int v : order) {
      rank[At(v)] = static_cast<int>(field_.mesh.vertices.size());
      field_.mesh.vertices.push_back(points[At(v)]);
    }
    std::vector<std::pair<Triangle, int>> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Triangle tri = mesh.triangles[t];
      for (int& v : tri) v = rank[At(v)];
      std::rotate(tri.begin(), std::min_element(tri.begin(), tri.end()),
                  tri.end());
      triangles.emplace_back(tri, static_cast<int>(t));
    }
    std::sort(triangles.begin(), triangles.end());
    for (const auto& [triangle, original] : triangles) {
      field_.mesh.triangles.push_back(triangle);
      contact_triangle_.push_back(original);
    }
  }

  // Normals of the facets around each vertex, without repetition of sources.
  std::vector<std::vector<Vector3d>> FacetFans() const {
    std::vector<std::vector<int>> sources(field_.mesh.vertices.size());
    for (std::size_t t = 0; t < source_.size(); ++t) {
      for (const int v : field_.mesh.triangles[t]) {
        std::vector<int>& list = sources[At(v)];
        if (list.empty() || list.back() != source_[t]) {
          list.push_back(source_[t]);
        }
      }
    }
    std::vector<std::vector<Vector3d>> fans(sources.size());
    for (std::size_t v = 0; v < fans.size(); ++v) {
      for (const int s : sources[v]) fans[v].push_back(facets_[At(s)]);
    }
    return fans;
  }

  // base_ = n₀, or the least correction of it that is admissible.
  void AverageFacets() {
    base_ = VertexNormals(field_.mesh, facets_, options_.weight);
    limited_.assign(base_.size(), 0);
    inadmissible_.assign(base_.size(), 0);
    const auto fans = FacetFans();
    for (std::size_t v = 0; v < base_.size(); ++v) {
      Vector3d& n = base_[v];
      const bool vanishing = n.isZero(0.0);
      if (!vanishing && MinFacetDot(n, fans[v]) >= options_.limiter) continue;
      const Vector3d best = BestNormal(fans[v]);
      if (best.isZero(0.0)) {
        inadmissible_[v] = 1;
        if (vanishing) n = AnyNormal(fans[v]);
      } else {
        limited_[v] = 1;
        n = vanishing ? best : LimitNormal(n, best, fans[v], options_.limiter);
      }
    }
  }

  // The least bad of the facet normals themselves; z if there is none.
  static Vector3d AnyNormal(const std::vector<Vector3d>& fan) {
    Vector3d result = Vector3d::UnitZ();
    double best = -std::numeric_limits<double>::infinity();
    for (const Vector3d& facet : fan) {
      if (facet.isZero(0.0) || MinFacetDot(facet, fan) <= best) continue;
      best = MinFacetDot(facet, fan);
      result = facet;
    }
    return result;
  }

  EdgeTable Edges() const {
    std::size_t bad = 0;  // checked at the door, and splitting keeps it so
    return MakeEdgeTable(field_.mesh.triangles, &bad);
  }

  double SquaredLength(const std::array<int, 2>& edge) const {
    return (field_.mesh.vertices[At(edge[0])] -
            field_.mesh.vertices[At(edge[1])])
        .squaredNorm();
  }

  static Vector3d Mean(const Vector3d& a, const Vector3d& b) {
    const Vector3d sum = a + b;
    // Opposite unit vectors have no mean: 1e-6 as for kObtuseDot.
    if (sum.norm() <= kObtuseDot) return Vector3d::Zero();
    return sum.normalized();
  }

  // Mean of the two facets at an edge, zero for a knife edge.
  Vector3d EdgeNormal(const EdgeTable& edges, std::size_t e) const {
    const auto& [t, u] = edges.triangles[e];
    return Mean(facets_[At(source_[At(t)])], facets_[At(source_[At(u)])]);
  }

  // Splits the marked edges; base_ (and normals, if they exist) get the
  // mid-points' normals.
  void Split(const EdgeTable& edges, const std::vector<char>& marked,
             const std::vector<Vector3d>& middle_normals,
             std::vector<Vector3d>* normals) {
    for (std::size_t e = 0; e < marked.size(); ++e) {
      if (!marked[e]) continue;
      normals->push_back(middle_normals[e]);
      limited_.push_back(0);
      inadmissible_.push_back(middle_normals[e].isZero(0.0) ? 1 : 0);
      if (inadmissible_.back()) {
        normals->back() = facets_[At(source_[At(edges.triangles[e][0])])];
      }
      ++field_.report.split_edges;
    }
    SplitEdges(edges, marked, &field_.mesh, &source_);
    if (source_.size() > kMaxTriangles) {
      std::ostringstream out;
      out << "splitting needs more than " << kMaxTriangles
          << " triangles; smoothing_length " << options_.smoothing_length
          << " and max_edge " << options_.max_edge << " ask for edges below "
          << MaxEdge() / diagonal_
          << " of the diagonal; use larger values or 0";
      Refuse(out.str());
    }
  }

  void ConfineInadmissible() {
    const std::vector<char> centres = inadmissible_;
    if (std::count(centres.begin(), centres.end(), 1) == 0) return;
    for (int round = 0; round < kConfineRounds; ++round) {
      const EdgeTable edges = Edges();
      std::vector<char> marked(edges.vertices.size(), 0);
      std::vector<Vector3d> middle(edges.vertices.size());
      for (std::size_t e = 0; e < marked.size(); ++e) {
        const auto& [i, j] = edges.vertices[e];
        const auto is_centre = [&](int v) {
          return At(v) < centres.size() && centres[At(v)];
        };
        marked[e] = is_centre(i) || is_centre(j) ? 1 : 0;
        if (marked[e]) middle[e] = EdgeNormal(edges, e);
      }
      Split(edges, marked, middle, &base_);
    }
  }

  double MaxEdge() const {
    if (options_.max_edge > 0.0) return options_.max_edge * diagonal_;
    return kEdgePerEll * options_.smoothing_length * diagonal_;
  }

  void SplitLongEdges() {
    const double longest = MaxEdge();
    if (longest <= 0.0) return;
    for (int round = 0; round < kLengthRounds; ++round) {
      const EdgeTable edges = Edges();
      std::vector<char> marked(edges.vertices.size(), 0);
      std::vector<Vector3d> middle(edges.vertices.size());
      bool any = false;
      for (std::size_t e = 0; e < marked.size(); ++e) {
        if (SquaredLength(edges.vertices[e]) <= longest * longest) continue;
        marked[e] = 1;
        any = true;
        middle[e] = EdgeNormal(edges, e);
      }
      if (!any) return;
      Split(edges, marked, middle, &base_);
    }
  }

  void Smooth() {
    std::vector<Vector3d> part_facets;
    part_facets.reserve(source_.size());
    for (const int s : source_) part_facets.push_back(facets_[At(s)]);
    const std::vector<Vector3d> smooth =
        DiffuseNormals(field_.mesh, MeanNormals(field_.mesh, part_facets),
                       options_.smoothing_length * diagonal_);
    const auto fans = FacetFans();
    for (std::size_t v = 0; v < base_.size(); ++v) {
      const double length = smooth[v].norm();
      if (length <= std::numeric_limits<double>::min()) continue;
      const Vector3d n = smooth[v] / length;
      field_.normals[v] = n;
      if (inadmissible_[v]) continue;
      // Where even the best direction stays below c, that one is all there is.
      const double c =
          std::min(options_.limiter, MinFacetDot(base_[v], fans[v]));
      field_.normals[v] = LimitNormal(n, base_[v], fans[v], c);
      if (field_.normals[v] != n) limited_[v] = 1;
    }
  }

  // Of the two candidates for the normal at an obtuse edge's mid-point the one
  // that leaves the wider margin on both halves, but `first` if it is enough.
  static Vector3d MiddleNormal(const Vector3d& n_i, const Vector3d& n_j,
                               const Vector3d& first, const Vector3d& second) {
    const auto margin = [&](const Vector3d& m) {
      return m.isZero(0.0) ? -2.0 : std::min(m.dot(n_i), m.dot(n_j));
    };
    if (margin(first) > kObtuseDot) return first;
    return margin(first) >= margin(second) ? first : second;
  }

  void SplitObtuseEdges() {
    for (int round = 0;; ++round) {
      const EdgeTable edges = Edges();
      std::vector<char> marked(edges.vertices.size(), 0);
      std::vector<Vector3d> middle(edges.vertices.size());
      std::size_t obtuse = 0;
      for (std::size_t e = 0; e < marked.size(); ++e) {
        const Vector3d& n_i = field_.normals[At(edges.vertices[e][0])];
        const Vector3d& n_j = field_.normals[At(edges.vertices[e][1])];
        if (n_i.dot(n_j) > kObtuseDot) continue;
        marked[e] = 1;
        ++obtuse;
        const Vector3d facets = EdgeNormal(edges, e);
        const Vector3d mean = Mean(n_i, n_j);
        middle[e] = options_.smoothing_length > 0.0
                        ? MiddleNormal(n_i, n_j, mean, facets)
                        : MiddleNormal(n_i, n_j, facets, mean);
      }
      field_.report.obtuse_edges = obtuse;
      if (obtuse == 0 || round == kObtuseRounds) return;
      Split(edges, marked, middle, &field_.normals);
    }
  }

  PhongFieldOptions options_;
  PhongField field_;
  double diagonal_ = 0.0;              // field frame, in [1, 2)
  std::vector<int> contact_triangle_;  // of each source triangle
  std::vector<Vector3d> facets_;       // N_f, per source triangle
  std::vector<int> source_;            // per triangle of field_.mesh
  std::vector<Vector3d> base_;         // n₀ made admissible, per vertex
  std::vector<char> limited_;          // per vertex
  std::vector<char> inadmissible_;     // per vertex
};

}  // namespace

void PhongFieldOptions::Validate() const {
  // Written so that NaN fails.
  CheckRange("smoothing_length", smoothing_length,
             smoothing_length >= 0.0 && smoothing_length <= 1.0, "[0, 1]");
  CheckRange("limiter", limiter, limiter > 0.0 && limiter < 1.0, "(0, 1)");
  CheckRange("max_edge", max_edge, max_edge >= 0.0 && max_edge <= 1.0,
             "[0, 1]");
}

PhongField BuildPhongField(const TriangleMesh& contact_mesh,
                           const PhongFieldOptions& options) {
  options.Validate();
  CheckMesh(contact_mesh);
  return FieldBuilder(contact_mesh, options).Take();
}

}  // namespace phongpd
