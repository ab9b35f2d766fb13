// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/clearance_wish.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "planners/world/room.h"
#include "problems/output/text.h"
#include "problems/studies/row_parts.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// Of what is asked: solvers keep their constraints to within so much.
constexpr double kTolerance = 1e-6;

std::string Told(const Scene& scene, double length) {
  return Rounded(length, 4) + (scene.unit.empty() ? "unit" : scene.unit);
}

const char* StatusKey(const Json& row) {
  return row.contains("status_class") ? "status_class" : "status";
}

}  // namespace

ClearanceWish WishOfPlan(const Scene& scene, bool is_required) {
  const bool is_own = scene.planning.clearance.has_value();
  return {"clearance", scene.planning.clearance, is_own, is_required};
}

ClearanceWish WishOfTrajectory(const Scene& scene, bool is_flag,
                               bool is_required) {
  const Length& margin = scene.trajectory.margin;
  const bool is_own = is_flag || margin != TrajectorySettings().margin;
  return {"margin", margin, is_own, is_required};
}

std::string BeyondTheEnds(const World& world, const Scene& scene,
                          const ClearanceWish& wish) {
  if (!wish.asked || !(wish.is_own || wish.is_required)) return "";
  const double asked = world.Resolve(*wish.asked).unit;
  const double start = Room(world.workspace(), scene.start);
  const double goal = Room(world.workspace(), scene.goal);
  // Ends that are not free are told of by themselves.
  if (!(start > 0.0 && goal > 0.0)) return "";
  if (std::min(start, goal) >= (1.0 - kTolerance) * asked) return "";
  return "no path keeps the " + wish.name + " of " + Told(scene, asked) +
         ": the start has " + Told(scene, start) + ", the goal " +
         Told(scene, goal);
}

void TellClearance(const World& world, const Scene& scene,
                   const ClearanceWish& wish, Json* row) {
  Json& lengths = row->at("lengths");
  std::optional<ResolvedLength> asked, start, goal;
  if (wish.asked) asked = world.Resolve(*wish.asked);
  const auto room = [&](const Eigen::Vector3d& q) {
    return world.Resolve(Length::FromUnit(Room(world.workspace(), q)));
  };
  start = room(scene.start);
  goal = room(scene.goal);
  lengths["asked_clearance"] = LengthRow(asked);
  lengths["start_room"] = LengthRow(start);
  lengths["goal_room"] = LengthRow(goal);
  (*row)["clearance_shortfall"] = nullptr;
  if (!asked || !row->at("collision_free").get<bool>()) return;
  const double kept = row->at("clearance").get<double>();
  const double shortfall = asked->unit - kept;
  const bool is_kept = shortfall <= kTolerance * asked->unit;
  (*row)["clearance_shortfall"] = is_kept ? 0.0 : shortfall;
  if (is_kept || !(wish.is_own || wish.is_required)) return;
  std::string reason = row->at("reason").get<std::string>();
  if (!reason.empty()) reason += "; ";
  (*row)["reason"] =
      reason + "the path keeps " + Told(scene, kept) + " of the " + wish.name +
      " of " + Told(scene, asked->unit) + "; the start has " +
      Told(scene, start->unit) + ", the goal " + Told(scene, goal->unit);
  if (!wish.is_required) return;
  (*row)[StatusKey(*row)] = kClearanceMissed;
  (*row)["solved"] = false;
}

bool IsClearanceMissed(const Json& row) {
  return row.at(StatusKey(row)) == kClearanceMissed;
}

}  // namespace phongpd
