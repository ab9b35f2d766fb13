// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/contact_space_rows.h"

#include <algorithm>

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
  return MakeTable({"robot", "obstacle", "result triangles", "seconds",
                    "peak [MiB]", "µs a triangle", "KiB a triangle"},
                   results.growth, [&](const GrowthResult& g, const auto& add) {
                     for (const BuildMeasurement& m : g.sizes) {
                       const double n = std::max(m.obstacle_triangles, 1);
                       add(g.robot, m.obstacle_triangles, m.triangles,
                           Seconds(m, results.limit), m.peak_mib,
                           1e6 * m.seconds / n, 1024 * m.peak_mib / n);
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
      {"kind", "pairs", "failed", "points", "crevices", "undecided",
       "oracle wrong", "rounded", "largest [tri.]", "slowest [s]", "its seed"},
      counts, [](const auto& count, const auto& add) {
        const FuzzCount& f = count.second;
        add(count.first, f.pairs, f.failed, f.points, f.crevices, f.undecided,
            f.oracle_errors, f.rounded_pairs, f.largest, f.slowest,
            f.slowest_seed);
      });
}

Table FailureTable(const ContactSpaceResults& results) {
  return MakeTable({"failure"}, results.fuzz,
                   [](const FuzzCount& f, const auto& add) {
                     for (const std::string& failure : f.failures) add(failure);
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
    tables.push_back({"failed_pairs.csv", FailureTable(results)});
  }
  return tables;
}

int FailedPairs(const ContactSpaceResults& results) {
  int failed = 0;
  for (const FuzzCount& f : results.fuzz) failed += f.failed;
  return failed;
}

}  // namespace phongpd::bench
