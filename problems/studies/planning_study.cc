// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/planning_study.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/output/versions.h"
#include "problems/studies/length_row.h"

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

bool SeeksClearance(const std::string& planner) {
  return planner == kContactSurface ||
         planner.find("retraction") != std::string::npos;
}

PlanningStudy::PlanningStudy(const Scene& scene, const ContactSpaceCache& cache)
    : scene_(scene), world_(scene.workspace, scene.name, cache) {}

PlanningStudy::PlanningStudy(const Scene& scene, const World& world)
    : scene_(scene), world_(world) {
  RequireSameSolids(scene.workspace, world, scene.name);
}

BoundingBox PlanningStudy::Region() const {
  const BoundingBox& bounds = scene_.workspace.bounds;
  return bounds.IsEmpty()
             ? SamplingRegion(world_.Sealed(), scene_.start, scene_.goal)
             : bounds;
}

TriangleMesh PlanningStudy::VisibleMesh() const {
  const BoundingBox region = Region();
  const double rounding = 1e-9 * region.Diagonal();
  const TriangleMesh& sealed = world_.Sealed().mesh();
  TriangleMesh visible;
  visible.vertices = sealed.vertices;
  for (const Triangle& t : sealed.triangles) {
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
  model_ = std::make_shared<ContactModel>(spaces().spaces, Region());
}

double PlanningStudy::WantedClearance() const {
  return scene_.planning.clearance
             ? world_.Resolve(*scene_.planning.clearance).unit
             : 0.0;
}

OmplPlanningOptions PlanningStudy::Options(const PlanningRun& run) const {
  OmplPlanningOptions options;
  options.time_limit = run.time_limit;
  options.seed = run.seed;
  options.in_passage = run.in_passage;
  options.retraction = ParseRetraction(run.retraction, "--metric");
  if (model_ != nullptr && scene_.planning.clearance) {
    // Measured by the region; where that is smaller than the wish, nothing in
    // it is farther from contact.
    options.retraction.clearance =
        std::min(1.0, WantedClearance() / model_->diagonal());
  }
  return options;
}

std::string PlanningStudy::OmplLog(const PlanningRun& run, int runs) {
  CheckHasOmplLog(run.planner);
  PrepareModel();
  return OmplBenchmarkLog(model_, scene_.start, scene_.goal, scene_.name,
                          run.planner, runs, Options(run));
}

// False: start or goal is not free, and the result says so.
bool PlanningStudy::Diagnose(const PlanningRun& run,
                             PlanningResult* result) const {
  for (const bool at_start : {true, false}) {
    const Diagnosis diagnosis =
        world_.Diagnose(at_start ? scene_.start : scene_.goal);
    if (diagnosis.IsFree()) continue;
    result->reason = diagnosis.Text(at_start ? "start" : "goal");
    // In the words of the planner, as if it had been asked.
    if (run.planner == kContactSurface) {
      result->status = ToString(at_start ? PlanStatus::kInvalidStart
                                         : PlanStatus::kInvalidGoal);
    } else {
      result->status = at_start ? "Invalid start" : "Invalid goal";
    }
    return false;
  }
  return true;
}

void PlanningStudy::RunExact(PlanningResult* result) {
  if (planner_ == nullptr) {
    planner_ = std::make_unique<ContactSurfacePlanner>(world_.Sealed());
  }
  PlanRequest request;
  request.clearance = WantedClearance();
  exact_ = planner_->Plan(scene_.start, scene_.goal, request);
  result->status = ToString(exact_.status);
  result->reason = exact_.reason;
  result->infeasible_proved = exact_.status == PlanStatus::kInfeasibleProved;
  result->numbers.path = exact_.path;
  result->numbers.length = exact_.length;
  result->numbers.clearance = exact_.clearance;
  result->numbers.segment_checks =
      static_cast<std::uint64_t>(exact_.lift.tests);
  // The first query pays for the planner's tables, too.
  result->numbers.seconds = exact_.seconds + planner_->build_seconds();
  result->numbers.collision_free =
      CheckPath(*spaces().free_space, exact_.path).free;
  result->wanted_clearance =
      world_.Resolve(Length::FromUnit(exact_.wanted_clearance));
}

void PlanningStudy::RunOmpl(const PlanningRun& run, PlanningResult* result) {
  PrepareModel();
  const OmplPlanningOptions options = Options(run);
  result->numbers =
      PlanWithOmpl(model_, scene_.start, scene_.goal, run.planner, options);
  result->status = result->numbers.status;
  if (SeeksClearance(run.planner)) {
    result->wanted_clearance = world_.Resolve(
        Length::FromUnit(options.retraction.clearance * model_->diagonal()));
  }
}

PlanningResult PlanningStudy::Run(const PlanningRun& run) {
  const std::vector<std::string> names = PlannerNames();
  if (std::find(names.begin(), names.end(), run.planner) == names.end()) {
    throw InputError("--planner: expected one of " + Join(names) + "; found '" +
                     run.planner + "'");
  }
  // Before anything is built.
  if (run.planner != kContactSurface) Options(run).Validate();
  PlanningResult result;
  if (!Diagnose(run, &result)) return result;
  if (run.planner == kContactSurface) {
    RunExact(&result);
  } else {
    RunOmpl(run, &result);
  }
  result.solved = result.numbers.collision_free && !result.numbers.path.empty();
  for (const bool at_start : {false, true}) {
    const Eigen::Vector3d& q = at_start ? scene_.start : scene_.goal;
    if (result.solved || spaces().free_space->IsFree(q)) continue;
    result.reason = BlockedByRounding(q, at_start ? "start" : "goal");
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
  row["lengths"] = {
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
  row["graph_states"] = n.graph_states;
  // 0: none was built.
  const WorldSpaces* built = study.world().Built(SpaceLayout::kSealed);
  row["contact_triangles"] = built == nullptr ? 0 : built->triangles;
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
