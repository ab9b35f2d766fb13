// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "problems/studies/row_parts.h"
#include "problems/studies/trajectory_study.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

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

Json StageRow(const StageRecord& stage) {
  return {{"stage", stage.stage},         {"route", stage.route},
          {"status", stage.status},       {"collision_free", stage.is_free},
          {"objective", stage.objective}, {"iterations", stage.iterations},
          {"seconds", stage.seconds}};
}

}  // namespace

Json TrajectoryRow(const TrajectoryStudy& study, const TrajectoryMetric& metric,
                   const PipelineOptions& options,
                   const PipelineResult& result) {
  const bool is_phong = metric.options.metric == MetricKind::kPhong;
  const bool is_exact = metric.options.jacobian == JacobianKind::kExact;
  const TrajectorySummary& ipopt = result.ipopt;
  const bool has_run = !ipopt.path.empty();
  // In a fair comparison of solvers what counts is Ipopt's own class; with a
  // corridor behind it, the pipeline's.
  const bool is_solved =
      HasFreePath(result.status) &&
      (ipopt.IsSolved() || result.status != TrajectoryStatus::kStalledFeasible);
  Json row;
  row["scene"] = study.scene().name;
  row["model"] = study.model();
  // In free space alone there is none to follow.
  const bool has_metric = study.model() != "window";
  row["metric"] = !has_metric   ? "none"
                  : metric.make ? metric.kind
                  : is_phong    ? "phong"
                                : "euclidean";
  row["method"] = has_metric ? metric.name : "corridor";
  const World& world = study.world();
  const std::optional<ResolvedLength> of_metric = study.SmoothingLength(metric);
  row["smoothing_length"] = nullptr;
  Json smoothing = LengthRow({});
  if (has_metric && of_metric) {
    row["smoothing_length"] = of_metric->share;
    smoothing = LengthRow(of_metric);
  }
  row["jacobian"] = !has_metric ? "none" : is_exact ? "exact" : "direction";
  row["policy"] = "commit";  // the only one: see results/retired.md
  row["start"] = ToString(options.start);
  row["start_noise"] = options.start_noise;
  row["mu_strategy"] = options.optimizer.ipopt.mu_strategy ==
                               IpoptSettings::MuStrategy::kAdaptive
                           ? "adaptive"
                           : "monotone";
  row["preset"] = ToString(study.scene().preset);
  row["routes"] = options.routes;
  row["also_line"] = options.also_line;
  row["polish"] = ToString(options.polish);
  row["rows"] = has_run ? options.optimizer.rows : 0;
  row["seed"] = options.seed;
  row["status"] = has_run ? ipopt.raw_status : std::string();
  row["solver_class"] = has_run ? ToString(ipopt.status) : "not_run";
  row["status_class"] = ToString(result.status);
  row["reason"] = result.reason;
  row["solved"] = is_solved;
  row["solver_claims_solved"] = has_run && IsClassOk(ipopt.status);
  row["solver_path_free"] = has_run && ipopt.collision_free;
  row["collision_free"] = result.certificate.free;
  row["first_crossing"] = CrossingRow(result.certificate);
  row["iterations"] = result.iterations;
  row["restoration_iterations"] = result.restoration_iterations;
  row["evaluations"] = {{"objective", ipopt.evaluations.objective},
                        {"gradient", ipopt.evaluations.gradient},
                        {"constraints", ipopt.evaluations.constraints},
                        {"jacobian", ipopt.evaluations.jacobian},
                        {"hessian", ipopt.evaluations.hessian}};
  row["objective"] = result.objective;
  row["inf_pr"] = ipopt.violation;
  row["inf_du"] = ipopt.dual_infeasibility;
  // Smallest distance along the path, in the user's unit.
  const double clearance =
      result.certificate.free ? PathClearance(study.judge(), result.path) : 0.0;
  row["clearance"] = clearance;
  row["lengths"] = {
      {"unit", UnitRow(study.scene().unit)},
      {"D", world.diagonal()},
      {"smoothing_length", smoothing},
      {"margin", LengthRow(world.Resolve(study.scene().trajectory.margin))},
      {"clearance", LengthRow(world.Resolve(Length::FromUnit(clearance)))}};
  row["missing_clearance"] = result.missing_clearance;
  row["rounds"] = ipopt.rounds;
  row["queries"] = {{"cold", ipopt.queries.cold},
                    {"warm", ipopt.queries.warm},
                    {"branch_ends", ipopt.queries.branch_ends},
                    {"branch_changes", ipopt.queries.branch_changes}};
  row["stages"] = Json::array();
  for (const StageRecord& stage : result.stages) {
    row["stages"].push_back(StageRow(stage));
  }
  row["contact_triangles"] = study.triangles();
  row["seconds"] = {{"contact_space", world.Report().seconds},
                    {"repair", result.repair.seconds},
                    {"callbacks", result.seconds_callbacks},
                    {"total", result.seconds}};
  row["path"] = Json::array();
  for (const Eigen::Vector3d& p : result.path)
    row["path"].push_back(PointRow(p));
  row["versions"] = VersionsRow();
  return row;
}

}  // namespace phongpd
