// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view_entries.h"

#include <nlohmann/json.hpp>

#include "viewer/page_numbers.h"

namespace phongpd {
namespace {

using internal::PointJson;
using internal::PointsJson;
using internal::TurnJson;
using EntryJson = nlohmann::ordered_json;

EntryJson TurnsJson(const std::vector<Eigen::Quaterniond>& turns) {
  if (turns.empty()) return nullptr;
  EntryJson json = EntryJson::array();
  for (const Eigen::Quaterniond& turn : turns) json.push_back(TurnJson(turn));
  return json;
}

EntryJson PaceJson(const ViewPace& pace) {
  if (!(pace.duration > 0.0)) return nullptr;
  return {{"duration", pace.duration},
          {"velocity", pace.velocity},
          {"acceleration", pace.acceleration},
          {"jerk", pace.jerk},
          {"clearance", pace.clearance}};
}

}  // namespace

nlohmann::ordered_json PathEntry(const NamedPath& path) {
  return {{"name", path.name},
          {"free", path.is_free},
          {"points", PointsJson(path.points)},
          {"turns", TurnsJson(path.turns)},
          {"pace", PaceJson(path.pace)},
          {"robot", nullptr}};
}

nlohmann::ordered_json MoverEntries(const std::vector<ViewMover>& movers) {
  EntryJson json = EntryJson::array();
  for (const ViewMover& one : movers) {
    json.push_back({{"name", one.name}, {"points", PointsJson(one.points)}});
  }
  return json;
}

nlohmann::ordered_json AnswerEntry(const ViewAnswer& answer) {
  const bool has = answer.has_witness;
  return {{"position", PointJson(answer.position)},
          {"orientation", TurnJson(answer.orientation)},
          {"status", answer.status},
          {"depth", answer.depth},
          {"clearance", answer.clearance},
          {"direction", PointJson(answer.direction)},
          {"on_a", has ? PointJson(answer.on_robot) : EntryJson(nullptr)},
          {"on_b", has ? PointJson(answer.on_obstacle) : EntryJson(nullptr)}};
}

}  // namespace phongpd
