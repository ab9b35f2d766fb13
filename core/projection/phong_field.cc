// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/phong_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/numbers.h"
#include "core/projection/canonical_mesh.h"
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
// Edges are split to this multiple of ℓ (measured: see the header).
constexpr double kEdgePerEll = 0.5;

using internal::At;

[[noreturn]] void Refuse(const std::string& what) {
  throw InputError("Phong field: " + what);
}

void CheckRange(const char* name, double value, bool ok, const char* range) {
  if (ok) return;
  std::ostringstream out;
  out << "option " << name << " must be in " << range << ", found " << value;
  Refuse(out.str());
}

// Builds the field step by step; all coordinates in the field frame.
class FieldBuilder {
 public:
  FieldBuilder(const ContactSpace& space, const PhongFieldOptions& options)
      : options_(options) {
    CanonicalMesh canonical = MakeCanonical(space.mesh());
    field_.center = canonical.center;
    field_.scale = canonical.scale;
    length_ = space.length() * field_.scale;
    contact_triangle_ = std::move(canonical.source);
    field_.mesh = std::move(canonical.mesh);
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
    base_ = VertexNormals(field_.mesh, facets_);
    limited_.assign(base_.size(), 0);
    inadmissible_.assign(base_.size(), 0);
    const auto fans = FacetFans();
    for (std::size_t v = 0; v < base_.size(); ++v) {
      Vector3d& n = base_[v];
      if (!n.isZero(0.0) && MinFacetDot(n, fans[v]) >= kNormalLimiter) {
        continue;
      }
      const Vector3d best = BestNormal(fans[v]);
      if (best.isZero(0.0)) {
        inadmissible_[v] = 1;
      } else {
        limited_[v] = 1;
        n = n.isZero(0.0) ? best
                          : LimitNormal(n, best, fans[v], kNormalLimiter);
      }
    }
    FillMissing();
  }

  // Vertices without any direction of their own (degenerate facets only, or
  // facets that cancel) take the mean of their neighbours', ring by ring.
  void FillMissing() {
    std::vector<Vector3d> sum(base_.size());
    for (bool found = true; found;) {
      std::fill(sum.begin(), sum.end(), Vector3d::Zero());
      for (const Triangle& t : field_.mesh.triangles) {
        for (const int v : t) {
          if (!base_[At(v)].isZero(0.0)) continue;
          for (const int w : t) sum[At(v)] += base_[At(w)];
        }
      }
      found = false;
      for (std::size_t v = 0; v < sum.size(); ++v) {
        if (sum[v].norm() <= kObtuseDot) continue;
        base_[v] = sum[v].normalized();
        found = true;
      }
    }
    for (Vector3d& n : base_) {
      if (n.isZero(0.0)) n = Vector3d::UnitZ();
    }
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
      const bool knife = middle_normals[e].isZero(0.0);
      const auto& [i, j] = edges.vertices[e];
      normals->push_back(knife ? Vector3d((*normals)[At(i)])
                               : middle_normals[e]);
      limited_.push_back(0);
      inadmissible_.push_back(knife ? 1 : 0);
      ++field_.report.split_edges;
    }
    SplitEdges(edges, marked, &field_.mesh, &source_);
    CheckSize(static_cast<double>(source_.size()));
  }

  void CheckSize(double triangles) const {
    if (triangles <= static_cast<double>(kMaxTriangles)) return;
    std::ostringstream out;
    if (options_.max_edge > 0.0) {
      out << "splitting into edges below max_edge, " << options_.max_edge
          << " of D, needs more than " << kMaxTriangles
          << " triangles; set a larger max_edge";
    } else {
      out << "smoothing_length: expected at least " << FeasibleLength()
          << "D or 0 on this surface, found " << options_.smoothing_length
          << "D, which splits it into more than " << kMaxTriangles
          << " triangles; or take the metric smoothed";
    }
    Refuse(out.str());
  }

  // The least round ℓ, a share of D, above the one asked for with which
  // splitting is not refused.
  double FeasibleLength() const {
    double decade =
        std::pow(10.0, std::floor(std::log10(options_.smoothing_length)));
    for (; decade < 1.0; decade *= 10.0) {
      for (const double digit : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        const double ell = digit * decade;
        if (ell <= options_.smoothing_length) continue;
        // Splitting of obtuse edges adds some.
        if (SplitCount(kEdgePerEll * ell * length_) <
            0.9 * static_cast<double>(kMaxTriangles)) {
          return ell;
        }
      }
    }
    return 1.0;
  }

  // How many triangles SplitLongEdges makes; more than kMaxTriangles where it
  // stops counting.
  double SplitCount(double longest) const {
    double count = 0.0;
    for (const Triangle& t : field_.mesh.triangles) {
      std::array<Vector3d, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = field_.mesh.vertices[At(t[k])];
      }
      CountSplits(corners, longest * longest, &count);
      if (count > static_cast<double>(kMaxTriangles)) break;
    }
    return count;
  }

  // One triangle as rounds of SplitEdges cut it: each marks all edges that are
  // too long and bisects the longest of a triangle first.
  static void CountSplits(const std::array<Vector3d, 3>& t, double most,
                          double* count) {
    std::array<bool, 3> marked;
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      marked[k] = (t[(k + 1) % 3] - t[k]).squaredNorm() > most;
      any = any || marked[k];
    }
    if (!any) {
      *count += 1.0;
      return;
    }
    CountParts(t, marked, most, count);
  }

  static void CountParts(const std::array<Vector3d, 3>& t,
                         const std::array<bool, 3>& marked, double most,
                         double* count) {
    if (*count > static_cast<double>(kMaxTriangles)) return;
    std::size_t longest = 3;
    double length = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double own = (t[(k + 1) % 3] - t[k]).squaredNorm();
      if (!marked[k] || own <= length) continue;
      longest = k;
      length = own;
    }
    if (longest == 3) return CountSplits(t, most, count);
    const std::size_t k1 = (longest + 1) % 3, k2 = (longest + 2) % 3;
    const Vector3d middle = 0.5 * (t[longest] + t[k1]);
    CountParts({t[longest], middle, t[k2]}, {false, false, marked[k2]}, most,
               count);
    CountParts({middle, t[k1], t[k2]}, {false, marked[k1], false}, most, count);
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
    if (options_.max_edge > 0.0) return options_.max_edge * length_;
    return kEdgePerEll * options_.smoothing_length * length_;
  }

  void SplitLongEdges() {
    const double longest = MaxEdge();
    if (longest <= 0.0) return;
    // Before trying: memory for millions is taken in vain otherwise.
    CheckSize(SplitCount(longest));
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
                       options_.smoothing_length * length_);
    const auto fans = FacetFans();
    for (std::size_t v = 0; v < base_.size(); ++v) {
      const double length = smooth[v].norm();
      if (length <= std::numeric_limits<double>::min()) continue;
      const Vector3d n = smooth[v] / length;
      field_.normals[v] = n;
      if (inadmissible_[v]) continue;
      // Where even the best direction stays below c, that one is all there is.
      const double c = std::min(kNormalLimiter, MinFacetDot(base_[v], fans[v]));
      field_.normals[v] = LimitNormal(n, base_[v], fans[v], c);
      limited_[v] = field_.normals[v] != n ? 1 : 0;
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
  double length_ = 0.0;                // D, field frame
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
  CheckRange("max_edge", max_edge, max_edge >= 0.0 && max_edge <= 1.0,
             "[0, 1]");
}

PhongField BuildPhongField(const ContactSpace& space,
                           const PhongFieldOptions& options) {
  options.Validate();
  return FieldBuilder(space, options).Take();
}

}  // namespace phongpd
