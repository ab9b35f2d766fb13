// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/window_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/mesh/numbers.h"
#include "core/mesh/union_find.h"
#include "core/minkowski/cell_probe.h"
#include "core/minkowski/edge_rings.h"
#include "core/minkowski/exact_points.h"
#include "core/minkowski/face_geometry.h"
#include "core/minkowski/facet_intersections.h"
#include "core/minkowski/plane_arrangement.h"
#include "core/minkowski/plane_groups.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Half steps: far above the rounding of the arrangement's points.
constexpr double kNearlyThere = 0x1p-6;
// Half steps: a cell that goes on as far at one of its largest faces is judged
// in it, whatever the rounding of points.
constexpr double kSureGap = 0x1p-4;
constexpr std::size_t kWholeWalls = 6;

double SquaredDistanceToEdge(const Vector3d& a, const Vector3d& b,
                             Vector3d* nearest) {
  const Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double t =
      length > 0.0 ? std::clamp(-a.dot(along) / length, 0.0, 1.0) : 0.0;
  *nearest = a + t * along;
  return nearest->squaredNorm();
}

}  // namespace

// All in half steps.
struct WindowCells::Impl {
  Impl(const WindowConvolution& sums, const GridWindow& window,
       std::vector<WallPatch> the_patches, const SolidCollision& the_judge,
       const BuildLimits& limits)
      : first_wall(static_cast<int>(sums.convolution.facets.size())),
        box{ToDouble(window.min), ToDouble(window.max)},
        patches(std::move(the_patches)),
        convolution(WithWalls(sums.convolution, patches)),
        groups(GroupByPlane(convolution)),
        judge(the_judge) {
    const FacetIndex index(convolution, box);
    FacetIntersections intersections =
        IntersectFacets(convolution, groups, index, limits, &points);
    if (patches.size() > kWholeWalls) CutAlongPatches(&intersections);
    arrangement =
        ArrangePlanes(convolution, groups, intersections, limits, &points);
    rings = SortAroundEdges(convolution, arrangement, points);
    FindCells();
  }

  // Patches of one wall lie in one plane, in which the borders between them
  // would be lost.
  void CutAlongPatches(FacetIntersections* intersections) {
    std::map<std::pair<int, std::int64_t>, int> cutters;  // planes by number
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const int facet = first_wall + 2 * static_cast<int>(k);
      std::vector<PlaneSegment>& segments =
          intersections->segments[groups.of_facet[facet]];
      for (const int half : {facet, facet + 1}) {
        const Triangle& t = convolution.facets[half].corners;
        // Corners 0, 1, 2 and 0, 2, 3: all sides but the diagonal 0–2.
        for (const int side : {half == facet ? 0 : 1, half == facet ? 1 : 2}) {
          const int a = t[side], b = t[(side + 1) % 3];
          const GridPoint& p = convolution.points[a];
          const GridPoint along = convolution.points[b] - p;
          const int across = 3 - patches[k].axis - LargestAxis(along);
          const auto [it, is_new] =
              cutters.emplace(std::pair(across, p[across]),
                              static_cast<int>(groups.planes.size()));
          if (is_new) {
            GridPlane plane;
            plane.normal[across] = 1;
            plane.offset = p[across];
            groups.planes.push_back(plane);
          }
          const auto [from, to] = std::minmax(
              {intersections->point_ids[a], intersections->point_ids[b]});
          segments.push_back({from, to, it->second});
        }
      }
    }
    for (std::vector<PlaneSegment>& s : intersections->segments) {
      std::sort(s.begin(), s.end());
      s.erase(std::unique(s.begin(), s.end(),
                          [](const PlaneSegment& a, const PlaneSegment& b) {
                            return a.from == b.from && a.to == b.to;
                          }),
              s.end());
    }
  }

  bool IsWall(int face) const {
    return arrangement.faces[face].facet >= first_wall;
  }

  // Faces are joined where they share an edge that is in no wall: each such
  // part is in the window or outside.  One that has an edge in a wall shows
  // which by the side of the wall it lies on.
  std::vector<char> FindInside() const {
    const std::size_t count = arrangement.faces.size();
    UnionFind parts(count);
    std::vector<char> inside(count, 0), known(count, 0);
    std::vector<std::pair<int, char>> told;
    for (const EdgeRing& ring : rings.rings) {
      const int size = ring.end - ring.begin;
      const auto spoke = [&](int k) -> const Spoke& {
        return rings.spokes[ring.begin + k % size];
      };
      int wall = 0;
      while (wall < size && !IsWall(spoke(wall).face)) ++wall;
      if (wall == size) {
        for (int k = 0; k + 1 < size; ++k) {
          parts.Join(spoke(k).face, spoke(k + 1).face);
        }
        continue;
      }
      // What follows a wall up to the next one lies on the side that the wall
      // has there.
      char is_inside = 0;
      for (int k = wall; k < wall + size; ++k) {
        const Spoke& s = spoke(k);
        if (IsWall(s.face)) {
          is_inside = s.SideToNext() == PlusSide(s.face);
        } else {
          told.emplace_back(s.face, is_inside);
        }
      }
    }
    for (const auto& [face, is_inside] : told) {
      inside[parts.Find(face)] = is_inside;
      known[parts.Find(face)] = 1;
    }
    std::vector<char> result(count, 0);
    for (std::size_t f = 0; f < count; ++f) {
      const int face = static_cast<int>(f), part = parts.Find(face);
      if (!known[part]) {  // it touches no wall
        const Vector3d& p = points.Approximate(
            arrangement.half_edges[arrangement.faces[f].begin].from);
        inside[part] = (p.array() > box.min.array()).all() &&
                       (p.array() < box.max.array()).all();
        known[part] = 1;
      }
      result[f] = IsWall(face) || inside[part];
    }
    return result;
  }

  void FindCells() {
    const int count = static_cast<int>(arrangement.faces.size());
    UnionFind sides = JoinSides(rings, arrangement.faces.size());
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

  struct FacePoint {
    double squared_distance = kInfinity;
    Vector3d offset = Vector3d::Zero();  // from q
  };

  // The point of a face nearest to q, found relative to q.
  FacePoint NearestOn(int face, const Vector3d& q, double limit) const {
    const ArrangementFace& f = arrangement.faces[face];
    const ConvolutionFacet& facet = convolution.facets[f.facet];
    const Vector3d n = ToDouble(facet.normal).normalized();
    const double height =
        n.dot(ToDouble(convolution.points[facet.corners[0]]) - q);
    FacePoint best;
    if (height * height >= limit) return best;
    const Vector3d foot = height * n;
    const int axis = LargestAxis(n), u = (axis + 1) % 3, v = (axis + 2) % 3;
    bool holds_foot = false;
    for (int h = f.begin; h < f.end; ++h) {
      const HalfEdge& e = arrangement.half_edges[h];
      const Vector3d a = points.Approximate(e.from) - q;
      const Vector3d b = points.Approximate(e.to) - q;
      Vector3d nearest;
      const double squared = SquaredDistanceToEdge(a, b, &nearest);
      if (squared < best.squared_distance) best = {squared, nearest};
      if ((a[v] > foot[v]) == (b[v] > foot[v])) continue;
      const double at =
          a[u] + (foot[v] - a[v]) * ((b[u] - a[u]) / (b[v] - a[v]));
      if (at > foot[u]) holds_foot = !holds_foot;
    }
    if (holds_foot && height * height < best.squared_distance) {
      best = {height * height, foot};
    }
    return best;
  }

  // The convolution facet that the face is part of at a point of it: coplanar
  // facets are arranged together.
  int FacetAt(int face, const Vector3d& point) const {
    const int representative = arrangement.faces[face].facet;
    const int group = groups.of_facet[representative];
    int best = representative;
    double least = kInfinity;
    for (const int f : groups.members[group]) {
      if (groups.reversed[f] != groups.reversed[representative]) continue;
      const double squared = SquaredDistanceInPlane(f, point);
      if (squared < least) {
        least = squared;
        best = f;
      }
    }
    return best;
  }

  // Of a point in a facet's plane to the facet.
  double SquaredDistanceInPlane(int f, const Vector3d& point) const {
    const ConvolutionFacet& facet = convolution.facets[f];
    const Vector3d n = ToDouble(facet.normal);
    bool inside = true;
    double least = kInfinity;
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = ToDouble(convolution.points[facet.corners[k]]) - point;
      const Vector3d b =
          ToDouble(convolution.points[facet.corners[(k + 1) % 3]]) - point;
      Vector3d nearest;
      least = std::min(least, SquaredDistanceToEdge(a, b, &nearest));
      if (n.dot((b - a).cross(-a)) < 0.0) inside = false;
    }
    return inside ? 0.0 : least;
  }

  // Of a point within 2^-12 of a grid step: does it lie in the face's plane?
  bool LiesInPlane(int face, const Vector3d& q) const {
    const ConvolutionFacet& facet =
        convolution.facets[arrangement.faces[face].facet];
    const GridPoint& origin = convolution.points[facet.corners[0]];
    Wide side = 0;
    for (int k = 0; k < 3; ++k) {
      const Wide x = std::llround(std::ldexp(q[k], 11));
      side += Wide(facet.normal[k]) * (x - (Wide(origin[k]) << 11));
    }
    return side.is_zero();
  }

  // Per half-edge: bit k where it lies in a wall across axis k.
  std::vector<int> WallsOfEdges() const {
    std::vector<int> walls(arrangement.half_edges.size(), 0);
    for (const EdgeRing& ring : rings.rings) {
      int bits = 0;
      for (int k = ring.begin; k < ring.end; ++k) {
        const int face = rings.spokes[k].face;
        if (!IsWall(face)) continue;
        bits |= 1 << LargestAxis(
                    convolution.facets[arrangement.faces[face].facet].normal);
      }
      for (int k = ring.begin; bits != 0 && k < ring.end; ++k) {
        walls[rings.spokes[k].half_edge] = bits;
      }
    }
    return walls;
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

  BoundingBox BoxOf(int face) const {
    const ArrangementFace& f = arrangement.faces[face];
    BoundingBox out;
    for (int h = f.begin; h < f.end; ++h) {
      const Vector3d& p = points.Approximate(arrangement.half_edges[h].from);
      out.min = h == f.begin ? p : out.min.cwiseMin(p);
      out.max = h == f.begin ? p : out.max.cwiseMax(p);
    }
    return out;
  }

  // The patch that a face of a wall lies in.
  int PatchOf(int face, const BoundingBox& around) const {
    const WallPatch& wall = patches[static_cast<std::size_t>(
        (arrangement.faces[face].facet - first_wall) / 2)];
    const Vector3d middle = around.Center();
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const WallPatch& p = patches[k];
      if (p.axis != wall.axis || p.is_high != wall.is_high) continue;
      const Vector3d low = ToDouble(p.min), high = ToDouble(p.max);
      bool is_within = true;
      for (int i = 0; i < 3; ++i) {
        is_within =
            is_within &&
            (i == p.axis || (low[i] <= middle[i] && middle[i] <= high[i]));
      }
      if (is_within) return static_cast<int>(k);
    }
    return -1;  // not reached: the patches make up the wall
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

  int first_wall;
  BoundingBox box;
  std::vector<WallPatch> patches;
  Convolution convolution;
  PlaneGroups groups;
  const SolidCollision& judge;
  ExactPoints points;
  Arrangement arrangement;
  EdgeRings rings;
  FaceGeometry geometry{convolution, arrangement, points};
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
int WindowCells::JudgedCells() const { return impl_->judged; }

}  // namespace phongpd::internal
