// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/explored_boxes.h"

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/contact/build_by_boxes.h"
#include "core/contact/build_stages.h"
#include "core/contact/convolution_model_data.h"
#include "core/contact/surface_description.h"
#include "core/minkowski/convolution/occupied_region.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// What is around the box of all sums, shares of its longest side: as far as
// configurations are looked at, up to the border, and up to the solid beyond.
constexpr double kReachShare = 1.0 / 32, kBorderShare = 1.0 / 16,
                 kSolidShare = 1.0 / 8;

// The surface of a box, all beyond it free.
SurfacePiece BoxPiece(const GridWindow& box) {
  SurfacePieceWriter writer;
  SurfacePiece& piece = writer.piece;
  for (const WallPatch& wall : WholeWalls(box)) {
    const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
    std::array<GridPoint, 4> corners = {wall.min, wall.min, wall.max, wall.min};
    corners[1][u] = wall.max[u];
    corners[3][v] = wall.max[v];
    if (!wall.is_high) std::swap(corners[1], corners[3]);
    GridPlane plane;
    plane.normal[wall.axis] = 1;
    plane.offset = wall.min[wall.axis];
    const int begin = static_cast<int>(piece.edges.size());
    std::array<int, 4> ids;
    for (int k = 0; k < 4; ++k) {
      PointDefinition point;
      point.a = corners[k];
      int id = 0;  // by its place on the box
      for (int i = 0; i < 3; ++i) {
        id |= (corners[k][i] == box.max[i] ? 1 : 0) << i;
      }
      ids[k] = writer.AddPoint(id, point);
    }
    for (int k = 0; k < 4; ++k) {
      piece.edges.push_back({ids[k], ids[(k + 1) % 4], begin + (k + 1) % 4, 0});
    }
    piece.faces.push_back(
        {writer.AddSide(plane, !wall.is_high, ContactKind::kNone), begin,
         begin + 4, -1});
  }
  return std::move(writer.piece);
}

// Of a piece the faces that are kept.
template <typename Keep>
SurfacePiece FacesThat(const SurfacePiece& piece, const Keep& keep) {
  SurfacePiece out;
  out.planes = piece.planes;
  out.sides = piece.sides;
  out.points = piece.points;
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    if (!keep(f)) continue;
    SurfacePiece::Face face = piece.faces[f];
    const int shift = static_cast<int>(out.edges.size()) - face.begin;
    for (int h = face.begin; h < face.end; ++h) {
      out.edges.push_back(piece.edges[static_cast<std::size_t>(h)]);
      out.edges.back().next += shift;
    }
    face.begin += shift;
    face.end += shift;
    out.faces.push_back(face);
  }
  return out;
}

// Leaves out the facets that lie in C_obj wherever they meet the box.  Of parts
// of a partition nobody knows the origins.
void DropOccupied(const OccupiedBalls& balls, const BoundingBox& box,
                  const BuildLimits& limits, WindowConvolution* sums) {
  const Convolution& all = sums->convolution;
  const OccupiedRegion region(balls, box, all, limits);
  WindowConvolution kept;
  for (std::size_t f = 0; f < all.facets.size(); ++f) {
    Vector3d corners[3];
    for (int k = 0; k < 3; ++k) {
      corners[k] = ToDouble(all.points[all.facets[f].corners[k]]);
    }
    if (region.Contains(corners)) continue;
    kept.convolution.facets.push_back(all.facets[f]);
  }
  kept.convolution.points = std::move(sums->convolution.points);
  *sums = std::move(kept);
}

BoxPartition::IsVoid VoidWhereOccupied(const OccupiedBalls* balls) {
  if (balls == nullptr) return {};
  return [balls, last = 0](const GridWindow& window) mutable {
    const BoundingBox box = window.Box();
    return balls->Contain(box.Center(), 0.5 * box.Diagonal(), &last);
  };
}

}  // namespace

ExploredBoxes::ExploredBoxes(const ConvolutionModel& model,
                             std::size_t most_facets, Purpose purpose)
    : model_(model),
      pair_(model_.data().pair),
      judge_(pair_.obstacle, pair_.reflected_robot),
      occupied_(purpose == Purpose::kRooms
                    ? nullptr
                    : std::make_unique<const OccupiedBalls>(
                          pair_.obstacle, pair_.reflected_robot,
                          OccupiedBalls::Asked::kSeldom)),
      sums_(pair_.obstacle, pair_.reflected_robot),
      partition_(sums_, Around(kBorderShare), most_facets,
                 VoidWhereOccupied(occupied_.get())) {
  RestartLimits();
}

void ExploredBoxes::RestartLimits() {
  limits_.emplace(model_.data().options);
  limits_->ObserveCancellation();
}

GridWindow ExploredBoxes::Around(double share) const {
  const BoundingBox& box = sums_.bounds();
  const double width = share * (box.max - box.min).maxCoeff();
  GridWindow window;
  for (int k = 0; k < 3; ++k) {
    window.min[k] = 2 * std::llround(std::floor(box.min[k] - width)) - 1;
    window.max[k] = 2 * std::llround(std::ceil(box.max[k] + width)) + 1;
  }
  return window;
}

BoundingBox ExploredBoxes::Reach() const { return Around(kReachShare).Box(); }

const ExploredBoxes::Box& ExploredBoxes::Explore(
    int box, const std::vector<Vector3d>& points) {
  const auto known = explored_.find(box);
  if (known != explored_.end()) return known->second;
  limits_->CheckNow("exploration");
  const GridWindow& window = partition_.window(box);
  Box added;
  added.patches = occupied_ ? WholeWalls(window) : partition_.Walls(box);
  WindowConvolution sums = partition_.Take(box);
  if (occupied_) DropOccupied(*occupied_, window.Box(), *limits_, &sums);
  WindowCells cells(sums, window, added.patches, judge_, *limits_);
  added.rooms = cells.Rooms();
  for (const Vector3d& q : points) {
    added.rooms_of_points.emplace_back();
    if (window.WallDistance(q) < 0.0) continue;
    added.rooms_of_points.back() = cells.RoomsAt(q);
  }
  faces_ += added.rooms.piece.arranged;
  return explored_.emplace(box, std::move(added)).first->second;
}

const ExploredBoxes::Box* ExploredBoxes::Find(int box) const {
  const auto known = explored_.find(box);
  return known == explored_.end() ? nullptr : &known->second;
}

ContactSpace::Parts ExploredBoxes::Surface(
    const std::vector<int>& boxes,
    const std::function<bool(int box, int room)>& is_kept) const {
  const std::set<int> shown(boxes.begin(), boxes.end());
  std::vector<SurfacePiece> pieces = {BoxPiece(Around(kSolidShare))};
  for (const int number : shown) {
    const Box& box = explored_.at(number);
    std::vector<char> keep(box.rooms.rooms.size());
    bool is_any = false;
    for (std::size_t r = 0; r < keep.size(); ++r) {
      keep[r] = is_kept(number, static_cast<int>(r)) ? 1 : 0;
      is_any = is_any || keep[r] != 0;
    }
    if (!is_any) continue;
    pieces.push_back(FacesThat(box.rooms.piece, [&](std::size_t f) {
      if (keep[static_cast<std::size_t>(box.rooms.room[f])] == 0) return false;
      const int patch = box.rooms.patch[f];
      return patch < 0 ||
             shown.count(box.patches[static_cast<std::size_t>(patch)].beyond) ==
                 0;
    }));
  }
  ContactSpace::Parts out;
  out.report.method =
      "free space explored in " + std::to_string(shown.size()) + " boxes";
  StageClock clock(&out.report);
  WriteJoinedSurface(pieces, false, pair_.frame, nullptr, &clock, &out);
  if (!occupied_) FinishReport(&clock, &out);
  return out;
}

void DropWalls(ContactSpace::Parts* space) {
  TriangleMesh mesh;
  std::vector<int> numbers(space->mesh.vertices.size(), -1);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < space->mesh.triangles.size(); ++t) {
    if (space->kind[t] == ContactKind::kNone) continue;
    Triangle triangle = space->mesh.triangles[t];
    for (int& v : triangle) {
      int& number = numbers[static_cast<std::size_t>(v)];
      if (number < 0) {
        number = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(
            space->mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = number;
    }
    mesh.triangles.push_back(triangle);
    space->plane[kept] = space->plane[t];
    space->kind[kept++] = space->kind[t];
  }
  space->plane.resize(kept);
  space->kind.resize(kept);
  space->mesh = std::move(mesh);
  DescribeSurface(space->mesh, &space->report);
}

}  // namespace phongpd::internal
