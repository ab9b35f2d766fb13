// SPDX-License-Identifier: GPL-3.0-or-later
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <sstream>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/contact_space_validity.h"
#include "planners/ompl/ompl_planners.h"

namespace phongpd {
namespace {

// Does not tell the world the name of the machine.
class NamelessBenchmark : public ompl::tools::Benchmark {
 public:
  using Benchmark::Benchmark;
  void benchmark(const Request& request) override {
    Benchmark::benchmark(request);
    exp_.host = "unnamed";
  }
};

std::string Log(const MotionDomain& domain,
                const std::shared_ptr<const ContactModel>& model,
                const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                const std::string& experiment, PlannerId planner, int runs,
                const OmplPlanningOptions& options) {
  if (runs < 1) {
    throw InputError("runs: expected at least 1, found " +
                     std::to_string(runs));
  }
  const ompl::base::SpaceInformationPtr si = MakeSpaceInformation(domain);
  ompl::geometric::SimpleSetup setup(si);
  SetStartAndGoal(start, goal, setup.getProblemDefinition().get());
  // By the set-up's own function, too: its path simplifier asks for the goal.
  setup.setGoal(setup.getProblemDefinition()->getGoal());
  NamelessBenchmark benchmark(setup, experiment);
  benchmark.addPlanner(MakeOmplPlanner(planner, si, model, options));
  NamelessBenchmark::Request request;
  request.maxTime = options.time_limit;
  request.maxMem = 4096.0;  // MiB
  request.runCount = static_cast<unsigned int>(runs);
  request.displayProgress = false;
  request.saveConsoleOutput = false;
  benchmark.benchmark(request);
  std::ostringstream log;
  benchmark.saveResultsToStream(log);
  return log.str();
}

}  // namespace

std::string OmplBenchmarkLog(const std::shared_ptr<const ContactModel>& model,
                             const Eigen::Vector3d& start,
                             const Eigen::Vector3d& goal,
                             const std::string& experiment, PlannerId planner,
                             int runs, const OmplPlanningOptions& options) {
  return Log(DomainOf(model), model, start, goal, experiment, planner, runs,
             options);
}

std::string OmplBenchmarkLog(const MotionDomain& domain,
                             const Eigen::Vector3d& start,
                             const Eigen::Vector3d& goal,
                             const std::string& experiment, PlannerId planner,
                             int runs, const OmplPlanningOptions& options) {
  return Log(domain, nullptr, start, goal, experiment, planner, runs, options);
}

}  // namespace phongpd
