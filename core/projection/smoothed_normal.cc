// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/smoothed_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/pi.h"
#include "core/projection/normal_moments.h"

namespace phongpd {

using Eigen::Vector3d;
using internal::NormalMoments;

namespace {

constexpr double kUlpOfOne = std::numeric_limits<double>::epsilon();
// What one term of a sum rounds to, in shares of itself: the few operations it
// takes.
constexpr double kTermRounding = 8.0 * kUlpOfOne;
// Of the diagonal: less is not much more than what coordinates round to.
constexpr double kLeastRadius = 1e-9;
// Triangles from which a subtree keeps its moments: about as many as take the
// time of one evaluation, memory considered.
constexpr int kLeastSummed = 8;

// A sum of angles, each in (−π, π), as a product of complex numbers and how
// often that went around: one arc tangent for all.
class AngleSum {
 public:
  // Adds that of re + i·im.
  void Add(double re, double im) {
    const double new_re = re_ * re - im_ * im, new_im = re_ * im + im_ * re;
    const bool is_up = im_ > 0.0 || (im_ == 0.0 && re_ < 0.0);
    if (im > 0.0 && is_up && new_im < 0.0) ++turns_;
    if (im < 0.0 && im_ < 0.0 && new_im >= 0.0) --turns_;
    re_ = new_re;
    im_ = new_im;
  }
  double Value() const { return std::atan2(im_, re_) + 2.0 * kPi * turns_; }

 private:
  double re_ = 1.0, im_ = 0.0;
  int turns_ = 0;
};

// What the edges of a triangle give, in lengths of ρ, times 6.
struct EdgeSum {
  double inside = 0.0;
  double rounding = 0.0;  // of it, before any factor
  AngleSum outside;
  double outside_bound = 0.0;  // its parts, times R², at most
  bool meets_disc = false;
  bool is_around = true;  // the foot is left of all edges
};

// Of a vector, at least its length and at most √3 of it.
double LengthBound(const Vector3d& v) { return v.cwiseAbs().sum(); }

// The edge from p to q, relative to x, of a triangle with the unit normal n;
// rr = R².  Lengths along the edge, and the distance d of its line, come times
// its length L: no root but the chord's.
void AddEdge(const Vector3d& p, const Vector3d& q, const Vector3d& n, double rr,
             EdgeSum* sum) {
  const Vector3d edge = q - p;
  const double ll = edge.squaredNorm();
  if (!(ll > 0.0)) return;
  const double y_p = p.dot(edge), y_q = q.dot(edge);
  // From the nearer end, which rounds less.
  const Vector3d& near = std::abs(y_p) < std::abs(y_q) ? p : q;
  const double d = n.dot(near.cross(edge));
  if (!(d > 0.0)) sum->is_around = false;
  const double dd = d * d, chord = rr * ll - dd;
  const double half_chord = chord > 0.0 ? std::sqrt(chord) : 0.0;
  const double from = std::max(y_p, -half_chord);
  const double to = std::min(y_q, half_chord);
  // As the foot sees the part from a to b of the line, away from it.
  const auto add_angle = [&](double a, double b) {
    sum->outside.Add(dd + a * b, d * (b - a));
    sum->outside_bound += std::abs(d) * (b - a) / ll;
  };
  if (!(from < to)) {
    add_angle(y_p, y_q);
    return;
  }
  sum->meets_disc = true;
  if (y_p < from) add_angle(y_p, from);
  if (to < y_q) add_angle(to, y_q);
  // d ∫ 3R⁴ − 3R²(d² + y²) + (d² + y²)² dy around the middle.
  const double per_ll = 1.0 / ll;
  const double m = 0.5 * (from + to), k = 0.5 * (to - from);
  const double mm = m * m * per_ll, kk = k * k * per_ll, d2 = dd * per_ll;
  const double y2 = mm + kk / 3.0;
  const double y4 = mm * mm + 2.0 * mm * kk + kk * kk / 5.0;
  const double inside =
      2.0 * k * per_ll *
      (3.0 * rr * (rr - d2) + d2 * d2 + (2.0 * d2 - 3.0 * rr) * y2 + y4);
  sum->inside += d * inside;
  sum->rounding += inside * 2.0 * LengthBound(near) * LengthBound(edge);
}

// Adds ∫ w n dA/ρ² of a triangle, corners relative to x in lengths of ρ.
void AddTriangle(const TriangleCorners& c, const Vector3d& n,
                 SmoothedNormal* sum) {
  const double far_0 = c[0].squaredNorm(), far_1 = c[1].squaredNorm(),
               far_2 = c[2].squaredNorm();
  const Vector3d& near = far_0 < far_1 ? (far_0 < far_2 ? c[0] : c[2])
                                       : (far_1 < far_2 ? c[1] : c[2]);
  const double h = n.dot(near);
  const double rr = 1.0 - h * h;
  if (!(rr > 0.0)) return;
  EdgeSum edges;
  AddEdge(c[0], c[1], n, rr, &edges);
  AddEdge(c[1], c[2], n, rr, &edges);
  AddEdge(c[2], c[0], n, rr, &edges);
  const double disc = rr * rr * rr;
  double value = 2.0 * kPi * disc, rounding = value;
  if (edges.meets_disc) {
    value = edges.inside + disc * edges.outside.Value();
    rounding = edges.rounding +
               std::min(rr * rr * edges.outside_bound, 4.0 * kPi * disc);
  } else if (!edges.is_around) {
    return;  // nothing of the disc
  }
  sum->integral += (value / 6.0) * n;
  // h rounds with the corner it is from, and R² with h.
  sum->rounding +=
      kTermRounding * rounding * (1.0 + LengthBound(near) / rr) / 6.0;
}

// What an edge gives of ∫ (R² − s²) dA and ∫ (R² − s²) s dA, lengths of ρ.
void AddEdgeOffsets(const Vector3d& p, const Vector3d& q, const Vector3d& n,
                    double rr, double* height, AngleSum* outside,
                    Vector3d* along) {
  const double length = (q - p).norm();
  if (!(length > 0.0)) return;
  const Vector3d edge = (q - p) / length;
  const double y_p = p.dot(edge), y_q = q.dot(edge);
  const Vector3d& near = std::abs(y_p) < std::abs(y_q) ? p : q;
  const double d = n.dot(near.cross(edge));
  const double chord = rr - d * d;
  const double half_chord = chord > 0.0 ? std::sqrt(chord) : 0.0;
  const double from = std::max(y_p, -half_chord);
  const double to = std::min(y_q, half_chord);
  const auto add_angle = [&](double a, double b) {
    outside->Add(d * d + a * b, d * (b - a));
  };
  if (!(from < to)) {
    add_angle(y_p, y_q);
    return;
  }
  if (y_p < from) add_angle(y_p, from);
  if (to < y_q) add_angle(to, y_q);
  const double m = 0.5 * (from + to), k = 0.5 * (to - from);
  const double y2 = m * m + k * k / 3.0;
  const double y4 = m * m * m * m + 2.0 * m * m * k * k + k * k * k * k / 5.0;
  // ¼ d ∫ 2R² − d² − y² dy, and ∫ (R² − d² − y²)² dy.
  *height += 0.5 * d * k * (2.0 * rr - d * d - y2);
  *along -= 0.5 * k * (chord * chord - 2.0 * chord * y2 + y4) * edge.cross(n);
}

// Adds ∫ (1 − r²) n (p − x)ᵀ dA of a triangle, corners relative to x, lengths
// of ρ.
void AddOffsets(const TriangleCorners& c, const Vector3d& n,
                Eigen::Matrix3d* sum) {
  const double h = n.dot(c[0]);
  const double rr = 1.0 - h * h;
  if (!(rr > 0.0)) return;
  double height = 0.0;
  AngleSum outside;
  Vector3d along = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    AddEdgeOffsets(c[k], c[(k + 1) % 3], n, rr, &height, &outside, &along);
  }
  height += 0.25 * rr * rr * outside.Value();
  *sum += n * (h * height * n + along).transpose();
}

}  // namespace

struct SmoothedNormals::Impl {
  Impl(std::shared_ptr<const TriangleBvh> the_bvh,
       std::vector<Vector3d> the_normals, double the_radius)
      : bvh(std::move(the_bvh)),
        normals(std::move(the_normals)),
        radius(the_radius),
        k(1.0 / (radius * bvh->scale())),
        moments_of(bvh->tree().nodes().size(), -1) {
    Sum(0);
  }

  // In the frame's lengths, however far off the origin.
  Vector3d Between(const Vector3d& from, const Vector3d& to) const {
    return (to - from) * bvh->scale();
  }
  Vector3d Center(const BoxTree::Node& node) const {
    return 0.5 * node.min + 0.5 * node.max;
  }

  struct Part {
    NormalMoments moments;  // around the box's centre
    int count = 0;          // of triangles
  };

  // Of a subtree; keeps it, and those below it, where they are large enough.
  Part Sum(int index) {
    const BoxTree::Node& node =
        bvh->tree().nodes()[static_cast<std::size_t>(index)];
    const Vector3d center = Center(node);
    Part part;
    if (node.IsLeaf()) {
      for (int i = node.first; i < node.first + node.count; ++i) {
        const TriangleCorners& c = bvh->corners()[static_cast<std::size_t>(i)];
        part.moments +=
            NormalMoments({Between(center, c[0]), Between(center, c[1]),
                           Between(center, c[2])},
                          NormalAt(i));
      }
      part.count = node.count;
    } else {
      for (const int child : {node.first, node.first + 1}) {
        const Part below = Sum(child);
        const Vector3d from =
            Center(bvh->tree().nodes()[static_cast<std::size_t>(child)]);
        part.moments += below.moments.Shifted(Between(center, from));
        part.count += below.count;
      }
    }
    if (part.count >= kLeastSummed) {
      moments_of[static_cast<std::size_t>(index)] =
          static_cast<int>(moments.size());
      moments.push_back(part.moments);
    }
    return part;
  }

  // Of the triangle at a position in the tree's order.
  const Vector3d& NormalAt(int position) const {
    return normals[static_cast<std::size_t>(
        bvh->tree().order()[static_cast<std::size_t>(position)])];
  }

  // Moments of a subtree that is within ρ; null where that is not known or its
  // triangles are quicker.
  const NormalMoments* WholeWithin(const Vector3d& x, int index) const {
    const int kept = moments_of[static_cast<std::size_t>(index)];
    if (kept < 0) return nullptr;
    const BoxTree::Node& node =
        bvh->tree().nodes()[static_cast<std::size_t>(index)];
    const Vector3d reach = (Between(x, node.min).cwiseAbs())
                               .cwiseMax(Between(x, node.max).cwiseAbs());
    return (k * reach).squaredNorm() <= 1.0
               ? &moments[static_cast<std::size_t>(kept)]
               : nullptr;
  }
  Vector3d Center(int index) const {
    return Center(bvh->tree().nodes()[static_cast<std::size_t>(index)]);
  }

  // Adds all of a subtree that is within ρ; false where it is not.
  bool AddWhole(const Vector3d& x, int index, SmoothedNormal* sum) const {
    const NormalMoments* const m = WholeWithin(x, index);
    if (m == nullptr) return false;
    const double kk = k * k;
    sum->integral += kk * m->Weighted(Between(x, Center(index)), k);
    sum->rounding += kTermRounding * kk * m->area();
    return true;
  }

  // Calls whole(node) of subtrees that meet the ball, until that is true, and
  // else triangle(corners, normal) with corners relative to x in lengths of ρ.
  // Nothing where x is not finite.
  template <typename Whole, typename OfTriangle>
  void ForEachWithin(const Vector3d& x, const Whole& whole,
                     const OfTriangle& triangle) const {
    if (!IsFinite(x - bvh->center())) return;
    const BoxTree& tree = bvh->tree();
    tree.ForEach(
        [&](int index) {
          const BoxTree::Node& node =
              tree.nodes()[static_cast<std::size_t>(index)];
          const Vector3d gap =
              k *
              Between(x, node.min).cwiseMax(Between(node.max, x)).cwiseMax(0.0);
          return gap.squaredNorm() < 1.0 && !whole(index);
        },
        [&](int position) {
          const Vector3d& n = NormalAt(position);
          if (n.isZero(0.0)) return true;
          const TriangleCorners& c =
              bvh->corners()[static_cast<std::size_t>(position)];
          triangle(TriangleCorners{k * Between(x, c[0]), k * Between(x, c[1]),
                                   k * Between(x, c[2])},
                   n);
          return true;
        });
  }

  std::shared_ptr<const TriangleBvh> bvh;
  std::vector<Vector3d> normals;  // of triangles; zero: counts for nothing
  double radius;
  double k;                     // 1/ρ in the frame of the tree
  std::vector<int> moments_of;  // by node; −1: not kept
  std::vector<NormalMoments> moments;
};

SmoothedNormals::SmoothedNormals(const ContactSpace& space, double radius) {
  const double least = kLeastRadius * space.bounds().Diagonal();
  if (!(radius >= least) || !std::isfinite(radius)) {
    throw InputError("smoothed normals: expected a finite radius ≥ " +
                     FormatDouble(least) + " (1e-9 of the diagonal), found " +
                     FormatDouble(radius));
  }
  // The space keeps its tree, and a copy of it is kept with that.
  const auto kept = std::make_shared<const ContactSpace>(space);
  std::vector<Vector3d> normals = kept->normals();
  // Walls of a part of C_cont are none of it.
  const std::vector<ContactKind>& kind = kept->kind();
  for (std::size_t t = 0; t < kind.size(); ++t) {
    if (kind[t] == ContactKind::kNone) normals[t].setZero();
  }
  impl_ = std::make_unique<Impl>(
      std::shared_ptr<const TriangleBvh>(kept, &kept->bvh()),
      std::move(normals), radius);
}
SmoothedNormals::SmoothedNormals(std::shared_ptr<const TriangleBvh> part,
                                 std::vector<Vector3d> normals, double radius)
    : impl_(std::make_unique<Impl>(std::move(part), std::move(normals),
                                   radius)) {}
SmoothedNormals::~SmoothedNormals() = default;
SmoothedNormals::SmoothedNormals(SmoothedNormals&&) noexcept = default;
SmoothedNormals& SmoothedNormals::operator=(SmoothedNormals&&) noexcept =
    default;

SmoothedNormal SmoothedNormals::At(const Vector3d& x) const noexcept {
  const Impl& impl = *impl_;
  SmoothedNormal sum;
  impl.ForEachWithin(
      x, [&](int node) { return impl.AddWhole(x, node, &sum); },
      [&](const TriangleCorners& c, const Vector3d& n) {
        AddTriangle(c, n, &sum);
      });
  return sum;
}

Eigen::Matrix3d SmoothedNormals::DerivativeAt(
    const Vector3d& x) const noexcept {
  const Impl& impl = *impl_;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();  // lengths of ρ
  impl.ForEachWithin(
      x,
      [&](int node) {
        const NormalMoments* const moments = impl.WholeWithin(x, node);
        if (moments == nullptr) return false;
        sum += impl.k * impl.k * impl.k *
               moments->WeightedOffsets(impl.Between(x, impl.Center(node)),
                                        impl.k);
        return true;
      },
      [&](const TriangleCorners& c, const Vector3d& n) {
        AddOffsets(c, n, &sum);
      });
  return 4.0 / impl.radius * sum;
}

}  // namespace phongpd
