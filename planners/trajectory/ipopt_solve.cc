// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/ipopt_solve.h"

#include <IpoptConfig.h>

#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>

#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"
#include "planners/trajectory/ipopt_options.h"

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

// Ipopt prints into a string.
class StringJournal : public Ipopt::Journal {
 public:
  StringJournal(std::string* text, int level)
      : Ipopt::Journal("phongpd", static_cast<Ipopt::EJournalLevel>(level)),
        text_(text) {}

 protected:
  void PrintImpl(Ipopt::EJournalCategory, Ipopt::EJournalLevel,
                 const char* text) override {
    *text_ += text;
  }
  void PrintfImpl(Ipopt::EJournalCategory, Ipopt::EJournalLevel,
                  const char* format, va_list arguments) override {
    char line[1024];
    std::vsnprintf(line, sizeof(line), format, arguments);
    *text_ += line;
  }
  void FlushBufferImpl() override {}

 private:
  std::string* text_;
};

double Finite(double value) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  return std::isnan(value) ? kLargest : std::clamp(value, -kLargest, kLargest);
}

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
      : program_(program),
        settings_(settings),
        x_(start),
        at_(start.size()),
        values_(program->rows()),
        jacobian_(program->jacobian_nonzeros()),
        x_low_(program->variables()),
        x_high_(program->variables()),
        g_low_(program->rows()),
        g_high_(program->rows()) {
    program_->Bounds(x_low_.data(), x_high_.data(), g_low_.data(),
                     g_high_.data());
  }

  IpoptRun run;

  // What made the callback stop Ipopt, if it did.
  bool has_stopped() const { return has_stopped_; }
  SolveStatus stop_status() const { return stop_status_; }

  // The point to return, once Ipopt is done.  Throws what a callback threw.
  void Finish() {
    if (failure_) std::rethrow_exception(failure_);
    if (!IsClassOk(run.status) || run.status == SolveStatus::kStalledFeasible) {
      if (has_best_) x_ = best_x_;
    }
    run.x = x_;
    run.objective = Finite(program_->Objective(x_.data()));
    run.violation = Violation(x_.data());
    run.is_feasible = run.violation <= settings_.feasibility;
    run.iterations = std::max(0, static_cast<int>(run.log.size()) - 1);
  }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag,
                    IndexStyleEnum& index_style) override {
    n = program_->variables();
    m = program_->rows();
    nnz_jac_g = program_->jacobian_nonzeros();
    nnz_h_lag = program_->hessian_nonzeros();
    index_style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l,
                       Number* g_u) override {
    program_->Bounds(x_l, x_u, g_l, g_u);
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
    value = program_->Objective(x);
    return std::isfinite(value);
  }
  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.gradient;
    program_->ObjectiveGradient(x, gradient);
    return true;
  }
  bool eval_g(Index, const Number* x, bool, Index m, Number* g) override {
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.constraints;
    if (!Evaluate(x)) return false;
    std::copy(values_.data(), values_.data() + m, g);
    return true;
  }
  bool eval_jac_g(Index, const Number* x, bool, Index, Index nonzeros,
                  Index* row, Index* col, Number* values) override {
    if (values == nullptr) {
      program_->JacobianPattern(row, col);
      return true;
    }
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.jacobian;
    if (!Evaluate(x)) return false;
    std::copy(jacobian_.data(), jacobian_.data() + nonzeros, values);
    return true;
  }
  bool eval_h(Index, const Number* x, bool, Number factor, Index,
              const Number* multipliers, bool, Index, Index* row, Index* col,
              Number* values) override {
    if (values == nullptr) {
      program_->HessianPattern(row, col);
      return true;
    }
    const TimeAdder adder(&run.seconds_callbacks);
    ++run.evaluations.hessian;
    program_->Hessian(x, factor, multipliers, values);
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
      // While the values remembered belong to another point they stem from the
      // state before this one was accepted.
      if (!IsAt(x_.data())) is_at_valid_ = false;
      record.objective = Finite(program_->Objective(x_.data()));
      record.violation = Violation(x_.data());
      if (accepted_.size() == 0 || x_ != accepted_)
        changes += program_->Accept(x_.data());
      accepted_ = x_;
    }
    record.branch_changes = changes;
    run.restoration_iterations += record.is_restoration ? 1 : 0;
    if (!record.is_restoration) {
      run.dual_infeasibility = record.dual_infeasibility;
    }
    run.log.push_back(record);
    if (settings_.on_iteration) settings_.on_iteration(record);
    return MustStop(record);
  }

  bool IsAt(const double* x) const {
    return is_at_valid_ && std::memcmp(x, at_.data(),
                                       static_cast<std::size_t>(at_.size()) *
                                           sizeof(double)) == 0;
  }
  bool Evaluate(const double* x) {
    if (IsAt(x)) return true;
    is_at_valid_ = false;
    if (!program_->Constraints(x, values_.data(), jacobian_.data())) {
      return false;
    }
    std::copy(x, x + at_.size(), at_.data());
    is_at_valid_ = true;
    return true;
  }

  // Largest violation of a row or bound.
  double Violation(const double* x) {
    if (!Evaluate(x)) return std::numeric_limits<double>::max();
    double most = 0.0;
    for (Index i = 0; i < values_.size(); ++i) {
      most = std::max({most, g_low_[i] - values_[i], values_[i] - g_high_[i]});
    }
    for (Index i = 0; i < at_.size(); ++i) {
      most = std::max({most, x_low_[i] - x[i], x[i] - x_high_[i]});
    }
    return Finite(most);
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
    Ipopt::SmartPtr<const Ipopt::Vector> current = data->curr()->x();
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
          dynamic_cast<const Ipopt::CompoundVector*>(Ipopt::GetRawPtr(current));
      if (compound == nullptr) return false;
      current = compound->GetComp(0);
    }
    if (adapter_ == nullptr) return false;
    adapter_->ResortX(*current, x.data());
#endif
    if (!x.allFinite()) return false;
    x_ = x;
    return true;
  }

  bool Stop(SolveStatus status) {
    has_stopped_ = true;
    stop_status_ = status;
    return true;
  }

  bool MustStop(const IterationRecord& record) {
    if (record.violation <= settings_.feasibility) {
      if (!has_best_ || record.objective < best_objective_) {
        best_x_ = x_;
        best_objective_ = record.objective;
      }
      const double gain =
          settings_.stall_improvement * std::abs(stall_reference_);
      if (!has_best_ || record.objective < stall_reference_ - gain) {
        stall_reference_ = record.objective;
        stalled_ = -1;
      }
      has_best_ = true;
    }
    ++stalled_;
    if (settings_.is_cancelled && settings_.is_cancelled()) {
      return Stop(SolveStatus::kCancelled);
    }
    if (stopwatch_.Seconds() > settings_.time_limit) {
      return Stop(SolveStatus::kTimeLimit);
    }
    if (settings_.stall_stop && has_best_ &&
        stalled_ >= settings_.stall_iterations) {
      return Stop(SolveStatus::kStalledFeasible);
    }
    return false;
  }

  NonlinearProgram* program_;
  const IpoptSettings& settings_;
  Stopwatch stopwatch_;
  VectorXd x_;         // last accepted iterate
  VectorXd accepted_;  // the last one the program was told
  // Values and Jacobian at at_, the bytes of the last point evaluated.
  VectorXd at_, values_, jacobian_;
  bool is_at_valid_ = false;
  VectorXd x_low_, x_high_, g_low_, g_high_;
  VectorXd best_x_;
  bool has_best_ = false;
  double best_objective_ = 0.0;
  double stall_reference_ = 0.0;
  int stalled_ = 0;
  Index last_iteration_ = -1;
  bool has_stopped_ = false;
  SolveStatus stop_status_ = SolveStatus::kCancelled;
  std::exception_ptr failure_;  // of a callback
#ifndef PHONGPD_IPOPT_HAS_CURRENT_ITERATE
  Ipopt::TNLPAdapter* adapter_ = nullptr;
#endif
};

}  // namespace

void CheckIpoptOptions(const IpoptSettings& settings) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
      new Ipopt::IpoptApplication(false);
  ApplyIpoptOptions(settings, Ipopt::GetRawPtr(application));
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
  // MUMPS keeps global state.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  const Stopwatch stopwatch;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
      new Ipopt::IpoptApplication(false);  // no console
  ApplyIpoptOptions(settings, Ipopt::GetRawPtr(application));
  if (settings.output != nullptr) {
    Index level = 0;
    application->Options()->GetIntegerValue("print_level", level, "");
    application->Jnlst()->AddJournal(new StringJournal(settings.output, level));
  }
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
      status == Ipopt::User_Requested_Stop && adapter->has_stopped()
          ? adapter->stop_status()
          : ClassifyIpoptStatus(status);
  adapter->Finish();
  adapter->run.seconds_total = stopwatch.Seconds();
  return adapter->run;
}

}  // namespace phongpd
