// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "results/bench/convergence_report.h"

// Methods against each other on the same seeds.
namespace phongpd::bench {

inline constexpr double kLevel = 0.05;

// What two methods did on the same problems.
struct Duel {
  int problems = 0;
  int only_own = 0, only_rival = 0;  // solved by one alone
  // Iterations, where at least one solved it; one that did not took more than
  // any.
  int fewer = 0, more = 0;
  std::vector<double> ratios;  // own iterations over the rival's, both solved
  // Of sign tests; Correct applies Holm's correction.
  double p_solved = 1.0, p_iterations = 1.0;

  // "win", "**loss**", or "tie" where the test says nothing at kLevel.
  std::string SolvedVerdict() const;
  std::string IterationsVerdict() const;
  // Difference of the solved shares in per cent and its 95 % interval for
  // paired shares (Wald's).
  std::string SolvedEffect() const;
  // Median of the ratios and its 95 % interval by order statistics; "–" without
  // any.
  std::string IterationsEffect() const;
};

// The runs of every method by problem.
class Arena {
 public:
  explicit Arena(const std::vector<nlohmann::ordered_json>& rows);

  // Over the problems of the protocol on those scenes that both ran.
  Duel Fight(const std::string& protocol, const std::string& own,
             const std::string& rival,
             const std::vector<std::string>& scenes) const;

 private:
  struct Run {
    bool is_solved;
    double iterations;
  };
  // protocol and scene; seed; method
  std::map<std::pair<std::string, std::string>,
           std::map<long, std::map<std::string, Run>>>
      runs_;
};

// Both p values of all duels as one family of tests.
void Correct(std::vector<Duel*> duels);

}  // namespace phongpd::bench
