// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/answer_row.h"

#include <nlohmann/json.hpp>
#include <string>

#include "planners/retraction/retraction_names.h"
#include "planners/world/room.h"
#include "problems/output/row_parts.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

Json PathRow(const Path& path) {
  Json row = Json::array();
  for (const Vector3d& p : path) row.push_back(PointRow(p));
  return row;
}

const char* ModelUsed(const PathAnswer& answer) {
  return answer.evidence.model ? ToString(*answer.evidence.model) : "none";
}

Json LengthOf(const World& world, double unit) {
  return LengthRow(world.Resolve(Length::FromUnit(unit)));
}

// Of what was built; 0: nothing.
std::size_t TrianglesOf(const World& world, SpaceLayout layout) {
  const WorldSpaces* built = world.Built(layout);
  return built == nullptr ? 0 : built->triangles;
}

// What all rows end with: versions, the second judgement, and what was asked,
// kept and possible.
void AddEvidence(const World& world, const Vector3d& start,
                 const Vector3d& goal, const PathAnswer& answer, Json* row) {
  (*row)["versions"] = VersionsRow();
  const PathEvidence& evidence = answer.evidence;
  (*row)["verified"] = evidence.verification
                           ? Json(ToString(evidence.verification->verdict))
                           : Json(nullptr);
  (*row)["seconds"]["verification"] = evidence.verification_seconds;
  Json& lengths = row->at("lengths");
  lengths["asked_clearance"] = LengthRow(answer.wish.asked);
  lengths["start_room"] = LengthOf(world, Room(world.workspace(), start));
  lengths["goal_room"] = LengthOf(world, Room(world.workspace(), goal));
  (*row)["clearance_shortfall"] =
      answer.wish.shortfall ? Json(*answer.wish.shortfall) : Json(nullptr);
}

// Of contact-surface; samplers have nothing that a preset sets.
void AddSurface(const PlanRequest& request, const PlanWork& work, Json* row) {
  for (const char* key : {"preset", "routes", "spacing", "gap_links"}) {
    (*row)[key] = nullptr;
  }
  if (!work.surface) return;
  (*row)["preset"] = ToString(request.preset);
  (*row)["routes"] = work.surface->routes;
  (*row)["spacing"] = work.surface->spacing;
  (*row)["gap_links"] = work.surface->gap_links;
}

// null where the path is free.
Json CrossingRow(const PathCheck& check) {
  if (check.free || check.segment < 0) return nullptr;
  return {{"segment", check.segment}, {"fraction", check.motion.fraction}};
}

const char* ToString(PolishWhen polish) {
  return polish == PolishWhen::kNever    ? "never"
         : polish == PolishWhen::kAlways ? "always"
                                         : "needed";
}

const char* ToString(TrajectoryStart start) {
  return start == TrajectoryStart::kStraight ? "straight" : "repaired";
}

Json StagesRow(const std::vector<StageRecord>& stages) {
  Json row = Json::array();
  for (const StageRecord& stage : stages) {
    row.push_back({{"stage", stage.stage},
                   {"route", stage.route},
                   {"status", stage.status},
                   {"collision_free", stage.is_free},
                   {"objective", stage.objective},
                   {"iterations", stage.iterations},
                   {"seconds", stage.seconds}});
  }
  return row;
}

// In free space alone there is nothing to follow.
bool HasNoMetric(const PathAnswer& answer) {
  return answer.evidence.model == Model::kWindow && !answer.windows;
}

// What the optimiser followed.  Returns its smoothing length as rows have
// lengths.
Json AddMetric(const World& world, const OptimizeRequest& request,
               const PathAnswer& answer, Json* row) {
  const bool is_window = HasNoMetric(answer);
  const PenetrationSpec& spec = request.penetration;
  const bool is_phong = spec.metric == MetricKind::kPhong;
  std::optional<ResolvedLength> smoothing;
  if (!is_window && HasLength(spec.metric)) {
    smoothing = world.Resolve(spec.smoothing_length);
  }
  const std::string jacobian =
      is_phong ? ToString(spec.jacobian) : ToString(JacobianKind::kDirection);
  (*row)["metric"] = is_window            ? "none"
                     : request.own_metric ? request.own_metric->kind
                                          : ToString(spec.metric);
  (*row)["method"] = MethodName(request, answer);
  (*row)["smoothing_length"] =
      smoothing ? Json(smoothing->share) : Json(nullptr);
  (*row)["jacobian"] = is_window ? "none" : jacobian;
  return LengthRow(smoothing);
}

// Settings of the pipeline.
void AddOptions(const OptimizeRequest& request, bool has_run, Json* row) {
  const PipelineOptions& options = request.options;
  (*row)["policy"] = "commit";  // the only one: see results/retired.md
  (*row)["start"] = ToString(options.start);
  (*row)["start_noise"] = options.start_noise;
  (*row)["mu_strategy"] = options.optimizer.ipopt.mu_strategy ==
                                  IpoptSettings::MuStrategy::kAdaptive
                              ? "adaptive"
                              : "monotone";
  (*row)["preset"] = ToString(request.preset);
  (*row)["routes"] = options.routes;
  (*row)["also_line"] = options.also_line;
  (*row)["polish"] = ToString(options.polish);
  (*row)["rows"] = has_run ? options.optimizer.rows : 0;
  (*row)["seed"] = options.seed;
}

void AddSolver(const TrajectorySummary& ipopt, Json* row) {
  (*row)["evaluations"] = {{"objective", ipopt.evaluations.objective},
                           {"gradient", ipopt.evaluations.gradient},
                           {"constraints", ipopt.evaluations.constraints},
                           {"jacobian", ipopt.evaluations.jacobian},
                           {"hessian", ipopt.evaluations.hessian}};
}

Json LimitsRow(const MotionLimits& limits) {
  return {{"velocity", PointRow(limits.velocity)},
          {"acceleration", PointRow(limits.acceleration)},
          {"jerk", PointRow(limits.jerk)},
          {"by", limits.by_norm ? "norm" : "axis"}};
}

Json EndRow(const CurveEnd& end) {
  return {{"velocity", PointRow(end.velocity)},
          {"acceleration", PointRow(end.acceleration)}};
}

Json ViaRow(const World& world, const std::vector<Via>& places) {
  Json row = Json::array();
  for (const Via& via : places) {
    row.push_back(
        {{"point", PointRow(via.point)},
         {"tolerance", LengthOf(world, world.Resolve(via.tolerance).unit)},
         {"dwell", via.dwell}});
  }
  return row;
}

Json MovingRow(const std::vector<MovingObstacle>& moving) {
  Json names = Json::array();
  for (const MovingObstacle& one : moving) names.push_back(one.solid.name());
  return names;
}

Json PiecesRow(const Trajectory& trajectory) {
  Json pieces = Json::array();
  for (const CurvePiece& piece : trajectory.pieces()) {
    Json points = Json::array();
    for (int i = 0; i <= piece.degree(); ++i) {
      points.push_back(PointRow(piece.point(i)));
    }
    pieces.push_back({{"duration", piece.duration()}, {"points", points}});
  }
  return pieces;
}

// How Ipopt ended, and what the exact judge says of its path.
void AddOutcome(const PathAnswer& answer, bool has_run, Json* row) {
  const TrajectorySummary& ipopt = answer.pipeline->ipopt;
  (*row)["status"] = has_run ? ipopt.raw_status : std::string();
  (*row)["solver_class"] = has_run ? ToString(ipopt.status) : "not_run";
  (*row)["status_class"] = ToString(answer.status);
  (*row)["reason"] = answer.reason;
  (*row)["solved"] = answer.is_solved;
  (*row)["solver_claims_solved"] = has_run && IsClassOk(ipopt.status);
  (*row)["solver_path_free"] = has_run && ipopt.collision_free &&
                               answer.status != PathStatus::kVerificationFailed;
  (*row)["collision_free"] = answer.is_free;
  (*row)["first_crossing"] = CrossingRow(answer.pipeline->certificate);
}

}  // namespace

std::string MethodName(const OptimizeRequest& request,
                       const PathAnswer& answer) {
  if (HasNoMetric(answer)) return "corridor";
  return request.own_metric ? request.own_metric->name
                            : request.penetration.Name();
}

std::string MethodTitle(const OptimizeRequest& request,
                        const PathAnswer& answer) {
  const bool is_ours = !HasNoMetric(answer) && !request.own_metric;
  return is_ours ? request.penetration.Title() : MethodName(request, answer);
}

Json PlanRow(const Scene& scene, const World& world, const PlanRequest& request,
             const PathAnswer& answer) {
  const PlanWork& work = *answer.plan;
  const OmplPlanningResult& search = work.search;
  Json row;
  row["scene"] = scene.name;
  row["planner"] = ToString(work.planner);
  row["model"] = ModelUsed(answer);
  row["metric"] = Retracts(work.planner)
                      ? Json(RetractionName(request.retraction))
                      : Json(nullptr);
  AddSurface(request, work, &row);
  row["seed"] = request.seed;
  row["status"] = ToString(answer.status);
  row["sampler_status"] =
      search.status.empty() ? Json(nullptr) : Json(search.status);
  row["reason"] = answer.reason;
  row["solved"] = answer.is_solved;
  row["infeasible_proved"] = answer.IsInfeasible();
  row["collision_free"] = answer.is_free;
  row["clearance"] = answer.clearance;
  row["lengths"] = {{"unit", UnitRow(scene.workspace.unit)},
                    {"D", world.diagonal()},
                    {"wanted_clearance", LengthRow(work.wanted_clearance)},
                    {"clearance", LengthOf(world, answer.clearance)}};
  row["seconds"] = {{"contact_space", world.Report().seconds},
                    {"solve", answer.seconds}};
  row["checks"] = {{"collision", search.collision_checks},
                   {"segment", search.segment_checks}};
  row["samples"] = search.samples;
  row["retractions"] = search.retractions;
  row["branch_ends"] = search.branch_ends;
  row["graph_states"] = search.graph.points.size();
  row["contact_triangles"] = TrianglesOf(world, SpaceLayout::kSealed);
  const auto counted = [](const std::optional<std::size_t>& count) {
    return count ? Json(*count) : Json(nullptr);
  };
  row["explored_boxes"] = counted(work.explored_boxes);
  row["explored_faces"] = counted(work.explored_faces);
  row["path_length"] = answer.length;
  row["path"] = PathRow(answer.path);
  AddEvidence(world, request.start, request.goal, answer, &row);
  return row;
}

Json PolylineRow(const Scene& scene, const World& world,
                 const OptimizeRequest& request, const PathAnswer& answer) {
  const PipelineResult& result = *answer.pipeline;
  const TrajectorySummary& ipopt = result.ipopt;
  const bool has_run = !ipopt.path.empty();
  Json row;
  row["scene"] = scene.name;
  row["model"] = ModelUsed(answer);
  const Json smoothing = AddMetric(world, request, answer, &row);
  if (answer.windows) {
    row["windows"] = {{"boxes", answer.windows->boxes},
                      {"faces", answer.windows->faces},
                      {"inside", answer.windows->inside},
                      {"extensions", answer.windows->extensions},
                      {"seconds", answer.windows->seconds}};
  }
  AddOptions(request, has_run, &row);
  AddOutcome(answer, has_run, &row);
  row["iterations"] = result.iterations;
  row["restoration_iterations"] = result.restoration_iterations;
  AddSolver(ipopt, &row);
  row["objective"] = result.objective;
  row["inf_pr"] = ipopt.violation;
  row["inf_du"] = ipopt.dual_infeasibility;
  // Smallest distance along the path, in the user's unit.
  row["clearance"] = answer.clearance;
  row["lengths"] = {{"unit", UnitRow(scene.workspace.unit)},
                    {"D", world.diagonal()},
                    {"smoothing_length", smoothing},
                    {"margin", LengthRow(world.Resolve(request.Margin()))},
                    {"clearance", LengthOf(world, answer.clearance)}};
  row["missing_clearance"] = result.missing_clearance;
  row["rounds"] = ipopt.rounds;
  row["queries"] = {{"cold", ipopt.queries.cold},
                    {"warm", ipopt.queries.warm},
                    {"branch_ends", ipopt.queries.branch_ends},
                    {"branch_changes", ipopt.queries.branch_changes}};
  row["stages"] = StagesRow(result.stages);
  row["contact_triangles"] =
      TrianglesOf(world, request.is_per_obstacle ? SpaceLayout::kPerObstacle
                                                 : SpaceLayout::kMerged);
  row["seconds"] = {{"contact_space", world.Report().seconds},
                    {"repair", result.repair.seconds},
                    {"callbacks", result.seconds_callbacks},
                    {"total", result.seconds}};
  row["path"] = PathRow(answer.path);
  AddEvidence(world, request.start, request.goal, answer, &row);
  return row;
}

Json MotionRow(const Scene& scene, const World& world,
               const OptimizeRequest& request, const PathAnswer& answer) {
  // None of a robot of several that was not come to.
  const CurveSummary curve = answer.curve.value_or(CurveSummary());
  const LimitUse& use = answer.evidence.use;
  Json row;
  row["scene"] = scene.name;
  row["planner"] =
      answer.plan ? Json(ToString(answer.plan->planner)) : Json(nullptr);
  row["model"] = ModelUsed(answer);
  row["preset"] = ToString(request.preset);
  row["status"] = ToString(answer.status);
  row["reason"] = answer.reason;
  row["solved"] = answer.is_solved;
  row["certified"] = answer.is_free;
  row["collision_free"] = answer.is_free;
  row["duration"] = answer.motion.duration();
  row["asked_duration"] =
      request.duration > 0.0 ? Json(request.duration) : Json(nullptr);
  row["stops_duration"] = curve.stops_duration;
  row["length"] = answer.length;
  row["limits"] = LimitsRow(*request.limits);
  row["via"] = ViaRow(world, request.via);
  row["departure"] = EndRow(request.departure);
  row["arrival"] = EndRow(request.arrival);
  if (!request.moving.empty()) row["moving"] = MovingRow(request.moving);
  row["limits_used"] = {{"velocity", use.velocity},
                        {"acceleration", use.acceleration},
                        {"jerk", use.jerk}};
  row["clearance"] = curve.clearance;
  row["lengths"] = {
      {"unit", UnitRow(scene.workspace.unit)},
      {"D", world.diagonal()},
      {"margin", LengthOf(world, world.Resolve(request.Margin()).unit)},
      {"kept_margin", LengthOf(world, curve.margin)},
      {"clearance", LengthOf(world, curve.clearance)}};
  row["rounds"] = curve.rounds.size();
  row["routes"] = answer.routes;
  row["seconds"] = {{"contact_space", world.Report().seconds},
                    {"plan", answer.seconds - curve.seconds},
                    {"first", curve.first_seconds},
                    {"curve", curve.seconds}};
  row["path"] = PathRow(answer.path);
  row["pieces"] = PiecesRow(answer.motion);
  AddEvidence(world, request.start, request.goal, answer, &row);
  return row;
}

}  // namespace phongpd
