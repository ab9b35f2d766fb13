// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/ipopt_solve.h"

#include <IpoptConfig.h>

#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>

#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "core/stopwatch.h"
#include "planners/trajectory/evaluated_program.h"
#include "planners/trajectory/ipopt_condensed.h"
#include "planners/trajectory/ipopt_options.h"
#include "planners/trajectory/stop_rules.h"

#if IPOPT_VERSION_MAJOR > 3 || \
    (IPOPT_VERSION_MAJOR == 3 && IPOPT_VERSION_MINOR >= 14)
#define PHONGPD_IPOPT_HAS_CURRENT_ITERATE
#else
#include <IpCompoundVector.hpp>
#include <IpOrigIpoptNLP.hpp>
#include <IpTNLPAdapter.hpp>
#endif

namespace phongpd {

namespace {

using Eigen::VectorXd;
using Ipopt::Index;
using Ipopt::Number;

constexpr char kGeneralSolver[] = "mumps";

// Adds the time it lives.
class TimeAdder {
 public:
  explicit TimeAdder(double* seconds) : seconds_(seconds) {}
  ~TimeAdder() { *seconds_ += stopwatch_.Seconds(); }

 private:
  double* seconds_;
  Stopwatch stopwatch_;
};

class ProgramAdapter : public Ipopt::TNLP {
 public:
  ProgramAdapter(NonlinearProgram* program, const VectorXd& start,
                 const IpoptSettings& settings)
      : program_(*program),
        evaluated_(program),
        settings_(settings),
        stop_(settings),
        x_(start) {}

  IpoptRun run;

  // What made the callback stop Ipopt, if it did.
  std::optional<SolveStatus> stop_reason() const { return stop_.reason(); }

  // The point to return, once Ipopt is done.  Throws what a callback threw.
  void Finish() {
    if (failure_) std::rethrow_exception(failure_);
    // Rows that build something may have been stopped, too; Ipopt makes a
    // status of what they throw.
    if (!IsClassOk(run.status)) watch_.Check("the solve");
    if (!IsClassOk(run.status) || run.status == SolveStatus::kStalledFeasible) {
      if (stop_.best() != nullptr) x_ = *stop_.best();
    }
    run.x = x_;
    run.objective = evaluated_.Objective(x_.data());
    run.violation = evaluated_.Violation(x_.data());
    run.is_feasible = run.violation <= kFeasibility;
    run.iterations = std::max(0, static_cast<int>(run.log.size()) - 1);
  }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag,
                    IndexStyleEnum& index_style) override {
    n = program_.variables();
    m = program_.rows();
    nnz_jac_g = program_.jacobian_nonzeros();
    nnz_h_lag = program_.hessian_nonzeros();
    index_style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l,
                       Number* g_u) override {
    program_.Bounds(x_l, x_u, g_l, g_u);
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*,
                          Index, bool, Number*) override {
    std::copy(x_.data(), x_.data() + n, x);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.objective;
    value = program_.Objective(x);
    return std::isfinite(value);
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.gradient;
    program_.ObjectiveGradient(x, gradient);
    return std::all_of(gradient, gradient + n,
                       [](Number value) { return std::isfinite(value); });
  }
  bool eval_g(Index, const Number* x, bool, Index m, Number* g) override {
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.constraints;
    if (!evaluated_.Evaluate(x)) return false;
    std::copy_n(evaluated_.values().data(), m, g);
    return true;
  }
  bool eval_jac_g(Index, const Number* x, bool, Index, Index nonzeros,
                  Index* row, Index* col, Number* values) override {
    if (values == nullptr) {
      program_.JacobianPattern(row, col);
      return true;
    }
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.jacobian;
    if (!evaluated_.Evaluate(x)) return false;
    std::copy_n(evaluated_.jacobian().data(), nonzeros, values);
    return true;
  }
  bool eval_h(Index, const Number* x, bool, Number factor, Index,
              const Number* multipliers, bool, Index, Index* row, Index* col,
              Number* values) override {
    if (values == nullptr) {
      program_.HessianPattern(row, col);
      return true;
    }
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.hessian;
    program_.Hessian(x, factor, multipliers, values);
    return true;
  }

  bool intermediate_callback(
      Ipopt::AlgorithmMode mode, Index iteration, Number, Number, Number inf_du,
      Number mu, Number, Number, Number, Number, Index,
      const Ipopt::IpoptData* data,
      Ipopt::IpoptCalculatedQuantities* quantities) override {
    // Ipopt would turn an exception into a status.
    try {
      return !Advance(mode, iteration, inf_du, mu, data, quantities);
    } catch (...) {
      failure_ = std::current_exception();
      return false;
    }
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x,
                         const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    const Eigen::Map<const VectorXd> final_x(x, n);
    if (final_x.allFinite()) x_ = final_x;
  }

 private:
  // Notes the iterate; true if Ipopt must stop.
  bool Advance(Ipopt::AlgorithmMode mode, Index iteration, Number inf_du,
               Number mu, const Ipopt::IpoptData* data,
               Ipopt::IpoptCalculatedQuantities* quantities) {
    const TimeAdder adder(&run.seconds_callbacks);
    watch_.Check("the solve");
    // Where a restoration phase hands over, its last iterate is reported once
    // more as the first regular one.
    int changes = 0;
    if (iteration == last_iteration_ && !run.log.empty()) {
      changes = run.log.back().branch_changes;
      run.restoration_iterations -= run.log.back().is_restoration ? 1 : 0;
      run.log.pop_back();
    }
    last_iteration_ = iteration;
    IterationRecord record;
    record.violation = std::numeric_limits<double>::max();
    record.iteration = static_cast<int>(run.log.size());
    record.is_restoration = mode == Ipopt::RestorationPhaseMode;
    record.dual_infeasibility = Finite(inf_du);
    record.mu = Finite(mu);
    if (ReadIterate(mode, data, quantities)) {
      record.objective = evaluated_.Objective(x_.data());
      // From here on no values of another point are remembered, which would
      // stem from the state before this one was accepted.
      record.violation = evaluated_.Violation(x_.data());
      if (accepted_.size() == 0 || x_ != accepted_) {
        changes += program_.Accept(x_.data());
      }
      accepted_ = x_;
    }
    record.branch_changes = changes;
    run.restoration_iterations += record.is_restoration ? 1 : 0;
    if (!record.is_restoration) {
      run.dual_infeasibility = record.dual_infeasibility;
    }
    run.log.push_back(record);
    const bool goes_on =
        !settings_.on_iteration || settings_.on_iteration(record, x_);
    return stop_.MustStop(record, x_, !goes_on);
  }

  // Copies the accepted iterate into x_.
  bool ReadIterate(Ipopt::AlgorithmMode mode, const Ipopt::IpoptData* data,
                   Ipopt::IpoptCalculatedQuantities* quantities) {
    VectorXd x(x_.size());
#ifdef PHONGPD_IPOPT_HAS_CURRENT_ITERATE
    static_cast<void>(mode);
    if (!get_curr_iterate(data, quantities, false, static_cast<Index>(x.size()),
                          x.data(), nullptr, nullptr, 0, nullptr, nullptr)) {
      return false;
    }
#else
    if (data == nullptr || quantities == nullptr) return false;
    Ipopt::SmartPtr<const Ipopt::Vector> iterate = data->curr()->x();
    if (mode == Ipopt::RegularMode) {
      auto* nlp = dynamic_cast<Ipopt::OrigIpoptNLP*>(
          Ipopt::GetRawPtr(quantities->GetIpoptNLP()));
      if (nlp == nullptr) return false;
      adapter_ =
          dynamic_cast<Ipopt::TNLPAdapter*>(Ipopt::GetRawPtr(nlp->nlp()));
    } else {
      // The restoration's variables are (x, slacks…); its NLP does not know
      // the adapter, so the one of the last regular iteration sorts x.
      const auto* compound =
          dynamic_cast<const Ipopt::CompoundVector*>(Ipopt::GetRawPtr(iterate));
      if (compound == nullptr) return false;
      iterate = compound->GetComp(0);
    }
    if (adapter_ == nullptr) return false;
    adapter_->ResortX(*iterate, x.data());
#endif
    if (!x.allFinite()) return false;
    x_ = x;
    return true;
  }

  NonlinearProgram& program_;
  EvaluatedProgram evaluated_;
  const IpoptSettings& settings_;
  StopRules stop_;
  VectorXd x_;         // last accepted iterate
  VectorXd accepted_;  // the last one the program was told
  Index last_iteration_ = -1;
  std::exception_ptr failure_;  // of a callback
  const CancelWatch watch_;
#ifndef PHONGPD_IPOPT_HAS_CURRENT_ITERATE
  Ipopt::TNLPAdapter* adapter_ = nullptr;
#endif
};

// Ipopt's exceptions, which it makes of failed allocations among others, are no
// std::exception.
template <typename Work>
auto InPlainErrors(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Ipopt::IpoptException& error) {
    if (error.Message().find("memory") != std::string::npos) {
      throw std::bad_alloc();
    }
    throw std::runtime_error("Ipopt: " + error.Message());
  }
}

// The solver made for such programs, unless an equality or the settings ask for
// another.
bool WantsCondensed(const NonlinearProgram& program,
                    const IpoptSettings& settings) {
  if (!CondensedSolver::IsAvailable() ||
      settings.ipopt_options.count("linear_solver") > 0) {
    return false;
  }
  VectorXd x_low(program.variables()), x_high(program.variables());
  VectorXd g_low(program.rows()), g_high(program.rows());
  program.Bounds(x_low.data(), x_high.data(), g_low.data(), g_high.data());
  return (g_low.array() < g_high.array()).all();
}

IpoptRun Solve(NonlinearProgram* program, const VectorXd& start,
               const IpoptSettings& settings) {
  const Stopwatch stopwatch;
  std::optional<CondensedSolver> condensed;
  if (WantsCondensed(*program, settings)) condensed.emplace(program->rows());
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
      new Ipopt::IpoptApplication(false);  // no console
  ApplyIpoptOptions(settings,
                    condensed ? CondensedSolver::Name() : kGeneralSolver,
                    Ipopt::GetRawPtr(application));
  const Ipopt::SmartPtr<ProgramAdapter> adapter =
      new ProgramAdapter(program, start, settings);
  // The empty name: no ipopt.opt of the current directory changes the result.
  Ipopt::ApplicationReturnStatus status =
      application->Initialize(std::string());
  if (status == Ipopt::Solve_Succeeded) {
    const Ipopt::SmartPtr<Ipopt::TNLP> problem = Ipopt::GetRawPtr(adapter);
    status = application->OptimizeTNLP(problem);
  }
  adapter->run.raw_status = IpoptStatusName(status);
  adapter->run.status =
      status == Ipopt::User_Requested_Stop && adapter->stop_reason()
          ? *adapter->stop_reason()
          : ClassifyIpoptStatus(status);
  adapter->Finish();
  adapter->run.seconds_total = stopwatch.Seconds();
  return adapter->run;
}

}  // namespace

void CheckIpoptOptions(const IpoptSettings& settings) {
  InPlainErrors([&] {
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
        new Ipopt::IpoptApplication(false);
    ApplyIpoptOptions(settings, kGeneralSolver, Ipopt::GetRawPtr(application));
  });
}

IpoptRun SolveWithIpopt(NonlinearProgram* program, const VectorXd& start,
                        const IpoptSettings& settings) {
  settings.Validate();
  if (start.size() != program->variables() || !start.allFinite()) {
    throw InputError("Ipopt start: expected " +
                     std::to_string(program->variables()) +
                     " finite numbers, found " + std::to_string(start.size()) +
                     (start.allFinite() ? "" : " with NaN or Inf"));
  }
  // MUMPS keeps global state, and so does CondensedSolver.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  return InPlainErrors([&] { return Solve(program, start, settings); });
}

}  // namespace phongpd
