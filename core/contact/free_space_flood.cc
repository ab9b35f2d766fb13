// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/free_space_flood.h"

#include <algorithm>
#include <array>
#include <map>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/build_by_boxes.h"
#include "core/contact/build_stages.h"
#include "core/contact/convolution_model_data.h"
#include "core/contact/surface_description.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/box_partition.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/solid_collision.h"
#include "core/minkowski/window_cells.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::BoxPartition;
using internal::GridPoint;
using internal::GridWindow;
using internal::SurfacePiece;
using internal::WallPatch;
using internal::WindowCells;
using internal::WindowRooms;

// Facets of the convolution that meet a box, about: found by trying, as are the
// next two.
constexpr std::size_t kMostFacets = 200;
// What is left of the way counts so many times as much as what is behind: 1
// would find the shortest way, and explore all that may be as short.
constexpr double kHaste = 2.0;
// A box with so many faces is worth a detour as long as it is.
constexpr double kCheapBox = 333.0;
// What is around the box of all sums, shares of its longest side: as far as
// ends are explored from, up to the border, and up to the solid beyond it.
constexpr double kEndShare = 1.0 / 32, kBorderShare = 1.0 / 16,
                 kSolidShare = 1.0 / 8;
constexpr char kName[] = "explored free space";
// Half steps: openings this far from each other may be one, rounded.
constexpr double kRounding = 1.0;

// Wider by `share` of its longest side, its walls odd.
GridWindow Around(const BoundingBox& box, double share) {
  const double width = share * (box.max - box.min).maxCoeff();
  GridWindow window;
  for (int k = 0; k < 3; ++k) {
    window.min[k] = 2 * std::llround(std::floor(box.min[k] - width)) - 1;
    window.max[k] = 2 * std::llround(std::ceil(box.max[k] + width)) + 1;
  }
  return window;
}

// The surface of a box, all beyond it free.
SurfacePiece BoxPiece(const GridWindow& box) {
  internal::SurfacePieceWriter writer;
  SurfacePiece& piece = writer.piece;
  for (const WallPatch& wall : internal::WholeWalls(box)) {
    const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
    std::array<GridPoint, 4> corners = {wall.min, wall.min, wall.max, wall.min};
    corners[1][u] = wall.max[u];
    corners[3][v] = wall.max[v];
    if (!wall.is_high) std::swap(corners[1], corners[3]);
    internal::GridPlane plane;
    plane.normal[wall.axis] = 1;
    plane.offset = wall.min[wall.axis];
    const int begin = static_cast<int>(piece.edges.size());
    std::array<int, 4> ids;
    for (int k = 0; k < 4; ++k) {
      internal::PointDefinition point;
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
SurfacePiece Filtered(const SurfacePiece& piece, const Keep& keep) {
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

}  // namespace

// Grid steps, but for boxes of openings.
struct FreeSpaceFlood::Impl {
  using Opening = WindowRooms::Opening;

  // How a room was reached from an end.
  struct Reached {
    bool is_reached = false;
    double way = 0.0;                // from the end, about
    Vector3d at = Vector3d::Zero();  // where it was entered, half steps
  };
  struct Leaf {
    std::vector<WallPatch> patches;
    WindowRooms rooms;
    std::vector<std::array<Reached, 2>> reached;  // per room and end
  };
  struct Waiting {
    double length;  // of a way through it to the other end, at least
    int leaf;
    bool operator<(const Waiting& o) const {
      return length != o.length ? length > o.length : leaf > o.leaf;
    }
  };

  Impl(const ConvolutionModel& the_model, const Vector3d& start,
       const Vector3d& goal)
      : model(the_model),
        limits(model.data().options),
        pair(model.data().pair),
        judge(pair.obstacle, pair.reflected_robot),
        sums(pair.obstacle, pair.reflected_robot),
        border(Around(sums.bounds(), kBorderShare)),
        partition(sums, border, kMostFacets) {
    limits.ObserveCancellation();
    const BoundingBox ends = Around(sums.bounds(), kEndShare).Box();
    for (const int end : {0, 1}) {
      const Vector3d& q = end == 0 ? start : goal;
      if (!model.IsFree(q)) {
        throw InputError(std::string("flood: expected a free ") +
                         (end == 0 ? "start" : "goal") + ", found none");
      }
      const Vector3d x = pair.frame.ToGrid(q);
      points[end] = x.cwiseMax(ends.min).cwiseMin(ends.max);
      configurations[end] =
          points[end] == x ? q : pair.frame.ToUser(points[end]);
    }
    for (const int end : {0, 1}) Begin(end);
  }

  // Explores all boxes that come near an end, so that no wall does.
  void Begin(int end) {
    const Vector3d& x = points[end];
    for (const int leaf :
         partition.LeavesIn({x.array() - 1.0, x.array() + 1.0})) {
      if (leaves.count(leaf) == 0) ExploreLeaf(leaf, end);
      const GridWindow& window = partition.window(leaf);
      if (window.WallDistance(x) < 0.0) continue;
      WindowCells cells = Arrange(leaf);
      for (const int room : cells.RoomsAt(x)) {
        Reach(leaf, room, end, 0.0, 2.0 * x);
      }
    }
  }

  WindowCells Arrange(int leaf) {
    return WindowCells(partition.Take(leaf), partition.window(leaf),
                       partition.Walls(leaf), judge, limits);
  }

  static bool Overlap(const BoundingBox& a, const BoundingBox& b) {
    return (a.min.array() <= b.max.array() + kRounding).all() &&
           (b.min.array() <= a.max.array() + kRounding).all();
  }
  static bool IsSame(const BoundingBox& a, const BoundingBox& b) {
    return ((a.min - b.min).array().abs() <= kRounding).all() &&
           ((a.max - b.max).array().abs() <= kRounding).all();
  }

  // Calls visit(room, opening) for what of a leaf goes on in `beyond` through
  // `opening`.  Both leaves cut their common wall alike; should rounding have
  // it otherwise, through what is near.
  template <typename Visit>
  static void ForEachBeside(const Leaf& leaf, int beyond,
                            const Opening& opening, const Visit& visit) {
    bool is_found = false;
    for (const bool is_exact : {true, false}) {
      for (std::size_t r = 0; !is_found && r < leaf.rooms.rooms.size(); ++r) {
        for (const Opening& o : leaf.rooms.rooms[r].openings) {
          const auto patch = static_cast<std::size_t>(o.patch);
          if (leaf.patches[patch].beyond != beyond ||
              !(is_exact ? IsSame(o.box, opening.box)
                         : Overlap(o.box, opening.box))) {
            continue;
          }
          visit(static_cast<int>(r), o);
          if (is_exact) is_found = true;
        }
      }
    }
  }

  // A room was entered at a point, half steps, and so all that is known to be
  // connected with it; what is not known yet waits.
  void Reach(int leaf, int room, int end, double way, const Vector3d& at) {
    struct Step {
      int leaf, room;
      double way;
      Vector3d at;
    };
    std::vector<Step> open = {{leaf, room, way, at}};
    while (!open.empty()) {
      const Step step = open.back();
      open.pop_back();
      Leaf& in = leaves.at(step.leaf);
      auto& reached = in.reached[static_cast<std::size_t>(step.room)];
      if (reached[static_cast<std::size_t>(end)].is_reached) continue;
      reached[static_cast<std::size_t>(end)] = {true, step.way, step.at};
      has_met =
          has_met || reached[static_cast<std::size_t>(1 - end)].is_reached;
      for (const Opening& opening :
           in.rooms.rooms[static_cast<std::size_t>(step.room)].openings) {
        const int beyond =
            in.patches[static_cast<std::size_t>(opening.patch)].beyond;
        if (beyond < 0) continue;
        const Vector3d next =
            step.at.cwiseMax(opening.box.min).cwiseMin(opening.box.max);
        const double way_there =
            step.way + (next - step.at).norm() * CostOfWay(in);
        const auto known = leaves.find(beyond);
        if (known == leaves.end()) {
          Wait(beyond, end, way_there, next);
          continue;
        }
        ForEachBeside(known->second, step.leaf, opening,
                      [&](int other, const Opening&) {
                        open.push_back({beyond, other, way_there, next});
                      });
      }
    }
  }

  // Of a way through a box, per length.
  static double CostOfWay(const Leaf& leaf) {
    return 1.0 + static_cast<double>(leaf.rooms.piece.arranged) / kCheapBox;
  }

  void Wait(int leaf, int end, double way, const Vector3d& at) {
    const Vector3d& other = points[static_cast<std::size_t>(1 - end)];
    waiting[static_cast<std::size_t>(end)].push(
        {way + kHaste * (2.0 * other - at).norm(), leaf});
  }

  // Arranges a box and reaches what of it is beside rooms that were reached.
  void ExploreLeaf(int number, int end) {
    limits.Look("exploration");
    WindowCells cells = Arrange(number);
    Leaf leaf;
    leaf.patches = partition.Walls(number);
    leaf.rooms = cells.Rooms();
    leaf.reached.resize(leaf.rooms.rooms.size());
    const std::size_t arranged = leaf.rooms.piece.arranged;
    faces += arranged;
    spent[static_cast<std::size_t>(end)] += arranged;
    const Leaf& added = leaves.emplace(number, std::move(leaf)).first->second;
    struct Entry {
      int room, end;
      double way;
      Vector3d at;
    };
    std::vector<Entry> entries;
    for (std::size_t r = 0; r < added.rooms.rooms.size(); ++r) {
      for (const Opening& opening : added.rooms.rooms[r].openings) {
        const int beyond =
            added.patches[static_cast<std::size_t>(opening.patch)].beyond;
        const auto known = leaves.find(beyond);
        if (known == leaves.end()) continue;
        ForEachBeside(
            known->second, number, opening, [&](int other, const Opening& o) {
              for (const int from : {0, 1}) {
                const Reached& before =
                    known->second.reached[static_cast<std::size_t>(other)]
                                         [static_cast<std::size_t>(from)];
                if (!before.is_reached) continue;
                const Vector3d at =
                    before.at.cwiseMax(o.box.min).cwiseMin(o.box.max);
                entries.push_back({static_cast<int>(r), from,
                                   before.way + (at - before.at).norm(), at});
              }
            });
      }
    }
    for (const Entry& e : entries) Reach(number, e.room, e.end, e.way, e.at);
  }

  // The end whose turn it is.
  int Turn() const { return spent[0] <= spent[1] ? 0 : 1; }

  // The next box from an end; −1: it is enclosed.
  int Next(int end) {
    auto& queue = waiting[static_cast<std::size_t>(end)];
    while (!queue.empty() && leaves.count(queue.top().leaf) != 0) queue.pop();
    return queue.empty() ? -1 : queue.top().leaf;
  }

  ContactSpace::Parts Write(bool of_start, bool of_goal) const {
    std::vector<SurfacePiece> pieces = {
        BoxPiece(Around(sums.bounds(), kSolidShare))};
    for (const auto& entry : leaves) {
      const Leaf& leaf = entry.second;
      const auto is_reached = [&](std::size_t room) {
        return (of_start && leaf.reached[room][0].is_reached) ||
               (of_goal && leaf.reached[room][1].is_reached);
      };
      bool is_any = false;
      for (std::size_t r = 0; r < leaf.reached.size(); ++r) {
        is_any = is_any || is_reached(r);
      }
      if (!is_any) continue;
      pieces.push_back(Filtered(leaf.rooms.piece, [&](std::size_t f) {
        const auto room = static_cast<std::size_t>(leaf.rooms.room[f]);
        if (!is_reached(room) && !leaf.rooms.rooms[room].openings.empty()) {
          return false;
        }
        const int patch = leaf.rooms.patch[f];
        return patch < 0 ||
               leaves.count(
                   leaf.patches[static_cast<std::size_t>(patch)].beyond) == 0;
      }));
    }
    ContactSpace::Parts out;
    out.report.method =
        "free space explored in " + std::to_string(leaves.size()) + " boxes";
    internal::StageClock clock(&out.report);
    internal::WriteJoinedSurface(pieces, false, pair.frame, nullptr, &clock,
                                 &out);
    return out;
  }

  // Leaves out the border around the box of all sums: parts of their own.
  void DropBorder(ContactSpace::Parts* space) const {
    const BoundingBox inner = Around(sums.bounds(), kEndShare).Box();
    TriangleMesh mesh;
    std::vector<int> numbers(space->mesh.vertices.size(), -1);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < space->mesh.triangles.size(); ++t) {
      Triangle triangle = space->mesh.triangles[t];
      const Vector3d x = pair.frame.ToGrid(
          space->mesh.vertices[static_cast<std::size_t>(triangle[0])]);
      if ((x.array() < inner.min.array()).any() ||
          (x.array() > inner.max.array()).any()) {
        continue;
      }
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
    internal::DescribeSurface(space->mesh, &space->report);
  }

  const ConvolutionModel model;
  internal::BuildLimits limits;  // of this exploration
  const internal::GridPair& pair;
  internal::SolidCollision judge;
  internal::FeatureSums sums;
  GridWindow border;
  BoxPartition partition;
  std::map<int, Leaf> leaves;  // that were explored
  std::array<std::priority_queue<Waiting>, 2> waiting;
  std::array<std::size_t, 2> spent = {0, 0};  // faces
  std::array<Vector3d, 2> points, configurations;
  std::size_t faces = 0;
  bool has_met = false, was_told = false;
};

FreeSpaceFlood::FreeSpaceFlood(const ConvolutionModel& model,
                               const Vector3d& start, const Vector3d& goal)
    : impl_(std::make_unique<Impl>(model, start, goal)) {}
FreeSpaceFlood::~FreeSpaceFlood() = default;

FreeSpaceFlood::Outcome FreeSpaceFlood::Explore(std::size_t faces) {
  const bool had_met = impl_->was_told;
  const std::size_t most = impl_->faces + faces;
  for (;;) {
    if (!had_met && impl_->has_met) {
      impl_->was_told = true;
      return Outcome::kMet;
    }
    if (impl_->Next(0) < 0) return Outcome::kStartEnclosed;
    if (impl_->Next(1) < 0) return Outcome::kGoalEnclosed;
    if (impl_->faces >= most) {
      return had_met ? Outcome::kMet : Outcome::kOngoing;
    }
    const int end = impl_->Turn();
    impl_->ExploreLeaf(impl_->Next(end), end);
  }
}

const Vector3d& FreeSpaceFlood::start() const {
  return impl_->configurations[0];
}
const Vector3d& FreeSpaceFlood::goal() const {
  return impl_->configurations[1];
}

ContactSpace FreeSpaceFlood::Surface() const {
  return ContactSpace(impl_->Write(true, true), kName);
}

ContactSpace FreeSpaceFlood::EnclosingSurface() const {
  const bool is_start = impl_->Next(0) < 0;
  ContactSpace::Parts space = impl_->Write(is_start, !is_start);
  impl_->DropBorder(&space);
  return ContactSpace(std::move(space), kName);
}

std::size_t FreeSpaceFlood::boxes() const { return impl_->leaves.size(); }
std::size_t FreeSpaceFlood::faces() const { return impl_->faces; }

}  // namespace phongpd
