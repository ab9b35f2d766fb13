// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "problems/studies/planning_study.h"
#include "problems/studies/row_parts.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json PlanningRow(const PlanningStudy& study, const PlanningRun& run,
                 const PlanningResult& result) {
  const OmplPlanningResult& n = result.numbers;
  Json row;
  row["scene"] = study.scene().name;
  row["planner"] = result.planner;
  row["model"] = result.model;
  row["metric"] = result.planner.find("retraction") == std::string::npos
                      ? Json(nullptr)
                      : Json(run.retraction);
  row["preset"] = nullptr;
  row["routes"] = nullptr;
  row["spacing"] = nullptr;
  row["gap_links"] = nullptr;
  // Samplers have nothing that a preset sets.
  if (result.surface) {
    row["preset"] = ToString(study.scene().preset);
    row["routes"] = result.surface->routes;
    row["spacing"] = result.surface->spacing;
    row["gap_links"] = result.surface->gap_links;
  }
  row["seed"] = run.seed;
  row["status"] = result.status;
  row["sampler_status"] = n.status.empty() ? Json(nullptr) : Json(n.status);
  row["reason"] = result.reason;
  row["solved"] = result.solved;
  row["infeasible_proved"] = result.infeasible_proved;
  row["collision_free"] = n.collision_free;
  row["clearance"] = n.clearance;
  row["lengths"] = {
      {"unit", UnitRow(study.scene().unit)},
      {"D", study.world().diagonal()},
      {"wanted_clearance", LengthRow(result.wanted_clearance)},
      {"clearance",
       LengthRow(study.world().Resolve(Length::FromUnit(n.clearance)))}};
  row["seconds"] = {{"contact_space", study.world().Report().seconds},
                    {"solve", n.seconds}};
  row["checks"] = {{"collision", n.collision_checks},
                   {"segment", n.segment_checks}};
  row["samples"] = n.samples;
  row["retractions"] = n.retractions;
  row["branch_ends"] = n.branch_ends;
  row["graph_states"] = n.graph.points.size();
  // 0: none was built.
  const WorldSpaces* built = study.world().Built(SpaceLayout::kSealed);
  row["contact_triangles"] = built == nullptr ? 0 : built->triangles;
  row["explored_boxes"] = nullptr;
  row["explored_faces"] = nullptr;
  if (result.explored) {
    row["explored_boxes"] = result.explored->boxes;
    row["explored_faces"] = result.explored->faces;
  }
  row["path_length"] = n.length;
  row["path"] = Json::array();
  for (const Eigen::Vector3d& p : n.path) {
    row["path"].push_back(PointRow(p));
  }
  row["versions"] = VersionsRow();
  return row;
}

}  // namespace phongpd
