// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "results/bench/contact_space_report.h"

namespace phongpd::bench {
namespace {

std::string Targets(const ContactSpaceResults& results) {
  std::string text;
  for (const CaseResult& c : results.cases) {
    const BuildCase& b = c.build;
    const BuildMeasurement& m = c.all_threads;
    const auto line = [&](const std::string& asked, const std::string& found,
                          bool met) {
      text += "- " + b.name + ": asked " + asked + ", found " + found +
              (met && IsDone(m.status) ? " – met.\n" : " – **missed**.\n");
    };
    if (b.target_seconds > 0) {
      line("≤ " + Rounded(b.target_seconds) + " s", Rounded(m.seconds) + " s",
           m.seconds <= b.target_seconds);
    }
    if (b.target_mib > 0) {
      line("≤ " + Rounded(b.target_mib) + " MiB", Rounded(m.peak_mib) + " MiB",
           m.peak_mib <= b.target_mib);
    }
    if (b.target_triangles > 0) {
      line("≤ " + Shown(b.target_triangles) + " triangles",
           Shown(m.triangles) + " triangles",
           m.triangles <= b.target_triangles);
    }
  }
  return text;
}

std::string Competition(const ContactSpaceResults& results) {
  struct Tally {
    int entered = 0, finished = 0, stopped = 0, slower = 0, other = 0;
    double least = 0.0, most = 0.0;
  };
  const auto tally = [&](CompetitorMeasurement CaseResult::*competitor) {
    Tally t;
    for (const CaseResult& c : results.cases) {
      if (!c.build.compete || !IsDone(c.all_threads.status)) continue;
      const CompetitorMeasurement& m = c.*competitor;
      ++t.entered;
      t.stopped += m.status == ChildStatus::kStopped;
      if (!IsDone(m.status)) continue;
      const double ratio = m.seconds / c.all_threads.seconds;
      t.least = t.finished == 0 ? ratio : std::min(t.least, ratio);
      t.most = std::max(t.most, ratio);
      ++t.finished;
      t.slower += ratio > 1.0;
      t.other += std::abs(m.volume / c.all_threads.volume - 1.0) > 1e-6;
    }
    return t;
  };
  std::string text;
  const auto say = [&](const std::string& name, const Tally& t) {
    text += "- " + name + " finished " + Shown(t.finished) + " of " +
            Shown(t.entered) + " pairs, " + Shown(t.stopped) + " hit the limit";
    const int failed = t.entered - t.finished - t.stopped;
    if (failed > 0) text += ", " + Shown(failed) + " failed";
    if (t.finished > 0) {
      text += "; slower than ours on " + Shown(t.slower) +
              " of those it "
              "finished (" +
              Rounded(t.least) + " to " + Rounded(t.most) + " times our time)";
    }
    if (t.other > 0) {
      text += "; " + Shown(t.other) +
              " of its volumes differ from ours by more than 1e-6";
    }
    text += ".\n";
  };
  say("CGAL's minkowski_sum_3", tally(&CaseResult::nef));
  say("The union of hulls", tally(&CaseResult::hulls));
  return text;
}

std::string Threads(const ContactSpaceResults& results) {
  int same = 0, both = 0;
  double least = 0.0, most = 0.0;
  for (const CaseResult& c : results.cases) {
    if (!IsDone(c.one_thread.status) || !IsDone(c.all_threads.status)) continue;
    const double ratio = c.one_thread.seconds / c.all_threads.seconds;
    least = both == 0 ? ratio : std::min(least, ratio);
    most = std::max(most, ratio);
    ++both;
    same += c.one_thread.hash == c.all_threads.hash;
  }
  return "- " + Shown(results.threads) +
         " threads against one: " + Rounded(least) + " to " + Rounded(most) +
         " times as fast; the same bytes in " + Shown(same) + " of " +
         Shown(both) + " pairs.\n";
}

std::string Growth(const std::vector<GrowthResult>& growth) {
  std::string text;
  for (const GrowthResult& g : growth) {
    std::vector<const BuildMeasurement*> done;
    for (const BuildMeasurement& m : g.sizes) {
      if (IsDone(m.status)) done.push_back(&m);
    }
    if (done.size() < 2) {
      text += "- " + g.robot + " on a growing obstacle: not measured.\n";
      continue;
    }
    const double size = std::log(1.0 * done.back()->obstacle_triangles /
                                 done.front()->obstacle_triangles);
    const double time = std::log(done.back()->seconds / done[0]->seconds);
    const double memory = std::log(done.back()->peak_mib / done[0]->peak_mib);
    text += "- " + g.robot + " on a smooth obstacle of " +
            Shown(done.front()->obstacle_triangles) + " to " +
            Shown(done.back()->obstacle_triangles) +
            " triangles: time grows with exponent " + Rounded(time / size) +
            ", memory with " + Rounded(memory / size) + " (1 is linear).\n";
    if (done.size() < g.sizes.size()) {
      text += "  **" + Shown(static_cast<int>(g.sizes.size() - done.size())) +
              " larger sizes did not finish.**\n";
    }
  }
  return text;
}

std::string Fuzz(const ContactSpaceResults& results) {
  int pairs = 0;
  std::string failures;
  for (const FuzzCount& f : results.fuzz) {
    pairs += f.pairs;
    for (const std::string& failure : f.failures) {
      failures += "  - " + failure + "\n";
    }
  }
  return "- " + Shown(FailedPairs(results)) + " of " + Shown(pairs) +
         " random pairs failed a check.\n" + failures;
}

}  // namespace

std::string ContactSpaceReadme(const ContactSpaceResults& results,
                               const std::vector<NamedTable>& tables,
                               const std::vector<Figure>& figures,
                               const std::string& command) {
  std::string text =
      "# Contact spaces: time, memory, competitors, random pairs\n\nWritten by "
      "the command below; do not edit it.\n\n" +
      Circumstances("`" + command + "`", results.seed) +
      "\n\n## What is won and lost\n\n";
  if (!results.cases.empty()) {
    text += Targets(results) + Threads(results);
    text += HasCompetitors()
                ? Competition(results)
                : "- The competitors were not built: scripts/bench.sh does.\n";
  }
  text += Growth(results.growth);
  if (!results.fuzz.empty()) text += Fuzz(results);
  text +=
      "\n## How to read this\n\nTimes are wall times on a machine that may do "
      "other work; ours are medians, a competitor's is one run. A time of ours "
      "includes checking both operands and the result (stages `check` and "
      "`report`), which the competitors do not do. They return the exact "
      "rational polyhedron, we the exact topology with vertices rounded to "
      "double, of operands rounded to a grid of 2⁻³⁸ of their size. Their "
      "triangle counts depend on how their polygons are triangulated. The "
      "worst case of any method is cubic in the product of the operands' "
      "sizes: what costs is the number of crossings between sheets that end "
      "up inside (column `arrangement`), not the size of the result.\n\n";
  return text + ToMarkdown(tables, figures);
}

}  // namespace phongpd::bench
