// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/ipopt_options.h"

#include <IpoptConfig.h>

#include <IpIpoptApplication.hpp>
#include <IpReturnCodes.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <variant>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/exact/check_option.h"

namespace phongpd {

namespace {

// What may be set: options that change numbers and no more.  The others write
// files, print, load libraries by name, promise of the program what it does not
// keep, or are of solvers that are not used.
constexpr std::string_view kNumericOptions =
    " accept_after_max_steps accept_every_trial_step acceptable_compl_inf_tol "
    "acceptable_constr_viol_tol acceptable_dual_inf_tol acceptable_iter "
    "acceptable_obj_change_tol acceptable_tol adaptive_mu_globalization "
    "adaptive_mu_kkt_norm_type adaptive_mu_kkterror_red_fact "
    "adaptive_mu_kkterror_red_iters adaptive_mu_monotone_init_factor "
    "adaptive_mu_restore_previous_iterate alpha_for_y alpha_for_y_tol "
    "alpha_min_frac alpha_red_factor barrier_tol_factor bound_frac "
    "bound_mult_init_method bound_mult_init_val bound_mult_reset_threshold "
    "bound_push bound_relax_factor compl_inf_tol constr_mult_init_max "
    "constr_mult_reset_threshold constr_viol_tol "
    "constraint_violation_norm_type corrector_compl_avrg_red_fact "
    "corrector_type delta derivative_test derivative_test_perturbation "
    "derivative_test_tol diverging_iterates_tol dual_inf_tol eta_phi "
    "evaluate_orig_obj_at_resto_trial expect_infeasible_problem "
    "expect_infeasible_problem_ctol expect_infeasible_problem_ytol "
    "fast_step_computation filter_margin_fact filter_max_margin "
    "filter_reset_trigger first_hessian_perturbation fixed_mu_oracle "
    "fixed_variable_treatment gamma_phi gamma_theta hessian_approximation "
    "honor_original_bounds jacobian_regularization_exponent "
    "jacobian_regularization_value kappa_d kappa_sigma kappa_soc "
    "least_square_init_duals least_square_init_primal "
    "limited_memory_aug_solver limited_memory_init_val "
    "limited_memory_init_val_max limited_memory_init_val_min "
    "limited_memory_initialization limited_memory_max_history "
    "limited_memory_max_skipping limited_memory_update_type "
    "line_search_method linear_scaling_on_demand linear_solver "
    "linear_system_scaling max_cpu_time max_filter_resets "
    "max_hessian_perturbation max_iter max_refinement_steps max_resto_iter "
    "max_soc max_soft_resto_iters max_wall_time mehrotra_algorithm "
    "min_hessian_perturbation min_refinement_steps "
    "mu_allow_fast_monotone_decrease mu_init mu_linear_decrease_factor mu_max "
    "mu_max_fact mu_min mu_oracle mu_strategy mu_superlinear_decrease_power "
    "mu_target mumps_dep_tol mumps_mem_percent mumps_permuting_scaling "
    "mumps_pivot_order mumps_pivtol mumps_pivtolmax mumps_scaling "
    "neg_curv_test_tol nlp_lower_bound_inf nlp_scaling_constr_target_gradient "
    "nlp_scaling_max_gradient nlp_scaling_method nlp_scaling_min_value "
    "nlp_scaling_obj_target_gradient nlp_upper_bound_inf nu_inc nu_init "
    "obj_max_inc obj_scaling_factor perturb_always_cd perturb_dec_fact "
    "perturb_inc_fact perturb_inc_fact_first point_perturbation_radius "
    "quality_function_balancing_term quality_function_centrality "
    "quality_function_max_section_steps quality_function_norm_type "
    "quality_function_section_qf_tol quality_function_section_sigma_tol "
    "recalc_y recalc_y_feas_tol required_infeasibility_reduction "
    "residual_improvement_factor residual_ratio_max residual_ratio_singular "
    "resto_failure_feasibility_threshold resto_penalty_parameter "
    "resto_proximity_weight rho s_max s_phi s_theta sigma_max sigma_min "
    "skip_corr_if_neg_curv skip_corr_in_monotone_mode slack_bound_frac "
    "slack_bound_push slack_move soft_resto_pderror_reduction_factor tau_min "
    "theta_max_fact theta_min_fact tiny_step_tol tiny_step_y_tol tol "
    "watchdog_shortened_iter_trigger watchdog_trial_iter_max ";

// The values of such options that Ipopt can be built without: of linear_solver
// and nlp_scaling_method there are some with which it then ends the process,
// and others search for a library.
struct Choice {
  std::string_view name;
  std::string_view values[2];
};
constexpr Choice kChoices[] = {
    {"linear_solver", {"mumps", "mumps"}},
    {"linear_system_scaling", {"none", "slack-based"}},
    {"nlp_scaling_method", {"none", "gradient-based"}}};

void FailOption(const std::string& name, const std::string& expected,
                const std::string& found) {
  throw InputError("Ipopt option '" + name + "': expected " + expected +
                   ", found '" + found + "'");
}

// For messages, and as the word that it may be.
std::string TextOf(const IpoptValue& value) {
  if (const int* whole = std::get_if<int>(&value)) {
    return std::to_string(*whole);
  }
  if (const double* number = std::get_if<double>(&value)) {
    return FormatDouble(*number);
  }
  return std::get<std::string>(value);
}

// The whole text as a finite number.
double ParseNumber(const std::string& name, const std::string& text) {
  std::size_t used = 0;
  double value = std::numeric_limits<double>::quiet_NaN();
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || !std::isfinite(value)) {
    FailOption(name, "a number", text);
  }
  return value;
}

double NumberOf(const std::string& name, const IpoptValue& value) {
  if (const int* whole = std::get_if<int>(&value)) return *whole;
  if (const auto* text = std::get_if<std::string>(&value)) {
    return ParseNumber(name, *text);
  }
  const double number = std::get<double>(value);
  if (!std::isfinite(number)) FailOption(name, "a number", TextOf(value));
  return number;
}

// Throws unless a user may set the option to this.
void RequireNumeric(const std::string& name, const IpoptValue& value) {
  if (kNumericOptions.find(" " + name + " ") == std::string_view::npos) {
    throw InputError("Ipopt option '" + name +
                     "': expected one that changes numbers only, found one "
                     "that does more; leave it out");
  }
  const std::string text = TextOf(value);
  for (const auto& [of, values] : kChoices) {
    if (name != of || text == values[0] || text == values[1]) continue;
    FailOption(
        name,
        std::string(values[0]) +
            (values[0] == values[1] ? "" : " or " + std::string(values[1])),
        text);
  }
}

void ApplyOne(const std::string& name, const IpoptValue& value,
              Ipopt::IpoptApplication* application) {
  const Ipopt::SmartPtr<const Ipopt::RegisteredOption> option =
      application->RegOptions()->GetOption(name);
  if (!Ipopt::IsValid(option)) {
    throw InputError("Ipopt option '" + name +
                     "': Ipopt has no option of that name, see its manual");
  }
  const Ipopt::SmartPtr<Ipopt::OptionsList> options = application->Options();
  bool is_set = false;
  const std::string text = TextOf(value);
  if (option->Type() == Ipopt::OT_String) {
    if (!option->IsValidStringSetting(text)) {
      FailOption(name, "one of Ipopt's settings", text);
    }
    is_set = options->SetStringValue(name, text);
  } else {
    const double number = NumberOf(name, value);
    if (option->Type() == Ipopt::OT_Number) {
      if (!option->IsValidNumberSetting(number)) {
        FailOption(name, "a number in Ipopt's range", text);
      }
      is_set = options->SetNumericValue(name, number);
    } else {
      const auto whole =
          static_cast<Ipopt::Index>(std::abs(number) < 2e9 ? number : 0.0);
      if (number != whole || !option->IsValidIntegerSetting(whole)) {
        FailOption(name, "a whole number in Ipopt's range", text);
      }
      is_set = options->SetIntegerValue(name, whole);
    }
  }
  if (!is_set) FailOption(name, "a value Ipopt accepts", text);
}

}  // namespace

const char* ToString(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kAcceptable:
      return "acceptable";
    case SolveStatus::kStalledFeasible:
      return "stalled_feasible";
    case SolveStatus::kInfeasible:
      return "infeasible";
    case SolveStatus::kIterationLimit:
      return "iteration_limit";
    case SolveStatus::kTimeLimit:
      return "time_limit";
    case SolveStatus::kCancelled:
      return "cancelled";
    case SolveStatus::kNumerical:
      return "numerical";
    case SolveStatus::kInvalidProblem:
      return "invalid_problem";
    case SolveStatus::kInvalidStart:
      return "invalid_start";
    case SolveStatus::kInvalidGoal:
      return "invalid_goal";
  }
  return "unknown";
}

bool IsClassOk(SolveStatus status) {
  return status == SolveStatus::kConverged ||
         status == SolveStatus::kAcceptable ||
         status == SolveStatus::kStalledFeasible;
}

void IpoptSettings::Validate() const {
  const auto check = [](bool holds, const char* name, const char* range,
                        auto value) {
    CheckOption(holds, "Ipopt settings", name, range, value);
  };
  check(max_iterations >= 0, "max_iterations", "≥ 0", max_iterations);
  check(stall_iterations >= 0, "stall_iterations", "≥ 0", stall_iterations);
  check(time_limit > 0.0, "time_limit", "> 0 seconds", time_limit);
}

const char* IpoptVersion() { return IPOPT_VERSION; }

void ApplyIpoptOptions(const IpoptSettings& settings,
                       const std::string& linear_solver,
                       Ipopt::IpoptApplication* application) {
  IpoptValues options = {
      {"linear_solver", linear_solver},
      {"linear_system_scaling", "none"},
      {"hessian_approximation", "exact"},
      {"honor_original_bounds", "yes"},  // the default changed in 3.14
      {"print_level", 0},
      {"sb", "yes"},
      {"mu_strategy",
       settings.mu_strategy == IpoptSettings::MuStrategy::kAdaptive
           ? "adaptive"
           : "monotone"},
      {"max_iter", settings.max_iterations},
      {"tol", 1e-6}};
  if (!settings.print_file.empty()) {
    options["output_file"] = settings.print_file;
    options["file_print_level"] = 5;
  }
  for (const auto& [name, value] : settings.ipopt_options) {
    if (Ipopt::IsValid(application->RegOptions()->GetOption(name))) {
      RequireNumeric(name, value);
    }  // else ApplyOne says so
    options[name] = value;
  }
  for (const auto& [name, value] : options) {
    ApplyOne(name, value, application);
  }
}

const char* IpoptStatusName(int status) {
  switch (status) {
#define PHONGPD_NAME(name) \
  case Ipopt::name:        \
    return #name
    PHONGPD_NAME(Solve_Succeeded);
    PHONGPD_NAME(Solved_To_Acceptable_Level);
    PHONGPD_NAME(Infeasible_Problem_Detected);
    PHONGPD_NAME(Search_Direction_Becomes_Too_Small);
    PHONGPD_NAME(Diverging_Iterates);
    PHONGPD_NAME(User_Requested_Stop);
    PHONGPD_NAME(Feasible_Point_Found);
    PHONGPD_NAME(Maximum_Iterations_Exceeded);
    PHONGPD_NAME(Restoration_Failed);
    PHONGPD_NAME(Error_In_Step_Computation);
    PHONGPD_NAME(Maximum_CpuTime_Exceeded);
    PHONGPD_NAME(Not_Enough_Degrees_Of_Freedom);
    PHONGPD_NAME(Invalid_Problem_Definition);
    PHONGPD_NAME(Invalid_Option);
    PHONGPD_NAME(Invalid_Number_Detected);
    PHONGPD_NAME(Unrecoverable_Exception);
    PHONGPD_NAME(NonIpopt_Exception_Thrown);
    PHONGPD_NAME(Insufficient_Memory);
    PHONGPD_NAME(Internal_Error);
#undef PHONGPD_NAME
    default:
      return "Unknown_Status";
  }
}

SolveStatus ClassifyIpoptStatus(int status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return SolveStatus::kConverged;
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Feasible_Point_Found:
      return SolveStatus::kAcceptable;
    case Ipopt::Infeasible_Problem_Detected:
      return SolveStatus::kInfeasible;
    case Ipopt::Maximum_Iterations_Exceeded:
      return SolveStatus::kIterationLimit;
    case Ipopt::Maximum_CpuTime_Exceeded:
#if IPOPT_VERSION_MAJOR > 3 || IPOPT_VERSION_MINOR >= 14
    case Ipopt::Maximum_WallTime_Exceeded:
#endif
      return SolveStatus::kTimeLimit;
    case Ipopt::User_Requested_Stop:
      return SolveStatus::kCancelled;
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
    case Ipopt::Invalid_Problem_Definition:
    case Ipopt::Invalid_Option:
      return SolveStatus::kInvalidProblem;
    default:
      return SolveStatus::kNumerical;
  }
}

}  // namespace phongpd
