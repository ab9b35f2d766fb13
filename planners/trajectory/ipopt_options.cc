// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/ipopt_options.h"

#include <IpoptConfig.h>

#include <IpIpoptApplication.hpp>
#include <IpReturnCodes.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/mesh/mesh_error.h"
#include "planners/exact/check_option.h"

namespace phongpd {

namespace {

void FailOption(const std::string& name, const std::string& expected,
                const std::string& found) {
  throw InputError("Ipopt option '" + name + "': expected " + expected +
                   ", found '" + found + "'");
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

void ApplyOne(const std::string& name, const std::string& text,
              Ipopt::IpoptApplication* application) {
  const Ipopt::SmartPtr<const Ipopt::RegisteredOption> option =
      application->RegOptions()->GetOption(name);
  if (!Ipopt::IsValid(option)) {
    throw InputError("Ipopt option '" + name +
                     "': Ipopt has no option of that name, see its manual");
  }
  const Ipopt::SmartPtr<Ipopt::OptionsList> options = application->Options();
  bool is_set = false;
  if (option->Type() == Ipopt::OT_String) {
    if (!option->IsValidStringSetting(text)) {
      FailOption(name, "one of Ipopt's settings", text);
    }
    is_set = options->SetStringValue(name, text);
  } else {
    const double value = ParseNumber(name, text);
    if (option->Type() == Ipopt::OT_Number) {
      if (!option->IsValidNumberSetting(value)) {
        FailOption(name, "a number in Ipopt's range", text);
      }
      is_set = options->SetNumericValue(name, value);
    } else {
      const auto whole = static_cast<Ipopt::Index>(
          std::abs(value) < 2e9 ? value : std::nan(""));
      if (value != whole || !option->IsValidIntegerSetting(whole)) {
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
  std::map<std::string, std::string> options = {
      {"linear_solver", linear_solver},
      {"linear_system_scaling", "none"},
      {"hessian_approximation", "exact"},
      {"honor_original_bounds", "yes"},  // the default changed in 3.14
      {"print_level", "0"},
      {"sb", "yes"},
      {"mu_strategy",
       settings.mu_strategy == IpoptSettings::MuStrategy::kAdaptive
           ? "adaptive"
           : "monotone"},
      {"max_iter", std::to_string(settings.max_iterations)},
      {"tol", "1e-6"}};
  for (const auto& [name, value] : settings.ipopt_options) {
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
