// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives against Ipopt's own checker and against differences of the
// Lagrangian; what the solver accepts against what it prints.
#include "planners/trajectory/trajectory_nlp.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "planners/trajectory/ipopt_solve.h"
#include "problems/shapes/shapes.h"
#include "tests/support/printed_by_ipopt.h"
#include "tests/support/trap.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::Trap;

// A way through the arms of the trap.
TrajectoryProblem TrapProblem(JacobianKind jacobian, int waypoints) {
  SignedMetricOptions options;
  options.jacobian = jacobian;
  TrajectoryProblem problem =
      testing::TrapProblem({0.1, -1.9, 0.05}, {0.2, 1.9, -0.05}, options);
  problem.waypoints = waypoints;
  return problem;
}

TrajectoryNlp MakeNlp(const TrajectoryProblem& problem, int samples,
                      int rows = 1) {
  return TrajectoryNlp(
      problem,
      std::vector<int>(static_cast<std::size_t>(problem.waypoints) + 1,
                       samples),
      0.0, rows);
}

VectorXd Noisy(const TrajectoryNlp& nlp, const TrajectoryProblem& problem,
               double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  VectorXd u = nlp.ToVariables(StraightPath(problem));
  for (double& x : u) x += uniform(random);
  return u;
}

// Ipopt's own checker at u, of "first-order" or "second-order"; *text is what
// it prints.
bool PassesChecker(TrajectoryNlp* nlp, const VectorXd& u,
                   const std::string& order, std::string* text) {
  nlp->Start(u);
  IpoptSettings settings;
  settings.max_iterations = 0;
  settings.ipopt_options = {{"derivative_test", order},
                            {"derivative_test_tol", "1e-5"},
                            {"point_perturbation_radius", "0"}};
  IpoptRun run;
  *text = testing::PrintedByIpopt(nlp, u, settings, &run);
  return text->find("No errors detected by derivative checker") !=
         std::string::npos;
}

TEST(TrajectoryNlp, PassesIpoptsDerivativeCheckerAtSmoothPoints) {
  const TrajectoryProblem problem = TrapProblem(JacobianKind::kExact, 6);
  TrajectoryNlp nlp = MakeNlp(problem, 2, 2);
  int points = 0, inside = 0;
  for (unsigned seed = 0; points < 100; ++seed) {
    const VectorXd u = Noisy(nlp, problem, 0.1, seed);
    // Capped rows are not the derivative, by design.
    bool is_capped = false;
    for (int s = 0; s < nlp.contact().samples(); ++s) {
      const MetricRow row =
          problem.metrics[0]->Query(nlp.contact().SamplePoint(s, u.data()));
      is_capped = is_capped || row.is_capped;
      inside += row.inside ? 1 : 0;
    }
    if (is_capped) continue;
    ++points;
    std::string text;
    EXPECT_TRUE(PassesChecker(&nlp, u, "first-order", &text))
        << "seed " << seed << "\n"
        << text;
  }
  EXPECT_GT(inside, 300);
}

TEST(TrajectoryNlp, HessianIsTheDerivativeOfTheSmoothRowsGradient) {
  const TrajectoryProblem problem = TrapProblem(JacobianKind::kDirection, 5);
  TrajectoryNlp nlp = MakeNlp(problem, 1);
  const VectorXd u = Noisy(nlp, problem, 0.1, 1);
  nlp.Start(u);
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  // Contact rows have multiplier zero here: the Hessian leaves them out.
  VectorXd multipliers = VectorXd::Zero(nlp.rows());
  for (int i = nlp.contact().rows(); i < nlp.rows(); ++i) {
    multipliers[i] = normal(random);
  }
  const double factor = 0.7;
  std::vector<int> row(static_cast<std::size_t>(nlp.jacobian_nonzeros()));
  std::vector<int> col(row);
  nlp.JacobianPattern(row.data(), col.data());
  const auto gradient = [&](const VectorXd& x) {
    VectorXd g(nlp.variables()), values(nlp.rows());
    VectorXd jacobian(nlp.jacobian_nonzeros());
    nlp.ObjectiveGradient(x.data(), g.data());
    g *= factor;
    EXPECT_TRUE(nlp.Constraints(x.data(), values.data(), jacobian.data()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      g[col[i]] += multipliers[row[i]] * jacobian[static_cast<int>(i)];
    }
    return g;
  };
  std::vector<int> h_row(static_cast<std::size_t>(nlp.hessian_nonzeros()));
  std::vector<int> h_col(h_row);
  nlp.HessianPattern(h_row.data(), h_col.data());
  VectorXd h(nlp.hessian_nonzeros());
  nlp.Hessian(u.data(), factor, multipliers.data(), h.data());
  Eigen::MatrixXd dense =
      Eigen::MatrixXd::Zero(nlp.variables(), nlp.variables());
  std::set<std::pair<int, int>> entries;
  for (std::size_t i = 0; i < h_row.size(); ++i) {
    EXPECT_GE(h_row[i], h_col[i]);
    EXPECT_TRUE(entries.emplace(h_row[i], h_col[i]).second);
    dense(h_row[i], h_col[i]) = dense(h_col[i], h_row[i]) =
        h[static_cast<int>(i)];
  }
  // Quadratic: the difference is exact at any step.
  for (int j = 0; j < nlp.variables(); ++j) {
    VectorXd ahead = u, behind = u;
    ahead[j] += 0.01;
    behind[j] -= 0.01;
    const VectorXd difference = (gradient(ahead) - gradient(behind)) / 0.02;
    EXPECT_LT((difference - dense.col(j)).cwiseAbs().maxCoeff(),
              1e-9 * dense.cwiseAbs().maxCoeff());
  }
}

TEST(TrajectoryNlp, ValuesAreEnergyMarginsAndLengths) {
  const TrajectoryProblem problem = TrapProblem(JacobianKind::kDirection, 7);
  TrajectoryNlp nlp = MakeNlp(problem, 2);
  const VectorXd straight = nlp.ToVariables(StraightPath(problem));
  EXPECT_NEAR(nlp.Objective(straight.data()), 1.0, 1e-12);
  const VectorXd u = Noisy(nlp, problem, 0.1, 5);
  const Path path = nlp.ToPath(u);
  EXPECT_EQ(path.front(), problem.start);
  EXPECT_EQ(path.back(), problem.goal);
  EXPECT_NEAR(nlp.Objective(u.data()), PathEnergy(problem, path), 1e-12);
  nlp.Start(u);
  VectorXd values(nlp.rows()), jacobian(nlp.jacobian_nonzeros());
  ASSERT_TRUE(nlp.Constraints(u.data(), values.data(), jacobian.data()));
  VectorXd x_low(nlp.variables()), x_high(x_low), low(nlp.rows()), high(low);
  nlp.Bounds(x_low.data(), x_high.data(), low.data(), high.data());
  const double h = MaxSegment(problem, 0.0);
  for (int i = 0; i <= problem.waypoints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double ratio = (path[k + 1] - path[k]).norm() / h;
    const int row = nlp.contact().rows() + i;
    EXPECT_NEAR(values[row] / high[row], ratio * ratio, 1e-12);
  }
  EXPECT_EQ(low[0], problem.margin);
  EXPECT_LT(x_low[0], -1e19);
}

TEST(TrajectoryNlp, KeepsWaypointsStrictlyWithinBounds) {
  TrajectoryProblem problem = TrapProblem(JacobianKind::kDirection, 4);
  const BoundingBox bounds = {Vector3d(-3, -2.5, -2), Vector3d(3, 2.5, 4)};
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(Trap())}, bounds);
  const TrajectoryNlp nlp = MakeNlp(problem, 1);
  VectorXd low(nlp.variables()), high(low), g_low(nlp.rows()), g_high(g_low);
  nlp.Bounds(low.data(), high.data(), g_low.data(), g_high.data());
  for (const Vector3d& p : nlp.ToPath(low)) {
    EXPECT_TRUE((p.array() > bounds.min.array()).all());
  }
  for (const Vector3d& p : nlp.ToPath(high)) {
    EXPECT_TRUE((p.array() < bounds.max.array()).all());
  }
}

// Forwards to a TrajectoryNlp and remembers what the solver evaluated.
class Recorder : public TrajectoryNlp {
 public:
  using TrajectoryNlp::TrajectoryNlp;
  bool Constraints(const double* x, double* values, double* jacobian) override {
    evaluated.emplace_back(x, x + variables());
    return TrajectoryNlp::Constraints(x, values, jacobian);
  }
  int Accept(const double* x) override {
    accepted.emplace_back(x, x + variables());
    return TrajectoryNlp::Accept(x);
  }
  std::vector<std::vector<double>> evaluated, accepted;
};

// Euclid's metric and monotone mu from a straight line through a trap: many
// rejected trial points and a restoration phase.
TEST(TrajectoryNlp, IsCommittedOnlyAtAcceptedIterates) {
  SignedMetricOptions euclid;
  euclid.metric = MetricKind::kEuclidean;
  for (const bool is_phong : {true, false}) {
    TrajectoryProblem problem = TrapProblem(JacobianKind::kDirection, 40);
    if (!is_phong) {
      problem.metrics = {
          std::make_shared<SignedMetric>(TakeAsContactSpace(Trap()), euclid)};
    }
    Recorder nlp(problem, std::vector<int>(41, 2), 0.0, 1);
    const VectorXd u = nlp.ToVariables(StraightPath(problem));
    nlp.Start(u);
    IpoptSettings settings;
    settings.mu_strategy = IpoptSettings::MuStrategy::kMonotone;
    settings.stall_iterations = 0;
    const IpoptRun run = SolveWithIpopt(&nlp, u, settings);
    EXPECT_LE(nlp.accepted.size(), run.log.size());
    EXPECT_EQ(run.restoration_iterations > 0, !is_phong);
    // Nothing is evaluated twice in a row, and every accepted point was tried.
    const std::set<std::vector<double>> tried(nlp.evaluated.begin(),
                                              nlp.evaluated.end());
    for (std::size_t i = 1; i < nlp.evaluated.size(); ++i) {
      EXPECT_NE(nlp.evaluated[i], nlp.evaluated[i - 1]);
    }
    const std::set<std::vector<double>> accepted(nlp.accepted.begin(),
                                                 nlp.accepted.end());
    if (!is_phong) {
      EXPECT_GT(tried.size(), accepted.size());
    }
    long changes = 0;
    for (const std::vector<double>& x : nlp.accepted) {
      EXPECT_EQ(tried.count(x), 1u);
    }
    // The log tells the accepted iterates in their order; where a restoration
    // begins it tells one twice.
    std::size_t at = 0;
    for (const IterationRecord& record : run.log) {
      changes += record.branch_changes;
      if (record.objective != nlp.Objective(nlp.accepted[at].data())) ++at;
      ASSERT_LT(at, nlp.accepted.size());
      EXPECT_EQ(record.objective, nlp.Objective(nlp.accepted[at].data()));
    }
    EXPECT_EQ(at + 1, nlp.accepted.size());
    EXPECT_EQ(changes, nlp.counts().branch_changes);
    EXPECT_EQ(nlp.counts().warm > 0, is_phong);
  }
}

TEST(TrajectoryProblem, ChoosesSamplesByTheLipschitzRule) {
  TrajectoryProblem problem = TrapProblem(JacobianKind::kDirection, 40);
  problem.diagonal = 1.0;
  problem.start = Vector3d(0, 0, 0);
  problem.goal = Vector3d(1.3, 0, 0);
  // ρL/(N+1) = 0.0507, against 2·margin·(S+1).
  EXPECT_EQ(SamplesPerSegment(problem, 0.0), 2);
  problem.margin = 0.005;
  EXPECT_EQ(SamplesPerSegment(problem, 0.0), 5);
  problem.margin = 0.02;
  EXPECT_EQ(SamplesPerSegment(problem, 0.0), 1);
  EXPECT_EQ(SamplesPerSegment(problem, 2.6), 2);
  problem.margin = 0.0;
  EXPECT_EQ(SamplesPerSegment(problem, 0.0), 0);
  problem.margin = 1e-9;
  EXPECT_EQ(SamplesPerSegment(problem, 0.0), 1000);
  problem.samples_per_segment = 4;
  EXPECT_EQ(SamplesPerSegment(problem, 0.0), 4);
  for (double margin = 0.001; margin < 0.2; margin *= 1.07) {
    problem.samples_per_segment = 0;
    problem.margin = margin;
    const int s = SamplesPerSegment(problem, 0.0);
    EXPECT_LT(MaxSegment(problem, 0.0) / (s + 1), 2.0 * margin);
    EXPECT_GE(MaxSegment(problem, 0.0) / std::max(s, 1),
              2.0 * margin * (s > 0));
  }
}

TEST(TrajectoryProblem, NamesBadFields) {
  const TrajectoryProblem good = TrapProblem(JacobianKind::kDirection, 40);
  EXPECT_NO_THROW(good.Validate());
  const auto refused = [&](auto change) {
    TrajectoryProblem problem = good;
    change(&problem);
    EXPECT_THROW(problem.Validate(), InputError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](TrajectoryProblem* p) { p->start.x() = nan; });
  refused([&](TrajectoryProblem* p) { p->goal.z() = nan; });
  refused([&](TrajectoryProblem* p) { p->goal.z() = 1e9; });
  refused([](TrajectoryProblem* p) { p->waypoints = 0; });
  refused([](TrajectoryProblem* p) { p->samples_per_segment = -1; });
  refused([&](TrajectoryProblem* p) { p->margin = nan; });
  refused([](TrajectoryProblem* p) { p->max_segment_ratio = 0.9; });
  refused([](TrajectoryProblem* p) { p->diagonal = -1.0; });
  refused([](TrajectoryProblem* p) { p->metrics[0] = nullptr; });
  refused([](TrajectoryProblem* p) { p->free_space = nullptr; });
}

TEST(TrajectoryNlp, RefusesPointsWhoseRowsAreNotFinite) {
  const TrajectoryProblem problem = TrapProblem(JacobianKind::kExact, 3);
  TrajectoryNlp nlp = MakeNlp(problem, 1);
  const VectorXd line = nlp.ToVariables(StraightPath(problem));
  nlp.Start(line);
  VectorXd values(nlp.rows()), jacobian(nlp.jacobian_nonzeros());
  EXPECT_TRUE(nlp.Constraints(line.data(), values.data(), jacobian.data()));
  // The last is finite, but not the square of its distance.
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e200}) {
    VectorXd u = line;
    u[4] = bad;
    EXPECT_FALSE(nlp.Constraints(u.data(), values.data(), jacobian.data()));
  }
}

}  // namespace
}  // namespace phongpd
