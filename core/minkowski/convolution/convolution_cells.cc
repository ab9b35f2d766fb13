// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/convolution_cells.h"

#include <optional>
#include <utility>
#include <vector>

#include "core/minkowski/build_limits.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Sums that a cell may hold.  Fewer: a look is cheaper, all of them dearer.
constexpr std::size_t kMostSums = 400;
// Halves may hold more, by this factor: where thousands of facets share a
// corner, no box around it would ever meet few.
constexpr double kHalfGrowth = 1.1;

// Grid points are exact in double.
TriangleMesh AsMesh(const Convolution& convolution) {
  TriangleMesh mesh;
  mesh.triangles.reserve(convolution.facets.size());
  std::vector<int> numbers(convolution.points.size(), -1);
  for (const ConvolutionFacet& f : convolution.facets) {
    Triangle& t = mesh.triangles.emplace_back(f.corners);
    for (int& v : t) {
      int& number = numbers[static_cast<std::size_t>(v)];
      if (number < 0) {
        number = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(
            ToDouble(convolution.points[static_cast<std::size_t>(v)]));
      }
      v = number;
    }
  }
  return mesh;
}

// What a leaf takes, nearly.
std::size_t BytesOf(const TriangleMesh& mesh, const TriangleBvh& bvh) {
  return mesh.vertices.size() * sizeof(Vector3d) +
         mesh.triangles.size() *
             (sizeof(Triangle) + sizeof(TriangleCorners) + sizeof(int)) +
         bvh.tree().nodes().size() * sizeof(BoxTree::Node);
}

}  // namespace

ConvolutionCells::Cell::~Cell() { delete content.load(); }

ConvolutionCells::ConvolutionCells(const GridSolid& p, const GridSolid& q,
                                   std::function<double()> max_mib)
    : sums_(p, q), max_mib_(std::move(max_mib)) {
  root_.box.min = sums_.bounds().min;
  root_.box.max = sums_.bounds().max;
  root_.most = kMostSums;
  largest_ =
      root_.box.min.cwiseAbs().cwiseMax(root_.box.max.cwiseAbs()).maxCoeff();
}

ConvolutionCells::~ConvolutionCells() = default;

const ConvolutionCells::Content& ConvolutionCells::Look(
    const Cell& cell, bool may_keep,
    std::unique_ptr<const Content>* mine) const {
  const Content* known = cell.content.load(std::memory_order_acquire);
  if (known != nullptr) return *known;
  *mine = Find(cell);
  if (!may_keep) return **mine;
  std::size_t bytes = sizeof(Content) + 2 * sizeof(Cell);
  std::size_t facets = 0;
  if ((*mine)->leaf != nullptr) {
    bytes += BytesOf((*mine)->leaf->mesh, (*mine)->leaf->bvh);
    facets = (*mine)->leaf->mesh.triangles.size();
  }
  if (static_cast<double>(bytes_.fetch_add(bytes) + bytes) / kMib >
      max_mib_()) {
    bytes_ -= bytes;
    return **mine;
  }
  if (!cell.content.compare_exchange_strong(known, mine->get(),
                                            std::memory_order_acq_rel)) {
    bytes_ -= bytes;  // another thread was faster
    mine->reset();
    return *known;
  }
  facets_ += facets;
  return *mine->release();
}

std::unique_ptr<const ConvolutionCells::Content> ConvolutionCells::Find(
    const Cell& cell) const {
  auto content = std::make_unique<Content>();
  const BoundingBox box{cell.box.min, cell.box.max};
  const std::optional<WindowConvolution> part = sums_.Within(box, cell.most);
  if (part) {
    if (part->convolution.facets.empty()) return content;
    content->leaf = std::make_unique<Leaf>();
    content->leaf->mesh = AsMesh(part->convolution);
    content->leaf->bvh = TriangleBvh(content->leaf->mesh);
    return content;
  }
  int axis = 0;
  (box.max - box.min).maxCoeff(&axis);
  const double middle = 0.5 * (box.min[axis] + box.max[axis]);
  content->halves.reset(new Cell[2]);
  for (int k = 0; k < 2; ++k) {
    Cell& half = content->halves[k];
    half.box = cell.box;
    (k == 0 ? half.box.max : half.box.min)[axis] = middle;
    half.most =
        static_cast<std::size_t>(kHalfGrowth * static_cast<double>(cell.most));
  }
  return content;
}

}  // namespace phongpd::internal
