// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/window_planner.h"
#include "planners/ompl/ompl_planning.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/model_choice.h"
#include "problems/studies/planner_names.h"

namespace phongpd {

struct PlanningRun {
  std::string planner;               // empty: contact-surface
  std::string retraction = "phong";  // retraction-* and prm-retraction
  double time_limit = 5.0;           // seconds; of OMPL's planners
  int routes = 0;  // contact-surface only; ≥ 1; 0: by the scene's preset
  std::uint64_t seed = 1;
};

// What one run gave; every path is judged exactly.
struct PlanningResult {
  std::string planner;             // that ran
  std::string model = "none";      // what it planned in: "full", "window"
  bool solved = false;             // an exactly free path
  bool infeasible_proved = false;  // contact-surface only
  std::string status;
  std::string reason;
  OmplPlanningResult numbers;  // path, checks, ...; status is OMPL's
  // With what contact-surface ran; none: another did.
  std::optional<ContactSurfaceOptions> surface;
  // What was sought, resolved; none: the planner seeks none, or did not start.
  std::optional<ResolvedLength> wanted_clearance;
  // What of free space contact-surface explored in the window; none: it did
  // not run there, or needed nothing.
  std::optional<WindowPlan> explored;
};

// Plans on one scene.  What it plans in is built once for all runs, when the
// first one needs it, by the scene's planning.model (model_choice.h): the
// sealed contact space of its world, or free space alone.  That is enough for
// planners that only check motions; their paths are exactly free all the same,
// and are shortened (ShortenPath) where they keep the wanted clearance, by
// default 0.01 D.  contact-surface builds of the contact space what leads from
// start to goal then (WindowPlanner): anew for each run.
class PlanningStudy {
 public:
  // Throws InputError.
  explicit PlanningStudy(const Scene& scene,
                         const ContactSpaceCache& cache = {},
                         const WorldLimits& limits = {});
  // In a world that others share.  Throws InputError unless its solids are the
  // scene's.
  PlanningStudy(const Scene& scene, const World& world);

  // A start or goal that is not free is said before anything is built.  Throws
  // InputError for an unknown planner or retraction, and for a planner that
  // needs all of the contact surface with model window; BuildRefusal where a
  // limit refuses the contact space that is needed.
  PlanningResult Run(const PlanningRun& run);

  // Is a run of this kind one in free space alone?  The same whether it was
  // made here or is kept from before.  Builds the full model where it takes
  // that to know.
  bool RunsInWindow(const PlanningRun& run);

  // The log of OMPL's own benchmark of one of its planners, for the
  // statistics script that comes with OMPL.  Throws like CheckHasOmplLog.
  std::string OmplLog(const PlanningRun& run, int runs);

  // Where paths can be: the bounds, or the box around the cells of start and
  // goal (SamplingRegion).
  BoundingBox Region();
  // The triangles of the contact space in that region, for pictures.
  TriangleMesh VisibleMesh();
  // The same of what a run in the window explored, without its walls.
  TriangleMesh VisibleMesh(const ContactSpace& explored);

  // Why model auto had to take the window; empty: it had not.
  const std::string& refusal() const { return choice_.refusal(); }

  const Scene& scene() const { return scene_; }
  const World& world() const { return world_; }
  // Those of the full model; builds them.
  const WorldSpaces& spaces() const {
    return world_.Spaces(SpaceLayout::kSealed);
  }
  // Of the last run by contact-surface: certificate and counts.
  const PlanResult& exact() const { return exact_; }

 private:
  static constexpr SpaceLayout kLayout = SpaceLayout::kSealed;

  bool UsesWindow() {
    return is_window_enough_ || choice_.UsesWindow(world_, {kLayout});
  }
  // For the planner of a run.
  void ChooseModel(const std::string& planner);
  const FreeSpace& Judge();
  void RequireRunsInWindow(const std::string& planner) const;
  void PrepareModel();
  MotionDomain Domain();
  OmplPlanningOptions Options(const PlanningRun& run) const;
  bool Diagnose(PlanningResult* result) const;
  ContactSurfaceOptions SurfaceOptions() const;
  PlanRequest Request(const PlanningRun& run) const;
  void RunExact(const PlanningRun& run, PlanningResult* result);
  void RunInWindow(const PlanningRun& run, PlanningResult* result);
  // What both have to say of exact_.
  void TellExact(const PlanningRun& run, const FreeSpace& judge,
                 PlanningResult* result) const;
  void RunOmpl(const PlanningRun& run, PlanningResult* result);
  void Shorten(std::uint64_t seed, OmplPlanningResult* numbers);
  // The wanted clearance in the user's unit; 0: the planner's own.
  double WantedClearance() const;

  Scene scene_;
  World world_;
  ModelChoice choice_;
  bool is_window_enough_ = false;  // for the last run, model auto
  std::unique_ptr<ContactSurfacePlanner> planner_;
  std::unique_ptr<WindowPlanner> window_planner_;
  std::shared_ptr<const ContactModel> model_;
  PlanResult exact_;
};

// One row of results, with the keys the command line documents.
nlohmann::ordered_json PlanningRow(const PlanningStudy& study,
                                   const PlanningRun& run,
                                   const PlanningResult& result);

}  // namespace phongpd
