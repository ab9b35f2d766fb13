// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/contact_space_report.h"

#include <algorithm>
#include <cmath>

#include "problems/output/gnuplot.h"
#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

// The figure, or why there is none.
std::string Outcome(ChildStatus status, double value, double limit) {
  switch (status) {
    case ChildStatus::kDone:
      return Rounded(value);
    case ChildStatus::kStopped:
      return "> " + Rounded(limit);
    case ChildStatus::kCrashed:
      return "crashed";
    default:
      return "failed";
  }
}

std::string Seconds(const BuildMeasurement& m, double limit) {
  return Outcome(m.status, m.seconds, limit);
}

// "met" or "missed" for every target there is.
std::string Verdict(const CaseResult& c) {
  std::string verdict;
  const auto add = [&](const std::string& what, bool met) {
    verdict +=
        (verdict.empty() ? "" : "; ") + what + (met ? " met" : " missed");
  };
  const BuildMeasurement& m = c.all_threads;
  const bool done = IsDone(m.status);
  if (c.build.target_seconds > 0) {
    add("≤ " + Rounded(c.build.target_seconds) + " s",
        done && m.seconds <= c.build.target_seconds);
  }
  if (c.build.target_mib > 0) {
    add("≤ " + Rounded(c.build.target_mib) + " MiB",
        done && m.peak_mib <= c.build.target_mib);
  }
  if (c.build.target_triangles > 0) {
    add("≤ " + Shown(c.build.target_triangles) + " triangles",
        done && m.triangles <= c.build.target_triangles);
  }
  return verdict.empty() ? "–" : verdict;
}

Table BuildsTable(const ContactSpaceResults& results) {
  return MakeTable(
      "Contact spaces",
      "Robot + obstacle with their triangles. Seconds: median (and slowest) of "
      "up to 5 builds with all threads, from meshes in memory to a checked "
      "mesh. Peak: of a process that does nothing else. Self-int.: pairs of "
      "triangles that meet after rounding to double.",
      {"pair", "triangles", "genus", "cavities", "self-int.", "convolution",
       "arrangement", "median [s]", "slowest [s]", "peak [MiB]", "target"},
      results.cases, [&](const CaseResult& c, const auto& add) {
        const BuildMeasurement& m = c.all_threads;
        add(c.build.name, m.triangles, m.genus, m.cavities,
            m.self_intersections, m.convolution_triangles, m.arrangement_faces,
            Seconds(m, results.limit), m.slowest, m.peak_mib, Verdict(c));
      });
}

// Its columns are what the builds report.
Table StagesTable(const ContactSpaceResults& results) {
  Table table;
  table.title = "Seconds per stage";
  table.note = "Medians of the builds above.";
  table.header = {"pair"};
  for (const CaseResult& c : results.cases) {
    if (table.header.size() > 1) break;
    for (const auto& stage : c.all_threads.stages) {
      table.header.push_back(stage.first);
    }
  }
  for (const CaseResult& c : results.cases) {
    std::vector<std::string> row = {c.build.name};
    for (const auto& stage : c.all_threads.stages) {
      row.push_back(Rounded(stage.second, 2));
    }
    row.resize(table.header.size());
    table.rows.push_back(row);
  }
  return table;
}

Table ThreadsTable(const ContactSpaceResults& results) {
  const std::string threads = Shown(results.threads);
  return MakeTable(
      "One thread and " + threads,
      "The same builds with TBB limited to one thread. Same bytes: a hash of "
      "all coordinates and indices of the result.",
      {"pair", "1 thread [s]", threads + " [s]", "speed-up", "same bytes"},
      results.cases, [&](const CaseResult& c, const auto& add) {
        const BuildMeasurement &one = c.one_thread, &all = c.all_threads;
        const bool both = IsDone(one.status) && IsDone(all.status);
        add(c.build.name, Seconds(one, results.limit),
            Seconds(all, results.limit),
            both ? Rounded(one.seconds / all.seconds) : "–",
            !both                  ? "–"
            : one.hash == all.hash ? "yes"
                                   : "NO");
      });
}

Table CompetitorsTable(const ContactSpaceResults& results) {
  return MakeTable(
      "Beside CGAL",
      "The same meshes in the same binary and run, one build each, one "
      "process each, limit " +
          Rounded(results.limit) +
          " s. Nef: minkowski_sum_3. Hulls: convex parts (an operand convex up "
          "to 1e-9 is one part, else convex_decomposition_3), hulls of all "
          "pairs of parts, union by corefinement with exact constructions. Nef "
          "/ ours: their time over our median (they use one thread, we use "
          "all). Volume: relative difference to ours.",
      {"pair", "ours [s]", "Nef [s]", "Nef / ours", "Nef volume", "hulls [s]",
       "hulls / ours", "hulls volume", "ours tri.", "Nef tri.", "hulls tri.",
       "Nef [MiB]", "hulls [MiB]"},
      results.cases, [&](const CaseResult& c, const auto& add) {
        if (!c.build.compete) return;
        const BuildMeasurement& ours = c.all_threads;
        const auto ratio = [&](const CompetitorMeasurement& m) -> std::string {
          if (IsDone(m.status)) return Rounded(m.seconds / ours.seconds);
          if (m.status != ChildStatus::kStopped) return "–";
          return "> " + Rounded(results.limit / ours.seconds);
        };
        const auto volume = [&](const CompetitorMeasurement& m) -> std::string {
          if (!IsDone(m.status)) return "–";
          return Rounded(m.volume / ours.volume - 1.0, 2);
        };
        const auto count = [](const CompetitorMeasurement& m) -> std::string {
          return IsDone(m.status) ? Shown(m.triangles) : "–";
        };
        const auto outcome = [&](const CompetitorMeasurement& m) {
          return Outcome(m.status, m.seconds, results.limit);
        };
        add(c.build.name, Seconds(ours, results.limit), outcome(c.nef),
            ratio(c.nef), volume(c.nef), outcome(c.hulls), ratio(c.hulls),
            volume(c.hulls), ours.triangles, count(c.nef), count(c.hulls),
            c.nef.peak_mib, c.hulls.peak_mib);
      });
}

Table GrowthTable(const ContactSpaceResults& results) {
  return MakeTable(
      "A convex robot on a smooth obstacle",
      "A turned brick or a ball of 80 triangles on a torus of 10⁴, 10⁵ and "
      "10⁶. Linear growth: the same microseconds and KiB a triangle in every "
      "row.",
      {"robot", "obstacle", "result triangles", "seconds", "peak [MiB]",
       "µs a triangle", "KiB a triangle"},
      results.growth, [&](const GrowthResult& g, const auto& add) {
        for (const BuildMeasurement& m : g.sizes) {
          const double n = std::max(m.obstacle_triangles, 1);
          add(g.robot, m.obstacle_triangles, m.triangles,
              Seconds(m, results.limit), m.peak_mib, 1e6 * m.seconds / n,
              1024 * m.peak_mib / n);
        }
      });
}

FuzzCount Total(const std::vector<FuzzCount>& counts) {
  FuzzCount all;
  for (const FuzzCount& f : counts) {
    all.pairs += f.pairs;
    all.failed += f.failed;
    all.points += f.points;
    all.crevices += f.crevices;
    all.undecided += f.undecided;
    all.oracle_errors += f.oracle_errors;
    all.rounded_pairs += f.rounded_pairs;
    all.largest = std::max(all.largest, f.largest);
    if (f.slowest > all.slowest) {
      all.slowest = f.slowest;
      all.slowest_seed = f.slowest_seed;
    }
  }
  return all;
}

Table FuzzTable(const ContactSpaceResults& results) {
  std::vector<std::pair<std::string, FuzzCount>> counts;
  for (const FuzzCount& f : results.fuzz) counts.emplace_back(Name(f.kind), f);
  counts.emplace_back("all", Total(results.fuzz));
  return MakeTable(
      "Random pairs",
      "Every pair is built four times (as it is, swapped, moved by up to 100 "
      "sizes, scaled by 1e-9 to 1e9) and checked: closed, manifold, no "
      "crossing deeper than the grid, volume counted on a lattice, the four "
      "results alike, and membership of 300 random points and 1200 points "
      "±1e-6 and ±1e-9 of the diagonal off the surface against FCL. Crevice: "
      "such a point lies behind another sheet. Undecided: closer to the "
      "surface, or in a gap thinner, than a few grid steps. Oracle wrong: "
      "FCL contradicts exact predicates. Rounded: pairs whose triangles meet "
      "after rounding to double. Slowest: of one build, one thread. Limit " +
          Rounded(results.pair_limit) + " s a pair.",
      {"kind", "pairs", "failed", "points", "crevices", "undecided",
       "oracle wrong", "rounded", "largest [tri.]", "slowest [s]", "its seed"},
      counts, [](const auto& count, const auto& add) {
        const FuzzCount& f = count.second;
        add(count.first, f.pairs, f.failed, f.points, f.crevices, f.undecided,
            f.oracle_errors, f.rounded_pairs, f.largest, f.slowest,
            f.slowest_seed);
      });
}

}  // namespace

std::vector<NamedTable> ContactSpaceTables(const ContactSpaceResults& results) {
  std::vector<NamedTable> tables;
  if (!results.cases.empty()) {
    tables.push_back({"builds.csv", BuildsTable(results)});
    tables.push_back({"stages.csv", StagesTable(results)});
    tables.push_back({"threads.csv", ThreadsTable(results)});
    if (HasCompetitors()) {
      tables.push_back({"competitors.csv", CompetitorsTable(results)});
    }
  }
  if (!results.growth.empty()) {
    tables.push_back({"growth.csv", GrowthTable(results)});
  }
  if (!results.fuzz.empty()) {
    tables.push_back({"random_pairs.csv", FuzzTable(results)});
  }
  return tables;
}

Table ContactSpaceShortTable(const ContactSpaceResults& results) {
  return MakeTable("Contact spaces", "",
                   {"pair", "triangles", "median [s]", "peak [MiB]", "target"},
                   results.cases, [&](const CaseResult& c, const auto& add) {
                     add(c.build.name, c.all_threads.triangles,
                         Seconds(c.all_threads, results.limit),
                         c.all_threads.peak_mib, Verdict(c));
                   });
}

Figure GrowthFigure(const std::vector<GrowthResult>& growth) {
  std::string script, time, memory;
  for (std::size_t i = 0; i < growth.size(); ++i) {
    const std::string name = "$g" + std::to_string(i);
    script += name + " << EOD\n";
    for (const BuildMeasurement& m : growth[i].sizes) {
      if (!IsDone(m.status)) continue;
      script += std::to_string(m.obstacle_triangles) + ' ' +
                FormatDouble(m.seconds) + ' ' + FormatDouble(m.peak_mib) + '\n';
    }
    script += "EOD\n";
    const std::string style = " w lp pt 7 lw 2 t '" + growth[i].robot + "', ";
    time += name + " u 1:2" + style;
    memory += name + " u 1:3" + style;
  }
  script +=
      "set multiplot layout 1,2\nset logscale xy\nset grid\n"
      "set format '10^{%L}'\nset key top left\nset xrange [5e3:2e6]\n"
      "set xlabel 'obstacle [triangles]'\n"
      "set ylabel 'median build [s]'\nplot " +
      time +
      "1e-5*x w l dt 2 lc 'grey' t '10 µs a triangle'\n"
      "set ylabel 'peak [MiB]'\nplot " +
      memory +
      "x/1024 w l dt 2 lc 'grey' t '1 KiB a triangle'\n"
      "unset multiplot\n";
  return {"growth.svg",
          "A convex robot on a smooth obstacle: time and memory over its size",
          RenderSvg(script, 1000, 420)};
}

int FailedPairs(const ContactSpaceResults& results) {
  int failed = 0;
  for (const FuzzCount& f : results.fuzz) failed += f.failed;
  return failed;
}

}  // namespace phongpd::bench
