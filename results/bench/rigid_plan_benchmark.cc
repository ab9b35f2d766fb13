// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: one run of a planner for a robot that turns: OMPL's, with motions
// looked at by FCL at samples or proved free by RigidMotionValidator, or ours.
// Prints one row as JSON.  The limit and all times are processor seconds of the
// process, all its threads counted, so that other jobs change neither.
// `seconds`: until there is a path; `answer_seconds`: of the whole answer,
// which of ours is shortened, judged once more and has its clearance, of OMPL's
// is the path as found.  Every path is judged motion by motion, after the
// clock: `wrong` of them are proved to collide.
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/stride/STRIDE.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "constraints/oracle/fcl_surfaces.h"
#include "core/mesh/mesh_error.h"
#include "planners/ompl/rigid_motion_validator.h"
#include "planners/rigid/rigid_plan.h"
#include "problems/scenes/rigid_scenes.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr char kPlanners[] =
    "RRTConnect, KPIECE1, BKPIECE1, EST, STRIDE, PRM, BITstar or phongpd";

struct Options {
  std::string scene, planner = "RRTConnect", check = "proof",
                     tuning = "default";
  unsigned seed = 1;
  double limit = 10.0;
};

// What a run answers: no path, an empty one.
struct Outcome {
  std::vector<RobotPose> path;
  double seconds = 0.0, answer_seconds = 0.0;
  std::string by;  // of ours: which of its planners
};

Outcome RunOurs(const RigidScene& scene, const RigidWorld& world,
                const Options& options) {
  RigidRequest request;
  request.start = scene.start;
  request.goal = scene.goal;
  request.bounds = {scene.bounds.min, scene.bounds.max};
  request.seed = options.seed;
  request.threads = 1;  // as the planners beside it have
  // Processor time ends it; the clock of a machine that others use, later.
  const double begin = CpuSeconds();
  request.time_limit = 100.0 * (1.0 + options.limit);
  request.is_interrupted = [&] { return CpuSeconds() - begin > options.limit; };
  const RigidAnswer answer = Plan(world, request);
  return {answer.path, answer.search_cpu_seconds, CpuSeconds() - begin,
          answer.planner};
}

template <typename Planner>
ob::PlannerPtr WithRange(const ob::SpaceInformationPtr& si, double range) {
  auto planner = std::make_shared<Planner>(si);
  if (range > 0.0) planner->setRange(range);
  return planner;
}

ob::PlannerPtr MakePlanner(const std::string& name,
                           const ob::SpaceInformationPtr& si, double range) {
  if (name == "RRTConnect") return WithRange<og::RRTConnect>(si, range);
  if (name == "KPIECE1") return WithRange<og::KPIECE1>(si, range);
  if (name == "BKPIECE1") return WithRange<og::BKPIECE1>(si, range);
  if (name == "EST") return WithRange<og::EST>(si, range);
  if (name == "STRIDE") return WithRange<og::STRIDE>(si, range);
  if (name == "PRM") return std::make_shared<og::PRM>(si);
  if (name == "BITstar") return std::make_shared<og::BITstar>(si);
  throw InputError("--planner: expected " + std::string(kPlanners) +
                   ", found '" + name + "'");
}

// Those that go on after their first path stop at it, like the others.
ob::OptimizationObjectivePtr AnyPath(const ob::SpaceInformationPtr& si) {
  auto length = std::make_shared<ob::PathLengthOptimizationObjective>(si);
  length->setCostThreshold(length->infiniteCost());
  return length;
}

Outcome RunOmpl(const RigidScene& scene, const RigidWorld& rigid,
                const Options& options) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(options.seed);
  const auto space = MakePoseSpace(scene.bounds);
  double range = 0.0;
  if (options.tuning == "tuned") {
    // The object norm (OMPL's angles are half of a turn), and steps of the
    // robot's reach: a rule, the same for all scenes.
    space->setSubspaceWeight(1, 2.0 * rigid.gyration());
    range = rigid.reach();
  } else if (options.tuning != "default") {
    throw InputError("--tuning: expected default or tuned, found '" +
                     options.tuning + "'");
  }
  og::SimpleSetup setup(space);
  const ob::SpaceInformationPtr si = setup.getSpaceInformation();
  TriangleMesh world;
  for (const TriangleMesh& one : scene.obstacles) world = Joined(world, one);
  const FclSurfaces fcl(scene.robot, world);
  if (options.check == "proof") {
    si->setStateValidityChecker(
        std::make_shared<RigidValidityChecker>(si, rigid.judge()));
    si->setMotionValidator(
        std::make_shared<RigidMotionValidator>(si, rigid.judge()));
  } else {
    si->setStateValidityChecker([&si, &fcl](const ob::State* state) {
      return si->satisfiesBounds(state) && !fcl.Meet(ToRobotPose(state));
    });
    si->setStateValidityCheckingResolution(
        ParseDouble(options.check, "--check"));
  }
  ob::ScopedState<> start(space), goal(space);
  FromRobotPose(scene.start, start.get());
  FromRobotPose(scene.goal, goal.get());
  setup.setStartAndGoalStates(start, goal);
  setup.setOptimizationObjective(AnyPath(si));
  setup.setPlanner(MakePlanner(options.planner, si, range));
  Outcome outcome;
  const double begin = CpuSeconds();
  const ob::PlannerStatus status = setup.solve(ob::PlannerTerminationCondition(
      [&] { return CpuSeconds() - begin > options.limit; }));
  outcome.seconds = outcome.answer_seconds = CpuSeconds() - begin;
  if (status == ob::PlannerStatus::EXACT_SOLUTION) {
    for (const ob::State* state : setup.getSolutionPath().getStates()) {
      outcome.path.push_back(ToRobotPose(state));
    }
  }
  return outcome;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->Options("One run of a planner for a robot that turns.");
  Options options;
  app.add_option("scene", options.scene, "FAMILY or FAMILY:VALUE")->required();
  app.add_option("--planner", options.planner, kPlanners)
      ->capture_default_str();
  app.add_option("--check", options.check,
                 "proof, or the resolution of OMPL's samples: 0.01")
      ->capture_default_str();
  app.add_option("--tuning", options.tuning,
                 "default, or tuned: object norm "
                 "and range")
      ->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--limit", options.limit, "Processor seconds")
      ->capture_default_str();
  program->Parse();
  const RigidScene scene = MakeRigidScene(options.scene);
  const RigidWorld world({scene.robot}, scene.obstacles);
  const Outcome outcome = options.planner == "phongpd"
                              ? RunOurs(scene, world, options)
                              : RunOmpl(scene, world, options);
  int wrong = 0, undecided = 0;
  double length = 0.0;
  for (std::size_t i = 1; i < outcome.path.size(); ++i) {
    const RobotPose &from = outcome.path[i - 1], &to = outcome.path[i];
    const RigidCheck check = world.judge().Check(RigidMotion(from, to));
    length += world.Distance(from, to);
    wrong += check.outcome == MotionVerdict::kCollides ? 1 : 0;
    undecided += check.outcome == MotionVerdict::kUndecided ? 1 : 0;
  }
  const nlohmann::ordered_json row = {
      {"scene", scene.name},
      {"planner", options.planner},
      {"check", options.check},
      {"tuning", options.tuning},
      {"seed", options.seed},
      {"limit", options.limit},
      {"solved", !outcome.path.empty()},
      {"seconds", outcome.seconds},
      {"answer_seconds", outcome.answer_seconds},
      {"poses", outcome.path.size()},
      {"length", length},
      {"wrong", wrong},
      {"undecided", undecided},
      {"by", outcome.by}};
  std::cout << row.dump() << std::endl;
  return 0;
}

}  // namespace phongpd::bench
