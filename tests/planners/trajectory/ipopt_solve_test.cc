// SPDX-License-Identifier: GPL-3.0-or-later
// Programs whose solutions are known by hand.
#include "planners/trajectory/ipopt_solve.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "tests/support/expect_refused.h"
#include "tests/support/printed_by_ipopt.h"

namespace phongpd {
namespace {

using Eigen::VectorXd;

// min (x − 2)² + (y − 1)²  s.t.  x² + y² ≤ 1: the solution is (2, 1)/√5.
class Disc : public NonlinearProgram {
 public:
  int variables() const override { return 2; }
  int rows() const override { return 1; }
  int jacobian_nonzeros() const override { return 2; }
  int hessian_nonzeros() const override { return 2; }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override {
    x_low[0] = x_low[1] = g_low[0] = -2e19;
    x_high[0] = x_high[1] = 2e19;
    g_high[0] = radius_squared;
  }
  void JacobianPattern(int* row, int* col) const override {
    row[0] = row[1] = col[0] = 0;
    col[1] = 1;
  }
  void HessianPattern(int* row, int* col) const override {
    row[0] = col[0] = 0;
    row[1] = col[1] = 1;
  }
  double Objective(const double* x) const override {
    return std::pow(x[0] - 2.0, 2) + std::pow(x[1] - 1.0, 2) + tilt * x[0];
  }
  void ObjectiveGradient(const double* x, double* g) const override {
    g[0] = 2.0 * (x[0] - 2.0) + tilt;
    g[1] = 2.0 * (x[1] - 1.0) + lie;
  }
  bool Constraints(const double* x, double* values, double* jacobian) override {
    if (refuses) return false;
    values[0] = x[0] * x[0] + x[1] * x[1] + offset;
    jacobian[0] = 2.0 * x[0];
    jacobian[1] = 2.0 * x[1];
    return true;
  }
  void Hessian(const double* /*x*/, double factor, const double* multipliers,
               double* values) const override {
    values[0] = values[1] = 2.0 * factor + 2.0 * multipliers[0];
  }
  int Accept(const double* x) override {
    accepted.emplace_back(Eigen::Map<const VectorXd>(x, 2));
    return 7;
  }

  double radius_squared = 1.0;
  double offset = 0.0;  // > radius²: infeasible
  double tilt = 0.0;
  double lie = 0.0;  // error of the gradient
  bool refuses = false;
  std::vector<VectorXd> accepted;
};

VectorXd Point(double x, double y) {
  VectorXd p(2);
  p << x, y;
  return p;
}

TEST(SolveWithIpopt, FindsTheNearestPointOfADisc) {
  for (const auto strategy : {IpoptSettings::MuStrategy::kAdaptive,
                              IpoptSettings::MuStrategy::kMonotone}) {
    Disc disc;
    IpoptSettings settings;
    settings.mu_strategy = strategy;
    settings.ipopt_options["tol"] = "1e-9";
    settings.stall_iterations = 0;
    const IpoptRun run = SolveWithIpopt(&disc, Point(0.0, 0.0), settings);
    EXPECT_EQ(run.status, SolveStatus::kConverged);
    EXPECT_EQ(run.raw_status, "Solve_Succeeded");
    EXPECT_LT((run.x - Point(2.0, 1.0) / std::sqrt(5.0)).norm(), 1e-7);
    EXPECT_NEAR(run.objective, std::pow(std::sqrt(5.0) - 1.0, 2), 1e-6);
    EXPECT_TRUE(run.is_feasible);
    // One Accept an iterate, the start included; the last one is the answer.
    EXPECT_EQ(static_cast<int>(disc.accepted.size()), run.iterations + 1);
    EXPECT_EQ(run.log.size(), disc.accepted.size());
    EXPECT_EQ(disc.accepted.front(), Point(0.0, 0.0));
    EXPECT_LT((disc.accepted.back() - run.x).norm(), 1e-12);
    for (std::size_t i = 0; i < run.log.size(); ++i) {
      EXPECT_EQ(run.log[i].iteration, static_cast<int>(i));
      EXPECT_EQ(run.log[i].objective, disc.Objective(disc.accepted[i].data()));
      EXPECT_EQ(run.log[i].branch_changes, 7);
    }
    EXPECT_GT(run.evaluations.hessian, 0);
  }
}

// Ipopt prints the objective of every iterate it accepts: what the callback
// read from its innards is the same, in restoration, too.
TEST(SolveWithIpopt, ReadsTheIteratesThatIpoptPrints) {
  for (const bool is_infeasible : {false, true}) {
    Disc disc;
    disc.offset = is_infeasible ? 1.5 : 0.0;
    IpoptSettings settings;
    settings.stall_iterations = 0;
    IpoptRun run;
    const std::string text =
        testing::PrintedByIpopt(&disc, Point(3.0, -4.0), settings, &run);
    EXPECT_EQ(run.status, is_infeasible ? SolveStatus::kInfeasible
                                        : SolveStatus::kConverged);
    std::istringstream lines(text);
    std::size_t next = 0;
    int restoration = 0;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string number;
      double objective = 0.0;
      if (!(words >> number >> objective)) continue;
      const bool has_r = number.back() == 'r';
      if (has_r) number.pop_back();
      if (number.find_first_not_of("0123456789") != std::string::npos) continue;
      ASSERT_LT(next, run.log.size());
      EXPECT_EQ(run.log[next].is_restoration, has_r);
      EXPECT_NEAR(run.log[next].objective, objective,
                  1e-7 * (1.0 + std::abs(objective)));
      ++next;
      restoration += has_r ? 1 : 0;
    }
    // A restoration phase that fails keeps its last iterate to itself.
    const int silent = is_infeasible ? 1 : 0;
    EXPECT_EQ(static_cast<int>(next) + silent,
              static_cast<int>(run.log.size()));
    EXPECT_EQ(restoration + silent, run.restoration_iterations);
    EXPECT_EQ(restoration > 0, is_infeasible);
  }
}

// The condensed system and MUMPS solve the same equations.
TEST(SolveWithIpopt, TakesTheStepsOfAGeneralSolver) {
  for (const bool is_infeasible : {false, true}) {
    Disc one, other;
    one.offset = other.offset = is_infeasible ? 1.5 : 0.0;
    IpoptSettings settings;
    settings.stall_iterations = 0;
    const IpoptRun condensed = SolveWithIpopt(&one, Point(3.0, -4.0), settings);
    settings.ipopt_options["linear_solver"] = "mumps";
    const IpoptRun general = SolveWithIpopt(&other, Point(3.0, -4.0), settings);
    EXPECT_EQ(condensed.status, general.status);
    EXPECT_LT((condensed.x - general.x).norm(), is_infeasible ? 1e-3 : 1e-6);
    // In restoration, where nothing is left to converge to, rounding decides.
    if (is_infeasible) continue;
    ASSERT_EQ(condensed.iterations, general.iterations);
    for (std::size_t i = 0; i < condensed.log.size(); ++i) {
      EXPECT_NEAR(condensed.log[i].objective, general.log[i].objective, 1e-6);
    }
  }
}

// x² + y² = 1: an equality, which has no slack to eliminate.
TEST(SolveWithIpopt, KeepsItsGeneralSolverForEqualities) {
  class Circle : public Disc {
    void Bounds(double* x_low, double* x_high, double* g_low,
                double* g_high) const override {
      Disc::Bounds(x_low, x_high, g_low, g_high);
      g_low[0] = g_high[0];
    }
  };
  Circle circle;
  const IpoptRun run = SolveWithIpopt(&circle, Point(0.5, 3.0), {});
  EXPECT_EQ(run.status, SolveStatus::kConverged);
  EXPECT_LT((run.x - Point(2.0, 1.0) / std::sqrt(5.0)).norm(), 1e-6);
}

TEST(SolveWithIpopt, NamesOptionsThatIpoptDoesNotKnow) {
  const auto message = [](const std::string& name, const std::string& value) {
    Disc disc;
    IpoptSettings settings;
    settings.ipopt_options[name] = value;
    return testing::ErrorOf(
        [&] { SolveWithIpopt(&disc, Point(0.0, 0.0), settings); });
  };
  EXPECT_NE(message("max_itr", "10").find("'max_itr'"), std::string::npos);
  EXPECT_NE(message("max_iter", "ten").find("'ten'"), std::string::npos);
  EXPECT_NE(message("max_iter", "1.5").find("whole number"), std::string::npos);
  EXPECT_NE(message("max_iter", "-1").find("'max_iter'"), std::string::npos);
  EXPECT_NE(message("tol", "-1").find("'tol'"), std::string::npos);
  EXPECT_NE(message("tol", "nan").find("'tol'"), std::string::npos);
  EXPECT_NE(message("mu_strategy", "clever").find("'clever'"),
            std::string::npos);
  EXPECT_EQ(message("mu_strategy", "monotone"), "");
  EXPECT_EQ(message("tol", "1e-4"), "");
  IpoptSettings settings;
  settings.ipopt_options["acceptable_tol"] = "x";
  EXPECT_THROW(CheckIpoptOptions(settings), InputError);
}

TEST(SolveWithIpopt, RefusesBadSettingsAndStarts) {
  Disc disc;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SolveWithIpopt(&disc, Point(nan, 0.0), {}), InputError);
  EXPECT_THROW(SolveWithIpopt(&disc, VectorXd::Zero(3), {}), InputError);
  const auto refused = [&](auto change) {
    IpoptSettings settings;
    change(&settings);
    EXPECT_THROW(SolveWithIpopt(&disc, Point(0.0, 0.0), settings), InputError);
  };
  refused([](IpoptSettings* s) { s->max_iterations = -1; });
  refused([](IpoptSettings* s) { s->ipopt_options["tol"] = "0"; });
  refused([](IpoptSettings* s) { s->ipopt_options["tol"] = "nan"; });
  refused([](IpoptSettings* s) { s->stall_iterations = -1; });
  refused([](IpoptSettings* s) { s->time_limit = 0.0; });
}

TEST(SolveWithIpopt, PassesOnWhatACallbackThrows) {
  Disc disc;
  IpoptSettings settings;
  settings.on_iteration = [](const IterationRecord& record, const VectorXd&) {
    if (record.iteration == 2) throw std::out_of_range("two");
    return true;
  };
  EXPECT_THROW(SolveWithIpopt(&disc, Point(0.1, 0.2), settings),
               std::out_of_range);
  // Nothing is left locked.
  EXPECT_EQ(SolveWithIpopt(&disc, Point(0.1, 0.2), {}).status,
            SolveStatus::kConverged);
}

TEST(SolveWithIpopt, IsStoppedByCancelBuildsAndNoLaterOneIs) {
  Disc disc;
  int iterations = 0;
  IpoptSettings settings;
  settings.on_iteration = [&](const IterationRecord&, const VectorXd&) {
    ++iterations;
    CancelBuilds();
    return true;
  };
  EXPECT_THROW(SolveWithIpopt(&disc, Point(0.1, 0.2), settings),
               BuildCancelled);
  EXPECT_EQ(iterations, 1) << "the next iteration looks first";
  EXPECT_EQ(SolveWithIpopt(&disc, Point(0.1, 0.2), {}).status,
            SolveStatus::kConverged);
}

// Rows that build contact spaces or ask for depths are stopped by it as well.
class CancelledDisc : public Disc {
 public:
  bool Constraints(const double* x, double* values, double* jacobian) override {
    if (accepted.empty() || is_over) {
      return Disc::Constraints(x, values, jacobian);
    }
    is_over = true;
    CancelBuilds();
    throw BuildCancelled("a depth was cancelled");
  }

  bool is_over = false;
};

TEST(SolveWithIpopt, IsStoppedWhereItsRowsAre) {
  CancelledDisc disc;
  EXPECT_THROW(SolveWithIpopt(&disc, Point(0.1, 0.2), {}), BuildCancelled);
  Disc next;
  EXPECT_EQ(SolveWithIpopt(&next, Point(0.1, 0.2), {}).status,
            SolveStatus::kConverged);
}

TEST(SolveWithIpopt, TellsWhyItStopped) {
  const VectorXd start = Point(0.1, 0.2);
  Disc disc;
  IpoptSettings settings;
  settings.max_iterations = 2;
  EXPECT_EQ(SolveWithIpopt(&disc, start, settings).status,
            SolveStatus::kIterationLimit);
  settings = {};
  settings.time_limit = 1e-9;
  EXPECT_EQ(SolveWithIpopt(&disc, start, settings).status,
            SolveStatus::kTimeLimit);
  settings = {};
  std::vector<IterationRecord> seen;
  settings.on_iteration = [&](const IterationRecord& r, const VectorXd& x) {
    seen.push_back(r);
    EXPECT_EQ(r.objective, disc.Objective(x.data()));
    return seen.size() < 3;
  };
  const IpoptRun cancelled = SolveWithIpopt(&disc, start, settings);
  EXPECT_EQ(cancelled.status, SolveStatus::kCancelled);
  EXPECT_EQ(cancelled.raw_status, "User_Requested_Stop");
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_TRUE(cancelled.x.allFinite());
  disc.refuses = true;
  const IpoptRun refused = SolveWithIpopt(&disc, start, {});
  EXPECT_FALSE(IsClassOk(refused.status));
  EXPECT_FALSE(refused.is_feasible);
  EXPECT_TRUE(std::isfinite(refused.violation));
  EXPECT_TRUE(std::isfinite(refused.objective));
}

// A wrong gradient keeps Ipopt from converging; the best feasible iterate is
// what comes back.
TEST(SolveWithIpopt, StallReturnsTheBestFeasibleIterate) {
  Disc disc;
  disc.radius_squared = 100.0;  // inactive
  disc.lie = 0.3;
  IpoptSettings settings;
  settings.stall_iterations = 5;
  settings.ipopt_options["tol"] = "1e-14";
  settings.ipopt_options["acceptable_iter"] = "0";
  const IpoptRun run = SolveWithIpopt(&disc, Point(5.0, 5.0), settings);
  if (run.status == SolveStatus::kStalledFeasible) {
    EXPECT_TRUE(run.is_feasible);
    EXPECT_LT(run.iterations, 60);
  }
  double best = std::numeric_limits<double>::infinity();
  for (const IterationRecord& record : run.log) {
    if (record.violation <= kFeasibility) {
      best = std::min(best, record.objective);
    }
  }
  EXPECT_EQ(run.objective, best);
}

TEST(SolveWithIpopt, GivesTheSameBytesAndLetsThreadsWait) {
  const auto solve = [] {
    Disc disc;
    disc.tilt = 0.3;
    return SolveWithIpopt(&disc, Point(0.3, 0.7), {}).x;
  };
  const VectorXd expected = solve();
  std::vector<VectorXd> found(4);
  std::vector<std::thread> threads;
  for (VectorXd& x : found) threads.emplace_back([&] { x = solve(); });
  for (std::thread& thread : threads) thread.join();
  for (const VectorXd& x : found) EXPECT_EQ(x, expected);
}

}  // namespace
}  // namespace phongpd
