// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/windows/window_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/mesh/union_find.h"
#include "core/minkowski/cells/cell_probe.h"
#include "core/minkowski/windows/window_arrangement.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Half steps: far above the rounding of the arrangement's points.
constexpr double kNearlyThere = 0x1p-6;
// Half steps: a cell that goes on as far at one of its largest faces is judged
// in it, whatever the rounding of points.
constexpr double kSureGap = 0x1p-4;

}  // namespace

// All in half steps.
struct WindowCells::Impl : WindowArrangement {
  Impl(const WindowConvolution& sums, const GridWindow& window,
       const std::vector<WallPatch>& the_patches,
       const SolidCollision& the_judge, const BuildLimits& limits)
      : WindowArrangement(sums, window, the_patches, limits), judge(the_judge) {
    FindCells();
  }

  void FindCells() {
    const int count = static_cast<int>(arrangement.faces.size());
    UnionFind sides = JoinSides(radial, arrangement.faces.size());
    const std::vector<char> inside = FindInside();
    std::vector<char> occupied(2 * arrangement.faces.size(), 0);
    for (int f = 0; f < count; ++f) {
      if (!inside[f]) continue;
      occupied[sides.Find(MinusSide(f))] = 1;
      if (arrangement.faces[f].two_sided) occupied[sides.Find(PlusSide(f))] = 1;
    }
    std::map<int, int> ids;
    candidate_of.assign(arrangement.faces.size(), -1);
    for (int f = 0; f < count; ++f) {
      const int cell = sides.Find(PlusSide(f));
      if (!inside[f] || occupied[cell]) continue;
      const auto [it, is_new] =
          ids.emplace(cell, static_cast<int>(candidates.size()));
      if (is_new) candidates.emplace_back();
      candidates[it->second].sides.push_back(PlusSide(f));
      candidate_of[f] = it->second;
    }
    area.resize(arrangement.faces.size());
    if (candidates.size() > 4) geometry.BuildTree();
    for (const Candidate& c : candidates) {
      for (const int side : c.sides) area[side / 2] = geometry.Area(side / 2);
    }
  }

  // A cell of + sides alone.
  struct Candidate {
    std::vector<int> sides;
    int judgement = -1;  // 1: free
    double gap = 0.0;    // or width of the face, where it was judged
  };

  // About how wide a face is: twice its area over its outline.
  double Width(int face) const {
    const ArrangementFace& f = arrangement.faces[face];
    double outline = 0.0;
    for (int h = f.begin; h < f.end; ++h) {
      const HalfEdge& e = arrangement.half_edges[h];
      outline += (points.Approximate(e.to) - points.Approximate(e.from)).norm();
    }
    return outline > 0.0 ? 2.0 * area[face] / outline : 0.0;
  }

  bool IsFree(Candidate* cell) {
    if (cell->judgement < 0) {
      // The probe may be anywhere in the window.
      const double reach = 100.0 * (box.max - box.min).maxCoeff();
      std::vector<int> sides = cell->sides;
      int face = 0;
      const Vector3d probe =
          ProbePoint(geometry, area, &sides, reach, &cell->gap, &face);
      // Beside a needle, a point before it need not be in its cell.
      cell->gap = std::min(cell->gap, Width(face));
      cell->judgement = judge.Collide(0.5 * probe) ? 0 : 1;
      ++judged;
    }
    return cell->judgement == 1;
  }

  // Has a face of the cell an edge in a wall?
  bool TouchesWall(const Candidate& cell, const std::vector<int>& walls) const {
    return std::any_of(cell.sides.begin(), cell.sides.end(), [&](int side) {
      const ArrangementFace& f = arrangement.faces[side / 2];
      return !IsWall(side / 2) &&
             std::any_of(walls.begin() + f.begin, walls.begin() + f.end,
                         [](int bits) { return bits != 0; });
    });
  }

  // Is it for others to judge, beyond a wall?
  bool IsThin(const Candidate& cell, const std::vector<int>& walls) const {
    return cell.gap < kSureGap && TouchesWall(cell, walls);
  }

  bool IsAllOfWalls(const Candidate& cell) const {
    return std::all_of(cell.sides.begin(), cell.sides.end(),
                       [&](int side) { return IsWall(side / 2); });
  }

  // The cell that a part of C_cont inside the window sees from its largest
  // face: they are of one room.  −1: rounding could decide.
  int CellAround(const Candidate& island) const {
    const int side = *std::max_element(
        island.sides.begin(), island.sides.end(),
        [&](int a, int b) { return area[a / 2] < area[b / 2]; });
    const int face = side / 2;
    const Vector3d n = geometry.Normal(face);
    const FaceGeometry::Hit hit =
        geometry.FirstHit(geometry.InteriorPoint(face), n,
                          4.0 * (box.max - box.min).maxCoeff(), face);
    const bool is_seen = hit.face >= 0 && hit.distance > kSureGap &&
                         geometry.Normal(hit.face).dot(n) < 0.0;
    return is_seen ? candidate_of[hit.face] : -1;
  }

  // Numbers the rooms.
  int FindRooms(const std::vector<int>& walls) {
    std::vector<char> is_room(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      is_room[c] = IsFree(&candidates[c]) || IsThin(candidates[c], walls);
    }
    UnionFind same(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const std::vector<int>& sides = candidates[c].sides;
      if (!is_room[c] || std::any_of(sides.begin(), sides.end(),
                                     [&](int s) { return IsWall(s / 2); })) {
        continue;
      }
      const int around = CellAround(candidates[c]);
      if (around >= 0 && is_room[static_cast<std::size_t>(around)]) {
        same.Join(static_cast<int>(c), around);
      }
    }
    int count = 0;
    room_of.assign(candidates.size(), -1);
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (!is_room[c]) continue;
      int& room = room_of[static_cast<std::size_t>(
          same.Find(static_cast<int>(c)))];  // the smallest: met first
      if (room < 0) room = count++;
      room_of[c] = room;
    }
    return count;
  }

  // Adds a face of C_cont, or of a wall.
  void Write(int face, const std::vector<int>& walls, int cell,
             SurfacePieceWriter* writer) const {
    const ArrangementFace& f = arrangement.faces[face];
    SurfacePiece& piece = writer->piece;
    const int shift = static_cast<int>(piece.edges.size()) - f.begin;
    const int side = writer->AddSide(groups.planes[groups.of_facet[f.facet]],
                                     groups.reversed[f.facet] != 0,
                                     convolution.facets[f.facet].kind);
    for (int h = f.begin; h < f.end; ++h) {
      const HalfEdge& e = arrangement.half_edges[h];
      const int from = writer->AddPoint(e.from, points[e.from].definition);
      const int to = writer->AddPoint(e.to, points[e.to].definition);
      piece.edges.push_back({from, to, e.next + shift, walls[h]});
    }
    piece.faces.push_back({side, f.begin + shift, f.end + shift, cell});
  }

  void Count(SurfacePiece* piece) const {
    piece->arranged = arrangement.faces.size();
    piece->cells = candidates.size();
    piece->judged = static_cast<std::size_t>(judged);
  }

  const SolidCollision& judge;
  std::vector<double> area;
  std::vector<Candidate> candidates;
  std::vector<int> candidate_of;  // per face, in front of it; −1: none
  std::vector<int> room_of;       // per candidate, −1: occupied
  int judged = 0;
};

WindowCells::WindowCells(const WindowConvolution& sums,
                         const GridWindow& window, const SolidCollision& judge,
                         const BuildLimits& limits)
    : WindowCells(sums, window, WholeWalls(window), judge, limits) {}
WindowCells::WindowCells(const WindowConvolution& sums,
                         const GridWindow& window,
                         const std::vector<WallPatch>& patches,
                         const SolidCollision& judge, const BuildLimits& limits)
    : impl_(std::make_unique<Impl>(sums, window, patches, judge, limits)) {}
WindowCells::~WindowCells() = default;

WindowCells::Nearest WindowCells::FindNearest(const Vector3d& q) {
  const Vector3d q2 = 2.0 * q;
  // Cells by their nearest face, so that few are judged.
  struct Entry {
    double squared_distance;
    int cell, face;
    Vector3d offset;
  };
  std::vector<Entry> entries;
  for (int c = 0; c < static_cast<int>(impl_->candidates.size()); ++c) {
    Entry entry{kInfinity, c, -1, Vector3d::Zero()};
    for (const int side : impl_->candidates[c].sides) {
      if (impl_->IsWall(side / 2)) continue;
      Impl::FacePoint p =
          impl_->NearestOn(side / 2, q2, entry.squared_distance);
      if (p.squared_distance < kNearlyThere * kNearlyThere &&
          impl_->LiesInPlane(side / 2, q2)) {
        p = {0.0, Vector3d::Zero()};
      }
      if (p.squared_distance < entry.squared_distance) {
        entry = {p.squared_distance, c, side / 2, p.offset};
      }
    }
    if (entry.face >= 0) entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.squared_distance != b.squared_distance
               ? a.squared_distance < b.squared_distance
               : a.cell < b.cell;
  });
  Nearest nearest;
  for (const Entry& entry : entries) {
    if (!impl_->IsFree(&impl_->candidates[entry.cell])) continue;
    nearest.found = true;
    nearest.distance = 0.5 * std::sqrt(entry.squared_distance);
    nearest.point = q + 0.5 * entry.offset;
    nearest.normal = impl_->geometry.Normal(entry.face);
    nearest.facet = impl_->FacetAt(entry.face, q2 + entry.offset);
    break;
  }
  return nearest;
}

SurfacePiece WindowCells::Surface() {
  SurfacePieceWriter writer;
  const std::vector<int> walls = impl_->WallsOfEdges();
  int thin = 0;  // cells that others have to judge
  for (Impl::Candidate& cell : impl_->candidates) {
    if (impl_->IsAllOfWalls(cell)) continue;
    const bool is_free = impl_->IsFree(&cell);
    const bool is_thin = impl_->IsThin(cell, walls);
    if (!is_free && !is_thin) continue;
    for (const int side : cell.sides) {
      if (!impl_->IsWall(side / 2)) {
        impl_->Write(side / 2, walls, is_thin ? thin : -1, &writer);
      }
    }
    thin += is_thin ? 1 : 0;
  }
  impl_->Count(&writer.piece);
  return std::move(writer.piece);
}

WindowRooms WindowCells::Rooms() {
  WindowRooms out;
  SurfacePieceWriter writer;
  const std::vector<int> walls = impl_->WallsOfEdges();
  out.rooms.resize(static_cast<std::size_t>(impl_->FindRooms(walls)));
  int thin = 0;
  for (std::size_t c = 0; c < impl_->candidates.size(); ++c) {
    const int room = impl_->room_of[c];
    if (room < 0) continue;
    const Impl::Candidate& cell = impl_->candidates[c];
    const bool is_thin = impl_->IsThin(cell, walls);
    for (const int side : cell.sides) {
      const int face = side / 2;
      int patch = -1;
      if (impl_->IsWall(face)) {
        const BoundingBox around = impl_->BoxOf(face);
        patch = impl_->PatchOf(face, around);
        out.rooms[static_cast<std::size_t>(room)].openings.push_back(
            {patch, around});
      }
      impl_->Write(face, walls, is_thin ? thin : -1, &writer);
      out.room.push_back(room);
      out.patch.push_back(patch);
    }
    thin += is_thin ? 1 : 0;
  }
  impl_->Count(&writer.piece);
  out.piece = std::move(writer.piece);
  return out;
}

std::vector<int> WindowCells::RoomsAt(const Vector3d& q) {
  if (impl_->room_of.empty()) impl_->FindRooms(impl_->WallsOfEdges());
  std::vector<std::pair<double, int>> distances;  // of rooms
  double least = kInfinity;
  for (std::size_t c = 0; c < impl_->candidates.size(); ++c) {
    if (impl_->room_of[c] < 0) continue;
    double squared = kInfinity;
    for (const int side : impl_->candidates[c].sides) {
      squared = std::min(
          squared,
          impl_->NearestOn(side / 2, 2.0 * q, squared).squared_distance);
    }
    distances.emplace_back(std::sqrt(squared), impl_->room_of[c]);
    least = std::min(least, distances.back().first);
  }
  std::vector<int> rooms;
  for (const auto& [distance, room] : distances) {
    if (distance > least + kNearlyThere) continue;
    if (std::find(rooms.begin(), rooms.end(), room) == rooms.end()) {
      rooms.push_back(room);
    }
  }
  return rooms;
}

double WindowCells::SurfaceArea() {
  double area = 0.0;
  for (Impl::Candidate& cell : impl_->candidates) {
    if (!impl_->IsFree(&cell)) continue;
    for (const int side : cell.sides) {
      if (!impl_->IsWall(side / 2)) area += 0.25 * impl_->area[side / 2];
    }
  }
  return area;
}

int WindowCells::FaceCount() const {
  return static_cast<int>(impl_->arrangement.faces.size());
}

}  // namespace phongpd::internal
