// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/planning_study.h"

#include <algorithm>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_refusal.h"
#include "core/stopwatch.h"
#include "planners/exact/path_shortening.h"
#include "problems/output/nearest_name.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

// OMPL's own word in the words of all planners; a sampler that has found
// nothing was stopped by its time.
std::string StatusOf(const OmplPlanningResult& result) {
  if (result.solved) return ToString(PlanStatus::kSolved);
  const bool is_time =
      result.status == "Timeout" || result.status == "Approximate solution";
  return is_time ? "time_limit" : ToString(PlanStatus::kFailed);
}

}  // namespace

PlanningStudy::PlanningStudy(const Scene& scene, const ContactSpaceCache& cache,
                             const WorldLimits& limits)
    : scene_(scene),
      world_(scene.workspace, scene.name, cache, limits),
      choice_(scene.planning.model) {}

PlanningStudy::PlanningStudy(const Scene& scene, const World& world)
    : scene_(scene), world_(world), choice_(scene.planning.model) {
  RequireSameSolids(scene.workspace, world, scene.name);
}

// Of auto the cheapest that is enough: no contact space is built for who only
// asks whether motions are free (results/trade, "model: plan").
void PlanningStudy::ChooseModel(const std::string& planner) {
  is_window_enough_ = scene_.planning.model == "auto" &&
                      ChecksMotionsOnly(planner) &&
                      world_.Built(kLayout) == nullptr;
}

bool PlanningStudy::RunsInWindow(const PlanningRun& run) {
  ChooseModel(run.planner);
  return UsesWindow();
}

const FreeSpace& PlanningStudy::Judge() {
  return UsesWindow() ? *world_.Convolution().free_space : *spaces().free_space;
}

BoundingBox PlanningStudy::Region() {
  const BoundingBox& bounds = scene_.workspace.bounds;
  if (!bounds.IsEmpty()) return bounds;
  return UsesWindow()
             ? SamplingRegion(Judge(), scene_.start, scene_.goal)
             : SamplingRegion(world_.Sealed(), scene_.start, scene_.goal);
}

TriangleMesh PlanningStudy::VisibleMesh() {
  return VisibleMesh(world_.Sealed());
}

TriangleMesh PlanningStudy::VisibleMesh(const ContactSpace& explored) {
  const BoundingBox region = Region();
  const double rounding = 1e-9 * region.Diagonal();
  const TriangleMesh& all = explored.mesh();
  const std::vector<ContactKind>& kinds = explored.kind();
  TriangleMesh visible;
  std::vector<int> shown(all.vertices.size(), -1);  // their numbers there
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    if (!kinds.empty() && kinds[i] == ContactKind::kNone) continue;
    const Triangle& t = all.triangles[i];
    const bool is_within = std::all_of(t.begin(), t.end(), [&](int v) {
      const Eigen::Vector3d& p = all.vertices[v];
      return (p.array() >= region.min.array() - rounding).all() &&
             (p.array() <= region.max.array() + rounding).all();
    });
    if (!is_within) continue;
    for (const int v : t) {
      if (shown[v] >= 0) continue;
      shown[v] = static_cast<int>(visible.vertices.size());
      visible.vertices.push_back(all.vertices[v]);
    }
    visible.triangles.push_back({shown[t[0]], shown[t[1]], shown[t[2]]});
  }
  return visible;
}

MotionDomain PlanningStudy::Domain() {
  return {world_.Convolution().free_space, Region()};
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
  const std::string planner =
      run.planner.empty() ? kContactSurface : run.planner;
  CheckHasOmplLog(planner);
  ChooseModel(planner);
  if (UsesWindow()) {
    return OmplBenchmarkLog(Domain(), scene_.start, scene_.goal, scene_.name,
                            planner, runs, Options(run));
  }
  PrepareModel();
  return OmplBenchmarkLog(model_, scene_.start, scene_.goal, scene_.name,
                          planner, runs, Options(run));
}

// False: start or goal is not free, and the result says so.
bool PlanningStudy::Diagnose(PlanningResult* result) const {
  for (const bool at_start : {true, false}) {
    const Diagnosis diagnosis =
        world_.Diagnose(at_start ? scene_.start : scene_.goal);
    if (diagnosis.IsFree()) continue;
    result->reason = diagnosis.Text(at_start ? "start" : "goal");
    const PlanStatus status = diagnosis.IsOnlyOutOfBounds()
                                  ? at_start ? PlanStatus::kStartOutOfBounds
                                             : PlanStatus::kGoalOutOfBounds
                              : at_start ? PlanStatus::kInvalidStart
                                         : PlanStatus::kInvalidGoal;
    result->status = ToString(status);
    return false;
  }
  return true;
}

ContactSurfaceOptions PlanningStudy::SurfaceOptions() const {
  ContactSurfaceOptions options;
  ApplyPreset(scene_.preset, &options);
  return options;
}

PlanRequest PlanningStudy::Request(const PlanningRun& run) const {
  PlanRequest request;
  request.routes = run.routes;
  request.clearance = WantedClearance();
  return request;
}

void PlanningStudy::RunExact(const PlanningRun& run, PlanningResult* result) {
  if (planner_ == nullptr) {
    planner_ = std::make_unique<ContactSurfacePlanner>(world_.Sealed(),
                                                       SurfaceOptions());
  }
  exact_ = planner_->Plan(scene_.start, scene_.goal, Request(run));
  TellExact(run, *spaces().free_space, result);
  // The first query pays for the planner's tables, too.
  result->numbers.seconds += planner_->build_seconds();
}

void PlanningStudy::RunInWindow(const PlanningRun& run,
                                PlanningResult* result) {
  if (window_planner_ == nullptr) {
    window_planner_ = std::make_unique<WindowPlanner>(
        world_.SealedConvolution(), SurfaceOptions());
  }
  try {
    result->explored =
        window_planner_->Plan(scene_.start, scene_.goal, Request(run));
  } catch (const BuildRefusal& error) {
    throw BuildRefusal(std::string(error.what()) +
                       "; or plan without proofs (" +
                       Joined(SurfaceFreePlannerNames()) + ")");
  }
  exact_ = result->explored->plan;
  TellExact(run, window_planner_->free_space(), result);
}

void PlanningStudy::TellExact(const PlanningRun& run, const FreeSpace& judge,
                              PlanningResult* result) const {
  result->surface = SurfaceOptions();
  if (run.routes > 0) result->surface->routes = run.routes;
  result->status = ToString(exact_.status);
  result->reason = exact_.reason;
  result->infeasible_proved = exact_.status == PlanStatus::kInfeasibleProved;
  result->numbers.path = exact_.path;
  result->numbers.length = exact_.length;
  result->numbers.clearance = exact_.clearance;
  result->numbers.segment_checks =
      static_cast<std::uint64_t>(exact_.lift.tests);
  result->numbers.seconds = exact_.seconds;
  result->numbers.collision_free = CheckPath(judge, exact_.path).free;
  result->wanted_clearance =
      world_.Resolve(Length::FromUnit(exact_.wanted_clearance));
}

// Straightened, and judged again.
void PlanningStudy::Shorten(std::uint64_t seed, OmplPlanningResult* numbers) {
  const Stopwatch stopwatch;
  const FreeSpace& space = Judge();
  ShorteningOptions options;
  options.clearance = scene_.planning.clearance
                          ? WantedClearance()
                          : kEnoughClearance * world_.diagonal();
  options.seed = seed;
  numbers->path = ShortenPath(numbers->path, space, options);
  numbers->length = PathLength(numbers->path);
  numbers->collision_free = CheckPath(space, numbers->path).free;
  numbers->clearance = PathClearance(space, numbers->path);
  numbers->seconds += stopwatch.Seconds();
}

void PlanningStudy::RunOmpl(const PlanningRun& run, PlanningResult* result) {
  if (UsesWindow()) {
    result->numbers = PlanWithOmpl(Domain(), scene_.start, scene_.goal,
                                   result->planner, Options(run));
    if (result->numbers.collision_free) Shorten(run.seed, &result->numbers);
    result->status = StatusOf(result->numbers);
    return;
  }
  PrepareModel();
  const OmplPlanningOptions options = Options(run);
  result->numbers =
      PlanWithOmpl(model_, scene_.start, scene_.goal, result->planner, options);
  result->status = StatusOf(result->numbers);
  if (SeeksClearance(result->planner)) {
    result->wanted_clearance = world_.Resolve(
        Length::FromUnit(options.retraction.clearance * model_->diagonal()));
  }
}

void PlanningStudy::RequireRunsInWindow(const std::string& planner) const {
  if (!NeedsWholeSurface(planner)) return;
  const std::string others =
      std::string(kContactSurface) + ", " + Joined(SurfaceFreePlannerNames());
  if (refusal().empty()) {
    throw InputError(
        "--planner: expected one that does without the whole contact surface "
        "with model window (" +
        others + "), found " + planner + "; take model full");
  }
  throw BuildRefusal(refusal() + "; or plan in free space alone (" + others +
                     ")");
}

PlanningResult PlanningStudy::Run(const PlanningRun& run) {
  const std::vector<std::string> names = PlannerNames();
  if (!run.planner.empty() &&
      std::find(names.begin(), names.end(), run.planner) == names.end()) {
    throw InputError("--planner: expected one of " + Joined(names) +
                     "; found '" + run.planner + "'" +
                     DidYouMean(run.planner, names));
  }
  // Before anything is built.
  const bool is_window = scene_.planning.model == "window";
  PlanningResult result;
  result.planner = run.planner.empty() ? kContactSurface : run.planner;
  if (is_window) RequireRunsInWindow(result.planner);
  if (result.planner != kContactSurface) Options(run).Validate();
  if (!Diagnose(&result)) return result;
  ChooseModel(result.planner);
  if (UsesWindow()) RequireRunsInWindow(result.planner);
  result.model = UsesWindow() ? "window" : "full";
  if (result.planner == kContactSurface) {
    UsesWindow() ? RunInWindow(run, &result) : RunExact(run, &result);
  } else {
    RunOmpl(run, &result);
  }
  result.solved = result.numbers.collision_free && !result.numbers.path.empty();
  for (const bool at_start : {false, true}) {
    const Eigen::Vector3d& q = at_start ? scene_.start : scene_.goal;
    if (result.solved || Judge().IsFree(q)) continue;
    result.reason = BlockedByRounding(q, at_start ? "start" : "goal");
  }
  return result;
}

}  // namespace phongpd
