// SPDX-License-Identifier: GPL-3.0-or-later
// What scenes may tell Ipopt: whatever it is, a file stays as it is and the
// process goes on.
#include "planners/trajectory/ipopt_options.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Core>
#include <IpIpoptApplication.hpp>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using Eigen::VectorXd;

// min x² + y²  s.t.  x y ≥ 1: two solutions, the Hessian is indefinite.
class Hyperbola : public NonlinearProgram {
 public:
  int variables() const override { return 2; }
  int rows() const override { return 1; }
  int jacobian_nonzeros() const override { return 2; }
  int hessian_nonzeros() const override { return 3; }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override {
    x_low[0] = x_low[1] = -2e19;
    x_high[0] = x_high[1] = g_high[0] = 2e19;
    g_low[0] = 1.0;
  }
  void JacobianPattern(int* row, int* col) const override {
    row[0] = row[1] = col[0] = 0;
    col[1] = 1;
  }
  void HessianPattern(int* row, int* col) const override {
    row[0] = col[0] = col[1] = 0;
    row[1] = row[2] = col[2] = 1;
  }
  double Objective(const double* x) const override {
    return x[0] * x[0] + x[1] * x[1];
  }
  void ObjectiveGradient(const double* x, double* g) const override {
    g[0] = 2.0 * x[0];
    g[1] = 2.0 * x[1];
  }
  bool Constraints(const double* x, double* values, double* jacobian) override {
    values[0] = x[0] * x[1];
    jacobian[0] = x[1];
    jacobian[1] = x[0];
    return true;
  }
  void Hessian(const double* /*x*/, double factor, const double* multipliers,
               double* values) const override {
    values[0] = values[2] = 2.0 * factor;
    values[1] = multipliers[0];
  }
};

struct Option {
  std::string name;
  std::vector<std::string> values;  // all words, or numbers at the extremes
};

std::vector<Option> AllOptions() {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
      new Ipopt::IpoptApplication(false);
  std::vector<Option> options;
  for (const auto& [name, option] :
       application->RegOptions()->RegisteredOptionsList()) {
    Option one = {name, {}};
    if (option->Type() == Ipopt::OT_String) {
      for (const auto& word : option->GetValidStrings()) {
        one.values.push_back(word.value_ == "*" ? "file.txt" : word.value_);
      }
    } else if (option->Type() == Ipopt::OT_Number) {
      one.values = {"0", "1e-300", "1e-9", "0.5", "1", "1e10", "1e300", "-1"};
    } else {
      one.values = {"0", "1", "2",   "3",          "4", "5",
                    "6", "7", "100", "2000000000", "-1"};
    }
    options.push_back(one);
  }
  return options;
}

class IpoptOptions : public testing::TemporaryFolder {
 protected:
  // What solving with that option set to each of its values throws, "answer" if
  // it answers, in a process of its own; fewer if that did not come to its end.
  std::vector<std::string> Outcomes(const Option& option) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(3);
      for (const std::string& value : option.values) {
        const std::string line = Outcome(option.name, value) + '\n';
        if (write(ends[1], line.data(), line.size()) < 0) _exit(3);
      }
      _exit(0);
    }
    close(ends[1]);
    std::string all;
    char buffer[4096];
    for (ssize_t size; (size = read(ends[0], buffer, sizeof buffer)) > 0;) {
      all.append(buffer, static_cast<std::size_t>(size));
    }
    close(ends[0]);
    waitpid(child, nullptr, 0);
    std::vector<std::string> lines;
    std::istringstream stream(all);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

 private:
  static std::string Outcome(const std::string& name,
                             const std::string& value) {
    IpoptSettings settings;
    settings.max_iterations = 20;
    settings.time_limit = 10.0;
    if (name.rfind("limited_memory", 0) == 0) {
      settings.ipopt_options["hessian_approximation"] = "limited-memory";
    }
    settings.ipopt_options[name] = value;
    return testing::ErrorOf(
        [&] {
          Hyperbola program;
          SolveWithIpopt(&program, VectorXd::Constant(2, 0.3), settings);
        },
        "answer");
  }
};

TEST_F(IpoptOptions, NeitherWriteFilesNorEndTheProcessWhateverTheyAre) {
  int answers = 0, refusals = 0;
  std::set<std::string> taken;
  for (const Option& option : AllOptions()) {
    const std::vector<std::string> outcomes = Outcomes(option);
    EXPECT_EQ(outcomes.size(), option.values.size())
        << option.name << " ended the process";
    for (const std::string& what : outcomes) {
      if (what == "answer") {
        ++answers;
        taken.insert(option.name);
        continue;
      }
      ++refusals;
      EXPECT_EQ(what.rfind("Ipopt option '" + option.name + "': expected ", 0),
                0U)
          << what;
    }
    EXPECT_TRUE(Names().empty()) << option.name;
  }
  EXPECT_GT(answers, 500);
  EXPECT_GT(refusals, 100);
  for (const char* name :
       {"tol", "max_iter", "mu_strategy", "mu_init", "nlp_scaling_method",
        "linear_solver", "acceptable_tol", "hessian_approximation"}) {
    EXPECT_EQ(taken.count(name), 1U) << name;
  }
  for (const char* name :
       {"output_file", "option_file_name", "print_level", "file_print_level",
        "print_options_documentation", "print_user_options", "sb",
        "skip_finalize_solution_call", "dependency_detector",
        "suppress_all_output", "replace_bounds", "warm_start_same_structure"}) {
    EXPECT_EQ(taken.count(name), 0U) << name;
  }
}

TEST_F(IpoptOptions, OfOneAtATimeSayWhatIsTaken) {
  const auto refusal = [&](const char* name, const IpoptValue& value) {
    IpoptSettings settings;
    settings.ipopt_options[name] = value;
    return testing::ErrorOf([&] { CheckIpoptOptions(settings); });
  };
  EXPECT_EQ(refusal("output_file", "a.txt"),
            "Ipopt option 'output_file': expected one that changes numbers "
            "only, found one that does more; leave it out");
  EXPECT_EQ(refusal("nlp_scaling_method", "equilibration-based"),
            "Ipopt option 'nlp_scaling_method': expected none or "
            "gradient-based, found 'equilibration-based'");
  EXPECT_EQ(refusal("linear_solver", "ma97"),
            "Ipopt option 'linear_solver': expected mumps, found 'ma97'");
  EXPECT_EQ(refusal("nlp_scaling_method", "none"), "");
  EXPECT_EQ(refusal("linear_solver", "mumps"), "");
  // Numbers as numbers.
  EXPECT_EQ(refusal("tol", 1), "");
  EXPECT_EQ(refusal("tol", std::nan("")),
            "Ipopt option 'tol': expected a number, found 'nan'");
  EXPECT_EQ(refusal("tol", -0.5),
            "Ipopt option 'tol': expected a number in Ipopt's range, found "
            "'-0.5'");
  EXPECT_EQ(refusal("max_iter", 2.5),
            "Ipopt option 'max_iter': expected a whole number in Ipopt's "
            "range, found '2.5'");
  EXPECT_EQ(refusal("max_iter", 1e300),
            "Ipopt option 'max_iter': expected a whole number in Ipopt's "
            "range, found '1e+300'");
  EXPECT_EQ(refusal("mu_strategy", 3),
            "Ipopt option 'mu_strategy': expected one of Ipopt's settings, "
            "found '3'");
}

// Ipopt's own store, which keeps six digits, has what was given.
TEST_F(IpoptOptions, ReachIpoptAsTheyAre) {
  const double tolerance = 1.23456e-7;
  IpoptSettings settings;
  settings.max_iterations = 17;
  settings.ipopt_options = {{"tol", tolerance},
                            {"acceptable_tol", "1e-5"},
                            {"mu_init", 2},
                            {"acceptable_iter", 3.0},
                            {"mu_oracle", "probing"}};
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
      new Ipopt::IpoptApplication(false);
  ApplyIpoptOptions(settings, "mumps", Ipopt::GetRawPtr(application));
  const auto number = [&](const char* name) {
    double value = 0.0;
    EXPECT_TRUE(application->Options()->GetNumericValue(name, value, ""));
    return value;
  };
  const auto whole = [&](const char* name) {
    Ipopt::Index value = 0;
    EXPECT_TRUE(application->Options()->GetIntegerValue(name, value, ""));
    return value;
  };
  EXPECT_EQ(number("tol"), tolerance);
  EXPECT_EQ(number("acceptable_tol"), 1e-5);
  EXPECT_EQ(number("mu_init"), 2.0);
  EXPECT_EQ(whole("acceptable_iter"), 3);
  EXPECT_EQ(whole("max_iter"), 17);
  std::string word;
  EXPECT_TRUE(application->Options()->GetStringValue("mu_oracle", word, ""));
  EXPECT_EQ(word, "probing");
}

}  // namespace
}  // namespace phongpd
