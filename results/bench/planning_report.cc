// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/planning_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "problems/output/step_figure.h"
#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

// Least length of a path known for a scene.
std::map<std::string, double> BestLengths(const PlanningResults& results) {
  std::map<std::string, double> best;
  const auto offer = [&best](const std::string& scene, double length) {
    const auto [it, is_new] = best.emplace(scene, length);
    if (!is_new) it->second = std::min(it->second, length);
  };
  for (const ExactRow& row : results.exact) {
    if (row.status == "solved") offer(row.problem.scene, row.length);
    if (row.witness_length > 0.0) offer(row.problem.scene, row.witness_length);
  }
  for (const auto* rows : {&results.samplers, &results.narrowing}) {
    for (const SamplerRow& row : *rows) {
      for (const SamplerRun& run : row.runs) {
        if (run.is_solved) offer(row.problem.scene, run.length);
      }
    }
  }
  return best;
}

int Solved(const SamplerRow& row) {
  return static_cast<int>(
      std::count_if(row.runs.begin(), row.runs.end(),
                    [](const SamplerRun& run) { return run.is_solved; }));
}

// Wilson's 95 % interval of a share, in percent.
std::string Wilson(int solved, int runs) {
  constexpr double z = 1.96;
  const double n = runs, p = solved / n;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half =
      z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return Rounded(100 * std::max(0.0, middle - half), 2) + "-" +
         Rounded(100 * std::min(1.0, middle + half), 3) + " %";
}

template <typename Value>
double Median(const SamplerRow& row, const Value& value, bool solved_only) {
  std::vector<double> values;
  for (const SamplerRun& run : row.runs) {
    if (run.is_solved || !solved_only) values.push_back(value(run));
  }
  return Quantile(values, 0.5);
}

double MedianSamples(const SamplerRow& row) {
  return Median(
      row, [](const SamplerRun& r) { return r.samples; }, false);
}

// Runs that never got there count as more than any other.
double MedianToPassage(const SamplerRow& row) {
  return Median(
      row,
      [](const SamplerRun& r) {
        return r.samples_to_passage < 0.0 ? 1e300 : r.samples_to_passage;
      },
      false);
}

std::string OrNone(double value) {
  return value >= 1e300 ? "never" : Rounded(value, 4);
}

Table ExactTable(const PlanningResults& results) {
  const std::map<std::string, double> best = BestLengths(results);
  return MakeTable(
      "The contact-surface planner, every problem",
      "Clearance over δ: 0.5 is what a channel allows; wide problems reach "
      "their cap first. Ratio: length over the shortest path known, of any "
      "planner here or the scene's own way through, pulled tight by 2000 cuts "
      "without a wish for clearance. Milliseconds: median of five queries; "
      "what is built once (tables, contact space) apart.",
      {"scene", "triangles", "answer", "right", "query ms", "tables ms",
       "contact space ms", "clearance/δ", "length", "ratio"},
      results.exact, [&](const ExactRow& r, const auto& add) {
        const bool has_path = r.status == "solved";
        add(r.problem.scene, r.triangles, r.status,
            std::string(r.is_right ? "yes" : "**no**"), Rounded(r.milliseconds),
            Rounded(r.build_milliseconds),
            Rounded(r.contact_space_milliseconds),
            has_path ? Rounded(r.clearance / r.problem.delta) : "–",
            has_path ? Rounded(r.length, 4) : "–",
            has_path ? Rounded(r.length / best.at(r.problem.scene), 4) : "–");
      });
}

Table SamplerTable(const std::vector<SamplerRow>& rows, std::string title,
                   std::string note) {
  return MakeTable(
      std::move(title), std::move(note),
      {"scene", "planner", "solved", "95 %", "median s", "samples",
       "to passage", "segment checks", "retractions", "length", "clearance/δ"},
      rows, [](const SamplerRow& r, const auto& add) {
        const int solved = Solved(r);
        const int runs = static_cast<int>(r.runs.size());
        const bool samples = r.planner.compare(0, 10, "retraction") == 0;
        const auto median = [&r](double SamplerRun::*field, bool only) {
          return Median(
              r, [field](const SamplerRun& x) { return x.*field; }, only);
        };
        add(r.problem.scene, r.planner, Shown(solved) + "/" + Shown(runs),
            Wilson(solved, runs), Rounded(median(&SamplerRun::seconds, false)),
            samples ? Rounded(MedianSamples(r), 4) : "–",
            samples ? OrNone(MedianToPassage(r)) : "–",
            Rounded(median(&SamplerRun::segment_checks, false), 4),
            samples ? Rounded(median(&SamplerRun::retractions, false), 4) : "–",
            solved > 0 ? Rounded(median(&SamplerRun::length, true), 4) : "–",
            solved > 0 ? Rounded(median(&SamplerRun::clearance, true) /
                                 r.problem.delta)
                       : "–");
      });
}

Table MotionTable(const PlanningResults& results) {
  return MakeTable(
      "Exact motion checks",
      "FreeSpace::IsFree(a, b), ends within 5 % of the diagonal of the "
      "surface, starts free.",
      {"scene", "triangles", "median µs", "95 % µs", "blocked"},
      results.motions, [](const MotionRow& r, const auto& add) {
        add(r.scene, r.triangles, r.median_microseconds, r.slow_microseconds,
            Rounded(100.0 * r.blocked_share) + " %");
      });
}

StepCurve::Role RoleOf(const std::string& planner) {
  if (planner == "retraction-forest phong") return StepCurve::Role::kMain;
  return planner == "retraction-forest euclidean" ? StepCurve::Role::kBaseline
                                                  : StepCurve::Role::kOther;
}

// Share of runs solved within a time, one curve a planner.
std::string TimeFigure(const PlanningResults& results,
                       const std::string& scene) {
  std::vector<StepCurve> curves;
  for (const SamplerRow& row : results.samplers) {
    if (row.problem.scene != scene) continue;
    std::vector<double> seconds;
    for (const SamplerRun& run : row.runs) {
      if (run.is_solved) seconds.push_back(run.seconds);
    }
    if (seconds.empty()) continue;
    std::sort(seconds.begin(), seconds.end());
    StepCurve curve = {row.planner, RoleOf(row.planner), {}};
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      // The limit is looked at between steps: what ends just after it counts.
      const double at = std::min(seconds[i], results.options.limit);
      curve.points.emplace_back(at, static_cast<double>(i + 1) /
                                        static_cast<double>(row.runs.size()));
    }
    curves.push_back(std::move(curve));
  }
  if (curves.empty()) return "";
  StepFrame frame;
  frame.title = scene + "; higher and further left is better";
  frame.x = "seconds";
  frame.y = "share of runs solved";
  frame.least = 1e-5;
  frame.most = results.options.limit;
  return StepFigure(curves, frame);
}

}  // namespace

std::vector<NamedTable> Tables(const PlanningResults& results) {
  return {
      {"exact.csv", ExactTable(results)},
      {"samplers.csv",
       SamplerTable(
           results.samplers, "Sampling planners",
           "Exactly free paths within " + Rounded(results.options.limit) +
               " s a run, the same exact motion validator for all; a planner "
               "that fails its first " +
               Shown(results.options.hopeless) +
               " runs on a scene is stopped there. Medians over all runs; "
               "lengths and clearances over the solved ones, not shortened. "
               "To passage: samples until the first node in the channel. "
               "Contact spaces are built before and not counted.")},
      {"narrowing.csv",
       SamplerTable(results.narrowing, "Effort and the width of the passage",
                    "The same from wide to narrow.")},
      {"multi_query.csv", MultiQueryTable(results.multi_query)},
      {"motions.csv", MotionTable(results)}};
}

// A straight passage, one with bends, and one that is turned: the others look
// like one of them.
bool IsShown(const std::string& scene) {
  return scene == "hole:delta=0.001" || scene == "tunnel:delta=0.001,bends=3" ||
         scene == "bugtrap:delta=0.001,rotation_seed=1";
}

std::vector<Figure> Figures(const PlanningResults& results) {
  std::vector<Figure> figures;
  std::set<std::string> seen;
  for (const SamplerRow& row : results.samplers) {
    const std::string& scene = row.problem.scene;
    if (!seen.insert(scene).second) continue;
    const std::string svg = TimeFigure(results, scene);
    if (svg.empty()) continue;
    std::string file = "time-" + scene + ".svg";
    for (char& c : file) {
      if (c == ':' || c == ',' || c == '=') c = '-';
    }
    figures.push_back({file,
                       "The share of runs solved within a time: " + scene + ".",
                       svg, !IsShown(scene)});
  }
  return figures;
}

std::string Findings(const PlanningResults& results) {
  std::string text = "## Targets\n\n";
  const auto line = [&](const std::string& what, const std::string& found,
                        bool is_met) {
    text += "- " + what + ": " + found +
            (is_met ? " – met.\n" : " – **missed**.\n");
  };
  int right = 0, twins = 0, slow = 0, near = 0, long_ones = 0, paths = 0;
  double slowest = 0.0, least_share = 1e300, worst_ratio = 0.0;
  const std::map<std::string, double> best = BestLengths(results);
  for (const ExactRow& r : results.exact) {
    right += r.is_right;
    twins += !r.problem.is_feasible;
    const double ms = r.milliseconds + r.build_milliseconds;
    slowest = std::max(slowest, ms);
    slow += ms > 25.0;
    if (r.status != "solved") continue;
    ++paths;
    // Half the channel, or the clearance that is asked for, is possible.
    const double share = r.clearance / (0.5 * r.problem.delta);
    if (r.problem.delta <= 1e-3) {
      least_share = std::min(least_share, share);
      near += share < 0.4;
    }
    const double ratio = r.length / best.at(r.problem.scene);
    worst_ratio = std::max(worst_ratio, ratio);
    long_ones += ratio > 1.3;
  }
  const int count = static_cast<int>(results.exact.size());
  line("contact-surface: every problem solved, every twin proved infeasible",
       Shown(right) + " of " + Shown(count) + " right, " + Shown(twins) +
           " of them twins",
       right == count);
  line("contact-surface: ≤ 25 ms with its tables, contact space apart",
       "slowest " + Rounded(slowest) + " ms, " + Shown(slow) + " above",
       slow == 0);
  line(
      "contact-surface: clearance in a passage (δ ≤ 1e-3) ≥ 0.4 of what is "
      "possible",
      "least " + Rounded(least_share) + ", " + Shown(near) + " below",
      near == 0);
  line("contact-surface: length ≤ 1.3 × the shortest known",
       "worst " + Rounded(worst_ratio, 4) + ", " + Shown(long_ones) + " of " +
           Shown(paths) + " above",
       long_ones == 0);
  int wrong = 0, queries = 0;
  for (const MultiQueryRow& r : results.multi_query) {
    wrong += r.wrong;
    queries += r.solved + r.proved;
  }
  line("roadmap: statuses of the contact-surface planner, paths exactly free",
       Shown(wrong) + " of " + Shown(queries) + " wrong", wrong == 0);
  for (const SamplerRow& r : results.samplers) {
    if (r.planner != "retraction-forest phong") continue;
    const int solved = Solved(r);
    if (25 * solved >= 24 * static_cast<int>(r.runs.size())) continue;
    line("retraction-forest, all branches, " + r.problem.scene +
             ": ≥ 48 of 50 within the limit",
         Shown(solved) + " of " + Shown(r.runs.size()), false);
  }
  int claims = 0;
  for (const SamplerRow& r : results.samplers) {
    for (const SamplerRun& run : r.runs) claims += run.is_false;
  }
  line("samplers: no path claimed that is not free", Shown(claims),
       claims == 0);
  for (const MotionRow& r : results.motions) {
    line("motion check, " + r.scene + " (" + Shown(r.triangles) +
             " triangles): median ≤ 5 µs",
         Rounded(r.median_microseconds) + " µs", r.median_microseconds <= 5.0);
  }
  text +=
      "\n## Samples until the first node in the passage, median\n\n"
      "All Phong branches against the nearest Euclidean projection, the same "
      "planner and the same care for both, and against random points of the "
      "contact space (no retraction at all). Never: most runs cross the "
      "passage "
      "by an edge, without a node in it; a gap has no channel.\n\n"
      "| scene | all Phong | Euclid | random contact point | Euclid / Phong |\n"
      "|---|---|---|---|---|\n";
  std::map<std::string, std::map<std::string, double>> passage;
  std::vector<std::string> order;
  for (const SamplerRow& r : results.samplers) {
    if (passage.find(r.problem.scene) == passage.end()) {
      order.push_back(r.problem.scene);
    }
    passage[r.problem.scene][r.planner] = MedianToPassage(r);
  }
  for (const std::string& scene : order) {
    std::map<std::string, double>& by = passage[scene];
    const double phong = by["retraction-forest phong"];
    const double euclid = by["retraction-forest euclidean"];
    text += "| " + scene + " | " + OrNone(phong) + " | " + OrNone(euclid) +
            " | " + OrNone(by["retraction-forest contact-point"]) + " | " +
            (phong > 0.0 && phong < 1e300
                 ? (euclid < 1e300 ? Rounded(euclid / phong) : "> all")
                 : "–") +
            " |\n";
  }
  return text;
}

std::string RunsCsv(const PlanningResults& results) {
  std::ostringstream csv;
  csv << "scene,planner,run,solved,seconds,samples,samples_to_passage,"
         "collision_checks,segment_checks,retractions,length,clearance\n";
  for (const auto* rows : {&results.samplers, &results.narrowing}) {
    for (const SamplerRow& row : *rows) {
      for (std::size_t i = 0; i < row.runs.size(); ++i) {
        const SamplerRun& r = row.runs[i];
        csv << '"' << row.problem.scene << "\"," << row.planner << ',' << i + 1
            << ',' << r.is_solved << ',' << Rounded(r.seconds, 4) << ','
            << r.samples << ',' << r.samples_to_passage << ','
            << r.collision_checks << ',' << r.segment_checks << ','
            << r.retractions << ',' << Rounded(r.length, 6) << ','
            << Rounded(r.clearance, 4) << '\n';
      }
    }
  }
  return csv.str();
}

}  // namespace phongpd::bench
