// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/convergence_duels.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/bench/paired_test.h"

namespace phongpd::bench {
namespace {

constexpr double kNormal95 = 1.959964;

std::string Verdict(int wins, int losses, double p) {
  if (p >= kLevel) return "tie";
  return wins > losses ? "win" : "**loss**";
}

std::string Interval(double middle, double low, double high) {
  return Rounded(middle) + " (" + Rounded(low) + " … " + Rounded(high) + ")";
}

}  // namespace

std::string Duel::SolvedVerdict() const {
  return Verdict(only_own, only_rival, p_solved);
}

std::string Duel::IterationsVerdict() const {
  return Verdict(fewer, more, p_iterations);
}

std::string Duel::SolvedEffect() const {
  const double n = std::max(1, problems);
  const double apart = only_own - only_rival;
  const double half =
      kNormal95 * std::sqrt(only_own + only_rival - apart * apart / n) / n;
  return Interval(100.0 * apart / n, 100.0 * (apart / n - half),
                  100.0 * (apart / n + half));
}

std::string Duel::IterationsEffect() const {
  if (ratios.empty()) return "–";
  // As many order statistics to either side as a fair coin leaves in 95 %.
  std::vector<double> sorted = ratios;
  std::sort(sorted.begin(), sorted.end());
  const double n = static_cast<double>(sorted.size());
  const double rank = 0.5 * n - 0.5 * kNormal95 * std::sqrt(n);
  const auto low = static_cast<std::size_t>(std::max(0.0, std::floor(rank)));
  return Interval(Quantile(sorted, 0.5), sorted[low],
                  sorted[sorted.size() - 1 - low]);
}

Arena::Arena(const std::vector<nlohmann::ordered_json>& rows) {
  for (const nlohmann::ordered_json& row : rows) {
    runs_[{RowText(row, "protocol"), RowText(row, "scene")}]
         [row.at("seed").get<long>()][RowText(row, "method")] = {
             row.at("solved").get<bool>(), RowNumber(row, "iterations")};
  }
}

Duel Arena::Fight(const std::string& protocol, const std::string& own,
                  const std::string& rival,
                  const std::vector<std::string>& scenes) const {
  Duel duel;
  for (const std::string& scene : scenes) {
    const auto seeds = runs_.find({protocol, scene});
    if (seeds == runs_.end()) continue;
    for (const auto& [seed, methods] : seeds->second) {
      const auto a = methods.find(own), b = methods.find(rival);
      if (a == methods.end() || b == methods.end()) continue;
      ++duel.problems;
      const Run& mine = a->second;
      const Run& other = b->second;
      duel.only_own += mine.is_solved && !other.is_solved;
      duel.only_rival += other.is_solved && !mine.is_solved;
      if (!mine.is_solved && !other.is_solved) continue;
      const bool are_both = mine.is_solved && other.is_solved;
      duel.fewer +=
          are_both ? mine.iterations < other.iterations : mine.is_solved;
      duel.more +=
          are_both ? mine.iterations > other.iterations : other.is_solved;
      if (are_both) {
        duel.ratios.push_back(mine.iterations /
                              std::max(1.0, other.iterations));
      }
    }
  }
  duel.p_solved = SignTest(duel.only_own, duel.only_rival);
  duel.p_iterations = SignTest(duel.fewer, duel.more);
  return duel;
}

void Correct(std::vector<Duel*> duels) {
  std::vector<double> p;
  for (const Duel* duel : duels) {
    p.push_back(duel->p_solved);
    p.push_back(duel->p_iterations);
  }
  p = Holm(p);
  for (std::size_t i = 0; i < duels.size(); ++i) {
    duels[i]->p_solved = p[2 * i];
    duels[i]->p_iterations = p[2 * i + 1];
  }
}

}  // namespace phongpd::bench
