// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/planning_study.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/output/versions.h"

namespace phongpd {
namespace {

constexpr char kContactSurface[] = "contact-surface";

std::string Join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

}  // namespace

std::vector<std::string> PlannerNames() {
  std::vector<std::string> names = {kContactSurface};
  const std::vector<std::string>& ompl = OmplPlannerNames();
  names.insert(names.end(), ompl.begin(), ompl.end());
  return names;
}

const std::vector<std::string>& RetractionNames() {
  static const std::vector<std::string> names = {
      "phong",         "phong-random", "phong-novelty", "phong-warm",
      "phong-nearest", "euclidean",    "contact-point"};
  return names;
}

RetractionOptions ParseRetraction(const std::string& text,
                                  const std::string& what) {
  RetractionOptions options;
  const std::vector<std::string>& names = RetractionNames();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw InputError(what + ": expected one of " + Join(names) + "; found '" +
                     text + "'");
  }
  const std::ptrdiff_t index = found - names.begin();
  constexpr BranchChoice kChoices[] = {
      BranchChoice::kAll, BranchChoice::kRandom, BranchChoice::kNovelty,
      BranchChoice::kWarm, BranchChoice::kNearest};
  if (index < 5) options.choice = kChoices[index];
  if (text == "euclidean") options.metric = RetractionMetric::kEuclidean;
  if (text == "contact-point") {
    options.metric = RetractionMetric::kContactPoint;
  }
  return options;
}

void CheckHasOmplLog(const std::string& planner) {
  if (planner != kContactSurface) return;
  throw InputError("--ompl-log: expected a planner of OMPL, found " + planner);
}

PlanningStudy::PlanningStudy(const Scene& scene, const ContactSpaceCache& cache)
    : scene_(scene),
      space_(BuildSceneSpace(scene, SpaceLayout::kSealed, cache)) {}

BoundingBox PlanningStudy::Region() const {
  const BoundingBox& bounds = scene_.workspace.bounds;
  return bounds.IsEmpty()
             ? SamplingRegion(*space_.sealed, scene_.start, scene_.goal)
             : bounds;
}

TriangleMesh PlanningStudy::VisibleMesh() const {
  const BoundingBox region = Region();
  const double rounding = 1e-9 * region.Diagonal();
  TriangleMesh visible;
  visible.vertices = space_.sealed->mesh().vertices;
  for (const Triangle& t : space_.sealed->mesh().triangles) {
    const bool is_within = std::all_of(t.begin(), t.end(), [&](int v) {
      const Eigen::Vector3d& p = visible.vertices[v];
      return (p.array() >= region.min.array() - rounding).all() &&
             (p.array() <= region.max.array() + rounding).all();
    });
    if (is_within) visible.triangles.push_back(t);
  }
  return visible;
}

void PlanningStudy::PrepareModel() {
  if (model_ != nullptr) return;
  // The bounds are part of the mesh; what is beyond them need not be sampled.
  model_ = std::make_shared<ContactModel>(space_.contact_spaces, Region());
}

OmplPlanningOptions PlanningStudy::Options(const PlanningRun& run) const {
  OmplPlanningOptions options;
  options.time_limit = run.time_limit;
  options.seed = run.seed;
  options.in_passage = run.in_passage;
  options.retraction = ParseRetraction(run.retraction, "--metric");
  options.retraction.clearance = scene_.planning.clearance;
  return options;
}

std::string PlanningStudy::OmplLog(const PlanningRun& run, int runs) {
  CheckHasOmplLog(run.planner);
  PrepareModel();
  return OmplBenchmarkLog(model_, scene_.start, scene_.goal, scene_.name,
                          run.planner, runs, Options(run));
}

PlanningResult PlanningStudy::Run(const PlanningRun& run) {
  PlanningResult result;
  if (run.planner == kContactSurface) {
    if (planner_ == nullptr) {
      ContactSurfaceOptions options;
      options.clearance = scene_.planning.clearance;
      planner_ =
          std::make_unique<ContactSurfacePlanner>(*space_.sealed, options);
    }
    exact_ = planner_->Plan(scene_.start, scene_.goal);
    result.status = ToString(exact_.status);
    result.reason = exact_.reason;
    result.infeasible_proved = exact_.status == PlanStatus::kInfeasibleProved;
    result.numbers.path = exact_.path;
    result.numbers.length = exact_.length;
    result.numbers.clearance = exact_.clearance;
    result.numbers.segment_checks =
        static_cast<std::uint64_t>(exact_.lift.tests);
    // The first query pays for the planner's tables, too.
    result.numbers.seconds = exact_.seconds + planner_->build_seconds();
    result.numbers.collision_free =
        CheckPath(*space_.free_space, exact_.path).free;
  } else {
    PrepareModel();
    result.numbers = PlanWithOmpl(model_, scene_.start, scene_.goal,
                                  run.planner, Options(run));
    result.status = result.numbers.status;
  }
  result.solved = result.numbers.collision_free && !result.numbers.path.empty();
  if (!result.solved) {
    for (const bool at_start : {false, true}) {
      const Eigen::Vector3d& q = at_start ? scene_.start : scene_.goal;
      if (space_.free_space->IsFree(q)) continue;
      result.reason =
          EndInCollision(scene_, space_, q, at_start ? "start" : "goal");
    }
  }
  return result;
}

nlohmann::ordered_json PlanningRow(const PlanningStudy& study,
                                   const PlanningRun& run,
                                   const PlanningResult& result) {
  using Json = nlohmann::ordered_json;
  const OmplPlanningResult& n = result.numbers;
  Json row;
  row["scene"] = study.scene().name;
  row["planner"] = run.planner;
  row["metric"] = run.planner.find("retraction") == std::string::npos
                      ? Json(nullptr)
                      : Json(run.retraction);
  row["seed"] = run.seed;
  row["status"] = result.status;
  row["reason"] = result.reason;
  row["solved"] = result.solved;
  row["infeasible_proved"] = result.infeasible_proved;
  row["collision_free"] = n.collision_free;
  row["clearance"] = n.clearance;
  row["seconds"] = {{"contact_space", study.space().seconds},
                    {"solve", n.seconds}};
  row["checks"] = {{"collision", n.collision_checks},
                   {"segment", n.segment_checks}};
  row["samples"] = n.samples;
  row["retractions"] = n.retractions;
  row["branch_ends"] = n.branch_ends;
  row["graph_states"] = n.graph_states;
  row["contact_triangles"] = study.space().triangles;
  row["path_length"] = n.length;
  row["path"] = Json::array();
  for (const Eigen::Vector3d& p : n.path) {
    row["path"].push_back({p.x(), p.y(), p.z()});
  }
  row["versions"] = Json::object();
  for (const auto& [name, version] : Versions())
    row["versions"][name] = version;
  return row;
}

}  // namespace phongpd
