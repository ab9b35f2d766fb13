// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/prism_search.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/numbers.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

using internal::kInfinity;
constexpr double kTie = 1e-13;         // of depths, field frame
constexpr double kSameContact = 1e-9;  // of contacts, field frame

// Does `a` come before `b`?  Contacts closer than kSameContact are one.
bool ComesFirst(const FieldProjector& projector, const Projection& a,
                const Projection& b) {
  if (a.depth < b.depth - kTie) return true;
  if (a.depth > b.depth + kTie) return false;
  const Vector3d p = projector.Point(a), q = projector.Point(b);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(p[i] - q[i]) > kSameContact) return p[i] < q[i];
  }
  if (a.depth != b.depth) return a.depth < b.depth;
  for (int i = 0; i < 3; ++i) {
    if (p[i] != q[i]) return p[i] < q[i];
  }
  return false;
}

}  // namespace

Projection PrismSearch::FindLeastDepth(const FieldProjector& projector,
                                       const Vector3d& x) const noexcept {
  Projection best;
  best.depth = kInfinity;
  tree_.NearestFirst(
      x, kInfinity, [&](int triangle, const PrismTree::Offsets& offsets) {
        std::array<Projection, 3> found;
        const int count =
            projector.Project(triangle, x, best.depth + kSlack, offsets.least,
                              offsets.most, &found);
        for (int i = 0; i < count; ++i) {
          if (ComesFirst(projector, found[i], best)) best = found[i];
        }
        return best.depth + kSlack;
      });
  return best;
}

}  // namespace phongpd
