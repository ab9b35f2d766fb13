// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/plan.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/exact/path_shortening.h"
#include "planners/exact/route_order.h"
#include "planners/exact/window_planner.h"
#include "planners/retraction/contact_model.h"
#include "planners/solve/finish_answer.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::ClearanceWish;

constexpr SpaceLayout kLayout = SpaceLayout::kSealed;

ClearanceWish WishOf(const PlanRequest& request) {
  return {"clearance", request.clearance, request.clearance.has_value(),
          request.requires_clearance};
}

// OMPL's own word in the words of all planners; a sampler that has found
// nothing was stopped by its time.
PathStatus StatusOf(const OmplPlanningResult& result) {
  if (result.solved) return PathStatus::kSolved;
  return result.is_late ? PathStatus::kTimeLimit : PathStatus::kFailed;
}

ContactSurfaceOptions SurfaceOptions(const PlanRequest& request) {
  ContactSurfaceOptions options;
  ApplyPreset(request.preset, &options);
  return options;
}

// One request in one world.
class PlanRun {
 public:
  PlanRun(const World& world, const PlanRequest& request,
          bool keeps_clearance = true)
      : world_(world),
        request_(request),
        keeps_clearance_(request.clearance.has_value() && keeps_clearance) {}

  PathAnswer Run() {
    request_.Validate();
    if (request_.clearance) {
      RequireLength(*request_.clearance, LengthRange::kAboveZero,
                    world_.diagonal(), "clearance", world_.workspace().unit);
    }
    answer_.plan.emplace();
    answer_.plan->planner = request_.planner;
    if (request_.model == Model::kWindow) RequireNoRetraction("");
    if (AreEndsFree()) {
      const bool is_window = UsesWindow();
      if (is_window) RequireNoRetraction(answer_.evidence.refusal);
      answer_.evidence.model = is_window ? Model::kWindow : Model::kFull;
      Search();
      answer_.is_solved = answer_.is_free && !answer_.path.empty();
      SayRounding();
    }
    internal::Finish(world_, request_.start, request_.goal, WishOf(request_),
                     request_.verifies, &answer_);
    return std::move(answer_);
  }

  // Of kAuto the cheapest that is enough: no contact space is built for who
  // only asks whether motions are free (results/trade, "model: plan").
  bool UsesWindow() {
    const bool is_enough = request_.model == Model::kAuto &&
                           ChecksMotionsOnly(request_.planner) &&
                           world_.Built(kLayout) == nullptr;
    return is_enough || internal::UsesWindow(world_, request_.model, {kLayout},
                                             &answer_.evidence.refusal);
  }

  BoundingBox Region(bool is_window) const {
    const BoundingBox& bounds = world_.workspace().bounds;
    if (!bounds.IsEmpty()) return bounds;
    return is_window
               ? WindowRegion(world_, request_.start, request_.goal)
               : SamplingRegion(world_.Sealed(), request_.start, request_.goal);
  }

  std::string Log(int runs) {
    if (request_.planner == PlannerId::kContactSurface) {
      throw InputError("log of OMPL: expected a planner of OMPL, found " +
                       std::string(ToString(request_.planner)));
    }
    if (UsesWindow()) {
      return OmplBenchmarkLog(Domain(), request_.start, request_.goal,
                              world_.name(), request_.planner, runs,
                              Options(nullptr));
    }
    const auto model = RetractionModel();
    return OmplBenchmarkLog(model, request_.start, request_.goal, world_.name(),
                            request_.planner, runs, Options(model.get()));
  }

 private:
  const FreeSpace& Judge() const { return *answer_.evidence.free_space; }
  bool IsWindow() const { return answer_.evidence.model == Model::kWindow; }

  MotionDomain Domain() const {
    return {world_.Convolution().free_space, Region(true)};
  }

  // The bounds are part of the mesh; what is beyond them need not be sampled.
  std::shared_ptr<const ContactModel> RetractionModel() const {
    const BoundingBox region = Region(false);
    return world_.Kept<ContactModel>(
        FormatPoint(region.min) + ' ' + FormatPoint(region.max),
        [&] { return ContactModel(world_.Spaces(kLayout).spaces, region); });
  }

  // The wanted clearance in the user's unit; 0: the planner's own.
  double WantedClearance() const {
    return request_.clearance ? world_.Resolve(*request_.clearance).unit : 0.0;
  }

  OmplPlanningOptions Options(const ContactModel* model) const {
    OmplPlanningOptions options;
    options.time_limit = request_.time_limit;
    options.seed = request_.seed;
    options.retraction = request_.retraction;
    if (model != nullptr && request_.clearance) {
      // Measured by the region; where that is smaller than the wish, nothing in
      // it is farther from contact.
      options.retraction.clearance =
          std::min(1.0, WantedClearance() / model->diagonal());
    }
    return options;
  }

  void RequireNoRetraction(const std::string& refusal) const {
    if (!Retracts(request_.planner)) return;
    const std::string others = PlannersWithoutSurface();
    if (!refusal.empty()) {
      throw BuildRefusal(refusal + "; or plan in free space alone (" + others +
                         ")");
    }
    throw InputError(
        "planner: expected one that does without the whole contact surface "
        "with model window (" +
        others + "), found " + ToString(request_.planner) +
        "; take model full");
  }

  bool AreEndsFree() {
    return internal::AreEndsFree(world_, request_.start, request_.goal,
                                 &answer_);
  }

  // A start or goal that is free of the solids and not of what was built.
  void SayRounding() {
    for (const bool at_start : {false, true}) {
      const Vector3d& q = at_start ? request_.start : request_.goal;
      if (answer_.is_solved || Judge().IsFree(q)) continue;
      answer_.reason = BlockedByRounding(q, at_start ? "start" : "goal");
    }
  }

  void Search() {
    if (request_.planner == PlannerId::kContactSurface) {
      IsWindow() ? SearchWindow() : SearchSurface();
    } else {
      IsWindow() ? SampleWindow() : SampleSurface();
    }
  }

  RouteRequest Routes() const {
    RouteRequest routes;
    routes.routes = request_.routes;
    routes.clearance = WantedClearance();
    routes.keeps_clearance = keeps_clearance_;
    return routes;
  }

  // What a planner finds.  Where that misses a clearance that was to be kept,
  // it is asked again, for more of it and then without the wish, and the first
  // answer that keeps it is taken, or the one that keeps most.
  template <typename Found>
  Found FoundBy(const std::function<Found(const RouteRequest&)>& ask,
                PlanResult& (*plan_of)(Found&)) const {
    const RouteRequest wish = Routes();
    Found best = ask(wish);
    double seconds = plan_of(best).seconds;
    const double wanted = plan_of(best).wanted_clearance;
    for (const double share : {1.5, 2.0, 3.0, 0.0}) {
      const PlanResult& plan = plan_of(best);
      if (!wish.keeps_clearance || plan.status != PathStatus::kSolved ||
          plan.clearance >= kKeptOfClearance * wish.clearance) {
        break;
      }
      RouteRequest other = wish;
      other.clearance = share * wish.clearance;
      other.keeps_clearance = share > 0.0;
      Found found = ask(other);
      seconds += plan_of(found).seconds;
      if (plan_of(found).status == PathStatus::kSolved &&
          plan_of(found).clearance > plan.clearance) {
        best = std::move(found);
      }
    }
    plan_of(best).seconds = seconds;
    plan_of(best).wanted_clearance = wanted;
    return best;
  }

  // Of the options that planners are kept by.
  std::string SurfaceTag() const { return ToString(request_.preset); }

  void SearchSurface() {
    answer_.evidence.free_space = world_.Spaces(kLayout).free_space;
    const auto planner =
        world_.Kept<ContactSurfacePlanner>(SurfaceTag(), [this] {
          return ContactSurfacePlanner(world_.Sealed(),
                                       SurfaceOptions(request_));
        });
    PlanResult found = FoundBy<PlanResult>(
        [&](const RouteRequest& routes) {
          return planner->Plan(request_.start, request_.goal, routes);
        },
        [](PlanResult& plan) -> PlanResult& { return plan; });
    // The first query pays for the planner's tables, too.
    answer_.seconds = found.seconds + planner->build_seconds();
    TakeExact(std::move(found));
  }

  void SearchWindow() {
    const auto planner = world_.Kept<WindowPlanner>(SurfaceTag(), [this] {
      return WindowPlanner(world_.SealedConvolution(),
                           SurfaceOptions(request_));
    });
    WindowPlan found;
    try {
      found = FoundBy<WindowPlan>(
          [&](const RouteRequest& routes) {
            return planner->Plan(request_.start, request_.goal, routes);
          },
          [](WindowPlan& window) -> PlanResult& { return window.plan; });
    } catch (const BuildRefusal& error) {
      throw BuildRefusal(std::string(error.what()) +
                         "; or plan without proofs (" + PlannersOfMotions() +
                         ")");
    }
    answer_.evidence.free_space =
        std::shared_ptr<const FreeSpace>(planner, &planner->free_space());
    answer_.evidence.surface = found.surface;
    answer_.plan->explored_boxes = found.boxes;
    answer_.plan->explored_faces = found.faces;
    answer_.seconds = found.plan.seconds;
    TakeExact(std::move(found.plan));
  }

  // What contact-surface found in either model.
  void TakeExact(PlanResult found) {
    PlanWork& work = *answer_.plan;
    work.surface = SurfaceOptions(request_);
    if (request_.routes > 0) work.surface->routes = request_.routes;
    work.routes = std::move(found.routes);
    work.search.segment_checks = static_cast<std::uint64_t>(found.lift.tests);
    work.wanted_clearance =
        world_.Resolve(Length::FromUnit(found.wanted_clearance));
    answer_.status = found.status;
    answer_.reason = std::move(found.reason);
    answer_.path = std::move(found.path);
    answer_.length = found.length;
    answer_.clearance = found.clearance;
    answer_.evidence.check = CheckPath(Judge(), answer_.path);
    answer_.is_free = answer_.evidence.check.free;
  }

  void SampleSurface() {
    answer_.evidence.free_space = world_.Spaces(kLayout).free_space;
    const auto model = RetractionModel();
    const OmplPlanningOptions options = Options(model.get());
    TakeSampled(PlanWithOmpl(model, request_.start, request_.goal,
                             request_.planner, options));
    if (SeeksClearance(request_.planner)) {
      answer_.plan->wanted_clearance = world_.Resolve(
          Length::FromUnit(options.retraction.clearance * model->diagonal()));
    }
  }

  void SampleWindow() {
    answer_.evidence.free_space = world_.Convolution().free_space;
    TakeSampled(PlanWithOmpl(Domain(), request_.start, request_.goal,
                             request_.planner, Options(nullptr)));
    if (answer_.is_free) Shorten();
  }

  void TakeSampled(OmplPlanningResult found) {
    answer_.status = StatusOf(found);
    answer_.path = found.path;
    answer_.length = found.length;
    answer_.clearance = found.clearance;
    answer_.seconds = found.seconds;
    answer_.is_free = found.collision_free;
    answer_.evidence.check = CheckPath(Judge(), answer_.path);
    answer_.plan->search = std::move(found);
  }

  // Straightened, and judged again.
  void Shorten() {
    const Stopwatch stopwatch;
    const FreeSpace& space = Judge();
    ShorteningOptions options;
    options.clearance = request_.clearance
                            ? WantedClearance()
                            : kEnoughClearance * world_.diagonal();
    options.seed = request_.seed;
    answer_.path = ShortenPath(answer_.path, space, options,
                               keeps_clearance_ ? 1.0 : kClearanceKept);
    answer_.length = PathLength(answer_.path);
    answer_.evidence.check = CheckPath(space, answer_.path);
    answer_.is_free = answer_.evidence.check.free;
    answer_.clearance = PathClearance(space, answer_.path);
    answer_.seconds += stopwatch.Seconds();
  }

  const World& world_;
  const PlanRequest& request_;
  bool keeps_clearance_;
  PathAnswer answer_;
};

}  // namespace

void PlanRequest::Validate() const {
  if (planner == PlannerId::kContactSurface) {
    RouteRequest wish;
    wish.routes = routes;
    wish.Validate();
  } else {
    OmplPlanningOptions options;
    options.time_limit = time_limit;
    options.retraction = retraction;
    options.Validate();
  }
  if (requires_clearance && !clearance) {
    throw InputError("require: expected a clearance with it, found none");
  }
}

PathAnswer Plan(const World& world, const PlanRequest& request) {
  return PlanRun(world, request).Run();
}

PathAnswer PlanLifted(const World& world, const PlanRequest& request) {
  return PlanRun(world, request, false).Run();
}

std::string ClearanceBeyondReach(const World& world,
                                 const PlanRequest& request) {
  return internal::BeyondTheEnds(world, request.start, request.goal,
                                 WishOf(request));
}

bool PlansInWindow(const World& world, const PlanRequest& request) {
  return PlanRun(world, request).UsesWindow();
}

BoundingBox PlanningRegion(const World& world, const PlanRequest& request) {
  PlanRun run(world, request);
  return run.Region(run.UsesWindow());
}

BoundingBox WindowRegion(const World& world, const Vector3d& start,
                         const Vector3d& goal) {
  const BoundingBox& bounds = world.workspace().bounds;
  if (!bounds.IsEmpty()) return bounds;
  return SamplingRegion(*world.Convolution().free_space, start, goal);
}

std::string OmplLog(const World& world, const PlanRequest& request, int runs) {
  return PlanRun(world, request).Log(runs);
}

}  // namespace phongpd
