// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/facet_intersections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "core/minkowski/arrangement/facet_intersector.h"

namespace phongpd::internal {
namespace {

// Facets handled between two passes that add points: bounds the memory held
// by intersections that wait for their points.
constexpr int kBlock = 8192;

std::vector<BoundingBox> FacetBoxes(const Convolution& convolution) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(convolution.facets.size());
  for (const ConvolutionFacet& facet : convolution.facets) {
    BoundingBox box;
    box.min = box.max = ToDouble(convolution.points[facet.corners[0]]);
    for (int k = 1; k < 3; ++k) {
      const Eigen::Vector3d p = ToDouble(convolution.points[facet.corners[k]]);
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
    boxes.push_back(box);
  }
  return boxes;
}

// Turns intersections into segments of the planes, adding the points they need.
class SegmentWriter {
 public:
  SegmentWriter(const PlaneGroups& groups, const FacetIntersector& intersector,
                ExactPoints* points, FacetIntersections* out)
      : groups_(groups),
        intersector_(intersector),
        points_(points),
        out_(out) {}

  void Write(const Intersection& intersection) {
    const int from = PointOf(intersection.low);
    const int to = intersection.is_point ? from : PointOf(intersection.high);
    const int g = groups_.of_facet[intersection.first];
    const int h = groups_.of_facet[intersection.second];
    const auto [low, high] = std::minmax(from, to);
    out_->segments[g].push_back({low, high, h});
    out_->segments[h].push_back({low, high, g});
  }

 private:
  // Every edge meets every plane once.
  int PointOf(const Crossing& c) {
    if (c.point >= 0) return c.point;
    const auto [it, is_new] = edge_points_.try_emplace({c.a, c.b, c.group}, -1);
    if (is_new) it->second = points_->Add(intersector_.LocateCrossing(c));
    return it->second;
  }

  using EdgePlane = std::array<std::int64_t, 3>;

  const PlaneGroups& groups_;
  const FacetIntersector& intersector_;
  ExactPoints* points_;
  FacetIntersections* out_;
  std::unordered_map<EdgePlane, int, GridPointHash> edge_points_;
};

bool Overlap(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
             const BoundingBox& box) {
  return (low.array() <= box.max.array()).all() &&
         (high.array() >= box.min.array()).all();
}

// Calls visit(intersection) for every facet u > after that facet t meets.
template <typename Visit>
void ForEachIntersection(const PlaneGroups& groups, const FacetIndex& index,
                         const FacetIntersector& intersector, int t, int after,
                         const Visit& visit) {
  const BoundingBox& box = index.boxes[t];
  index.tree.ForEach(
      [&](int node) {
        return Overlap(index.tree.nodes()[node].min,
                       index.tree.nodes()[node].max, box);
      },
      [&](int position) {
        const int u = index.tree.order()[position];
        Intersection intersection;
        if (u > after && groups.of_facet[u] != groups.of_facet[t] &&
            Overlap(index.boxes[u].min, index.boxes[u].max, box) &&
            intersector.Intersect(t, u, &intersection)) {
          visit(intersection);
        }
        return true;
      });
}

bool IsOccupied(const OccupiedRegion* occupied, const Eigen::Vector3d& a,
                const Eigen::Vector3d& b) {
  return occupied != nullptr && !occupied->IsEmpty() &&
         occupied->Contains(a, b);
}

struct FlatSegment {
  Eigen::Vector2d from, along;
};

// Seen along an axis.
FlatSegment Flat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return {{a[u], a[v]}, {b[u] - a[u], b[v] - a[v]}};
}

// Pairs that cross between their ends; of very many an even sample.
double CountCrossings(const std::vector<FlatSegment>& segments) {
  constexpr std::size_t kMost = 256;
  const std::size_t stride = 1 + segments.size() / kMost;
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a[0] * b[1] - a[1] * b[0];
  };
  const auto splits = [&](const FlatSegment& s, const FlatSegment& t) {
    const double a = cross(s.along, t.from - s.from);
    const double b = cross(s.along, t.from + t.along - s.from);
    return (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0);
  };
  double count = 0.0;
  for (std::size_t i = 0; i < segments.size(); i += stride) {
    for (std::size_t j = 0; j < i; j += stride) {
      count +=
          splits(segments[i], segments[j]) && splits(segments[j], segments[i])
              ? 1.0
              : 0.0;
    }
  }
  return count * static_cast<double>(stride * stride);
}

}  // namespace

FacetIndex::FacetIndex(const Convolution& convolution)
    : boxes(FacetBoxes(convolution)), tree(boxes, 4) {}

FacetIndex::FacetIndex(const Convolution& convolution,
                       const BoundingBox& window)
    : boxes(FacetBoxes(convolution)) {
  for (BoundingBox& box : boxes) {
    box.min = box.min.cwiseMax(window.min).cwiseMin(window.max);
    box.max = box.max.cwiseMin(window.max).cwiseMax(window.min);
  }
  tree = BoxTree(boxes, 4);
}

ExpectedCuts ExpectCuts(const Convolution& convolution,
                        const PlaneGroups& groups, const FacetIndex& index,
                        const BuildLimits& limits,
                        const OccupiedRegion* occupied) {
  constexpr int kSample = 1024;
  const int count = static_cast<int>(index.boxes.size());
  const int stride = std::max(1, count / kSample);
  const int samples = (count + stride - 1) / stride;
  // Points do not matter here: their own numbers will do as ids.
  std::vector<int> ids(convolution.points.size());
  std::iota(ids.begin(), ids.end(), 0);
  const FacetIntersector intersector(convolution, groups, ids);
  std::vector<ExpectedCuts> found(static_cast<std::size_t>(samples));
  tbb::parallel_for(0, samples, [&](int i) {
    limits.Check("prediction");
    const int t = i * stride;
    std::vector<FlatSegment> segments;
    const int axis = LargestAxis(convolution.facets[t].normal);
    ForEachIntersection(
        groups, index, intersector, t, -1, [&](const Intersection& m) {
          const Eigen::Vector3d low = intersector.Approximate(m.low);
          const Eigen::Vector3d high = intersector.Approximate(m.high);
          if (IsOccupied(occupied, low, high)) return;
          ++found[i].meetings;
          if (!m.is_point) segments.push_back(Flat(low, high, axis));
        });
    found[i].crossings = CountCrossings(segments);
  });
  ExpectedCuts sum;
  for (const ExpectedCuts& cuts : found) {
    sum.meetings += 0.5 * cuts.meetings;
    sum.crossings += cuts.crossings;
  }
  const double share = static_cast<double>(count) / std::max(1, samples);
  return {share * sum.meetings, share * sum.crossings};
}

FacetIntersections IntersectFacets(const Convolution& convolution,
                                   const PlaneGroups& groups,
                                   const FacetIndex& index,
                                   const BuildLimits& limits,
                                   ExactPoints* points,
                                   const OccupiedRegion* occupied) {
  FacetIntersections out;
  out.segments.resize(groups.members.size());
  out.point_ids.assign(convolution.points.size(), -1);
  for (const ConvolutionFacet& facet : convolution.facets) {
    limits.Check("intersection");
    for (const int v : facet.corners) {
      if (out.point_ids[v] >= 0) continue;
      PointDefinition vertex;
      vertex.a = convolution.points[v];
      out.point_ids[v] = points->Add(Locate(vertex));
    }
  }
  const FacetIntersector intersector(convolution, groups, out.point_ids);
  SegmentWriter writer(groups, intersector, points, &out);
  const int count = static_cast<int>(index.boxes.size());
  std::vector<std::vector<Intersection>> intersections(std::min(count, kBlock));
  const auto is_occupied = [&](const Intersection& m) {
    return IsOccupied(occupied, intersector.Approximate(m.low),
                      intersector.Approximate(m.high));
  };
  for (int begin = 0; begin < count; begin += kBlock) {
    const int end = std::min(count, begin + kBlock);
    tbb::parallel_for(begin, end, [&](int t) {
      limits.Check("intersection");
      std::vector<Intersection>& found = intersections[t - begin];
      found.clear();
      ForEachIntersection(groups, index, intersector, t, t,
                          [&](const Intersection& m) {
                            if (!is_occupied(m)) found.push_back(m);
                          });
    });
    for (int t = begin; t < end; ++t) {
      limits.Check("intersection");
      for (const Intersection& intersection : intersections[t - begin])
        writer.Write(intersection);
    }
  }
  tbb::parallel_for(std::size_t{0}, out.segments.size(), [&](std::size_t g) {
    limits.Check("intersection");
    std::vector<PlaneSegment>& s = out.segments[g];
    std::sort(s.begin(), s.end());
    s.erase(std::unique(s.begin(), s.end(),
                        [](const PlaneSegment& a, const PlaneSegment& b) {
                          return a.from == b.from && a.to == b.to;
                        }),
            s.end());
  });
  return out;
}

}  // namespace phongpd::internal
