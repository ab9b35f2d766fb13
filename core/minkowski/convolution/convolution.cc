// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/convolution.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/minkowski/build_limits.h"
#include "core/minkowski/convolution/facet_collector.h"
#include "core/minkowski/convolution/gauss_tree.h"
#include "core/minkowski/convolution/touching_features.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Vertices of `stars` that a facet with normal n can touch.
std::vector<int> TouchedVertices(const GridNormal& n, const VertexStars& stars,
                                 const GaussTree& caps, int turn) {
  const TouchingFacet facet(n, turn);
  std::vector<int> touched;
  for (const Vector3d& side : {facet.unit(), Vector3d(-facet.unit())}) {
    caps.ForEachNear({side, 0.0}, [&](int v) {
      if (facet.Touches(stars, v)) touched.push_back(v);
    });
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

}  // namespace

Convolution ReducedConvolution(const GridSolid& p, const GridSolid& q,
                               const BuildLimits* limits) {
  const auto check = [limits] {
    if (limits != nullptr) limits->Check("convolution");
  };
  Convolution out;
  FacetCollector collect(&out);
  int source = 0;

  const auto add_facets = [&](const GridSolid& facets, const GridSolid& others,
                              ContactKind kind) {
    const VertexStars stars(others);
    const GaussTree caps(VertexCaps(others));
    const int turn = kind == ContactKind::kObstacleFacet ? 1 : -1;
    std::vector<std::vector<int>> touched(facets.facets.size());
    tbb::parallel_for(std::size_t{0}, touched.size(), [&](std::size_t f) {
      check();
      touched[f] = TouchedVertices(facets.normals[f], stars, caps, turn);
    });
    for (std::size_t f = 0; f < touched.size(); ++f) {
      check();
      for (const int v : touched[f]) {
        collect.AddFacet(facets, static_cast<int>(f), others.vertices[v], kind,
                         source++);
      }
    }
  };
  add_facets(p, q, ContactKind::kObstacleFacet);
  add_facets(q, p, ContactKind::kRobotFacet);

  const std::vector<ConvexEdge> pe = ConvexEdges(p), qe = ConvexEdges(q);
  struct Hit {
    int edge, side;
  };
  std::vector<std::vector<Hit>> hits(pe.size());
  const GaussTree arcs(ArcCaps(qe));
  const tbb::blocked_range<std::size_t> all(0, pe.size());
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      check();
      arcs.ForEachNear(ArcCap(pe[i]), [&](int j) {
        const int side = CommonSide(pe[i], qe[j]);
        if (side != 0) hits[i].push_back({j, side});
      });
      std::sort(hits[i].begin(), hits[i].end(),
                [](const Hit& a, const Hit& b) { return a.edge < b.edge; });
    }
  });
  for (std::size_t i = 0; i < pe.size(); ++i) {
    check();
    for (const Hit& hit : hits[i]) {
      collect.AddEdges(p, pe[i], q, qe[hit.edge], hit.side, source);
      ++source;
    }
  }
  return out;
}

}  // namespace phongpd::internal
