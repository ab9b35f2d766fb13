// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/free_space_flood.h"

#include <algorithm>
#include <array>
#include <map>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/explored_boxes.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::ExploredBoxes;
using internal::WindowRooms;

// Facets of the convolution that meet a box, about: found by trying, as are the
// next two.
constexpr std::size_t kMostFacets = 200;
// What is left of the way counts so many times as much as what is behind: 1
// would find the shortest way, and explore all that may be as short.
constexpr double kHaste = 2.0;
// So many faces to be arranged are worth a detour as long as the diagonal of
// all sums.
constexpr double kFacesPerDiagonal = 4e4;
constexpr char kName[] = "explored free space";
// Half steps: openings this far from each other may be one, rounded.
constexpr double kRounding = 1.0;

}  // namespace

// Grid steps, but for boxes of openings.
struct FreeSpaceFlood::Impl {
  using Box = ExploredBoxes::Box;
  using Opening = WindowRooms::Opening;

  // How a room was reached from an end.
  struct Reached {
    bool is_reached = false;
    double way = 0.0;                // from the end, about
    Vector3d at = Vector3d::Zero();  // where it was entered, half steps
  };
  using ReachedRooms = std::vector<std::array<Reached, 2>>;  // per end
  struct Waiting {
    double length;  // of a way through it to the other end, at least
    int box;
    bool operator<(const Waiting& o) const {
      return length != o.length ? length > o.length : box > o.box;
    }
  };

  Impl(const ConvolutionModel& model, const Vector3d& start,
       const Vector3d& goal)
      : boxes(model, kMostFacets) {
    const BoundingBox ends = boxes.Reach();
    for (const int end : {0, 1}) {
      const Vector3d& q = end == 0 ? start : goal;
      if (!model.IsFree(q)) {
        throw InputError(std::string("flood: expected a free ") +
                         (end == 0 ? "start" : "goal") + ", found none");
      }
      const Vector3d x = boxes.frame().ToGrid(q);
      points[end] = x.cwiseMax(ends.min).cwiseMin(ends.max);
      configurations[end] =
          points[end] == x ? q : boxes.frame().ToUser(points[end]);
    }
    Begin();
  }

  // Explores all boxes that come near an end, so that no wall does.
  void Begin() {
    for (const int end : {0, 1}) {
      const Vector3d& x = points[static_cast<std::size_t>(end)];
      for (const int box : boxes.In({x.array() - 1.0, x.array() + 1.0})) {
        if (boxes.Find(box) == nullptr) Explore(box, end);
        for (const int room :
             boxes.Find(box)->rooms_of_points[static_cast<std::size_t>(end)]) {
          Reach(box, room, end, 0.0, 2.0 * x);
        }
      }
    }
  }

  static bool Overlap(const BoundingBox& a, const BoundingBox& b) {
    return (a.min.array() <= b.max.array() + kRounding).all() &&
           (b.min.array() <= a.max.array() + kRounding).all();
  }
  static bool IsSame(const BoundingBox& a, const BoundingBox& b) {
    return ((a.min - b.min).array().abs() <= kRounding).all() &&
           ((a.max - b.max).array().abs() <= kRounding).all();
  }

  // Calls visit(room, opening) for what of a box goes on in `beyond` through
  // `opening`.  Both boxes cut their common wall alike; should rounding have
  // it otherwise, through what is near.
  template <typename Visit>
  static void ForEachBeside(const Box& box, int beyond, const Opening& opening,
                            const Visit& visit) {
    bool is_found = false;
    for (const bool is_exact : {true, false}) {
      for (std::size_t r = 0; !is_found && r < box.rooms.rooms.size(); ++r) {
        for (const Opening& o : box.rooms.rooms[r].openings) {
          const auto patch = static_cast<std::size_t>(o.patch);
          if (box.patches[patch].beyond != beyond ||
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
  void Reach(int box, int room, int end, double way, const Vector3d& at) {
    struct Step {
      int box, room;
      double way;
      Vector3d at;
    };
    std::vector<Step> open = {{box, room, way, at}};
    while (!open.empty()) {
      const Step step = open.back();
      open.pop_back();
      const Box& in = *boxes.Find(step.box);
      auto& ends = reached.at(step.box)[static_cast<std::size_t>(step.room)];
      if (ends[static_cast<std::size_t>(end)].is_reached) continue;
      ends[static_cast<std::size_t>(end)] = {true, step.way, step.at};
      has_met = has_met || ends[static_cast<std::size_t>(1 - end)].is_reached;
      for (const Opening& opening :
           in.rooms.rooms[static_cast<std::size_t>(step.room)].openings) {
        const int beyond =
            in.patches[static_cast<std::size_t>(opening.patch)].beyond;
        if (beyond < 0) continue;
        const Vector3d next =
            step.at.cwiseMax(opening.box.min).cwiseMin(opening.box.max);
        const double way_there =
            step.way + (next - step.at).norm() + CostOf(in);
        const Box* known = boxes.Find(beyond);
        if (known == nullptr) {
          Wait(beyond, end, way_there, next);
          continue;
        }
        ForEachBeside(*known, step.box, opening,
                      [&](int other, const Opening&) {
                        open.push_back({beyond, other, way_there, next});
                      });
      }
    }
  }

  // How long a detour it is worth to have gone through a box.
  double CostOf(const Box& box) const {
    return 2.0 * boxes.bounds().Diagonal() *
           static_cast<double>(box.rooms.piece.arranged) / kFacesPerDiagonal;
  }

  void Wait(int box, int end, double way, const Vector3d& at) {
    const Vector3d& other = points[static_cast<std::size_t>(1 - end)];
    waiting[static_cast<std::size_t>(end)].push(
        {way + kHaste * (2.0 * other - at).norm(), box});
  }

  // Arranges a box and reaches what of it is beside rooms that were reached.
  void Explore(int number, int end) {
    const Box& added = boxes.Explore(number, points);
    reached[number].resize(added.rooms.rooms.size());
    spent[static_cast<std::size_t>(end)] += added.rooms.piece.arranged;
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
        const Box* known = boxes.Find(beyond);
        if (known == nullptr) continue;
        ForEachBeside(
            *known, number, opening, [&](int other, const Opening& o) {
              for (const int from : {0, 1}) {
                const Reached& before =
                    reached.at(beyond)[static_cast<std::size_t>(other)]
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
    while (!queue.empty() && boxes.Find(queue.top().box) != nullptr) {
      queue.pop();
    }
    return queue.empty() ? -1 : queue.top().box;
  }

  ContactSpace::Parts Surface(bool of_start, bool of_goal) const {
    const auto is_reached = [&](const std::array<Reached, 2>& room) {
      return (of_start && room[0].is_reached) ||
             (of_goal && room[1].is_reached);
    };
    std::vector<int> all;
    for (const auto& box : boxes.explored()) all.push_back(box.first);
    return boxes.Surface(all, [&](int box, int room) {
      const auto& rooms = reached.at(box);
      if (is_reached(rooms[static_cast<std::size_t>(room)])) return true;
      // Cavities, where anything is.
      return boxes.Find(box)
                 ->rooms.rooms[static_cast<std::size_t>(room)]
                 .openings.empty() &&
             std::any_of(rooms.begin(), rooms.end(), is_reached);
    });
  }

  internal::ExploredBoxes boxes;
  std::map<int, ReachedRooms> reached;  // of each box, per room
  std::array<std::priority_queue<Waiting>, 2> waiting;
  std::array<std::size_t, 2> spent = {0, 0};                // faces
  std::vector<Vector3d> points = std::vector<Vector3d>(2);  // the ends
  std::array<Vector3d, 2> configurations;
  bool has_met = false, was_told = false;
};

FreeSpaceFlood::FreeSpaceFlood(const ConvolutionModel& model,
                               const Vector3d& start, const Vector3d& goal)
    : impl_(std::make_unique<Impl>(model, start, goal)) {}
FreeSpaceFlood::~FreeSpaceFlood() = default;

FreeSpaceFlood::Outcome FreeSpaceFlood::Explore(std::size_t faces) {
  const bool had_met = impl_->was_told;
  const std::size_t most = impl_->boxes.faces() + faces;
  for (;;) {
    if (!had_met && impl_->has_met) {
      impl_->was_told = true;
      return Outcome::kMet;
    }
    if (impl_->Next(0) < 0) return Outcome::kStartEnclosed;
    if (impl_->Next(1) < 0) return Outcome::kGoalEnclosed;
    if (impl_->boxes.faces() >= most) {
      return had_met ? Outcome::kMet : Outcome::kOngoing;
    }
    const int end = impl_->Turn();
    impl_->Explore(impl_->Next(end), end);
  }
}

const Vector3d& FreeSpaceFlood::start() const {
  return impl_->configurations[0];
}
const Vector3d& FreeSpaceFlood::goal() const {
  return impl_->configurations[1];
}

ExploredSpace FreeSpaceFlood::Surface() const {
  return ExploredSpace(impl_->Surface(true, true), kName);
}

ExploredSpace FreeSpaceFlood::EnclosingSurface() const {
  const bool is_start = impl_->Next(0) < 0;
  ContactSpace::Parts space = impl_->Surface(is_start, !is_start);
  internal::DropWalls(&space);
  return ExploredSpace(std::move(space), kName);
}

std::size_t FreeSpaceFlood::boxes() const {
  return impl_->boxes.explored().size();
}
std::size_t FreeSpaceFlood::faces() const { return impl_->boxes.faces(); }

}  // namespace phongpd
