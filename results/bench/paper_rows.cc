// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/paper_rows.h"

#include <cstdio>
#include <numeric>

namespace phongpd::bench {
namespace {

std::string Percent(int part, int whole) {
  if (whole == 0) return "–";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.2f %%", 100.0 * part / whole);
  return buffer;
}

Table SizesTable(const std::vector<PaperResult>& results) {
  return MakeTable(
      {"benchmark", "triangles", "paper", "genus", "cavities", "self-int.",
       "convolution", "arrangement", "build [s]", "peak [MiB]"},
      results, [](const PaperResult& r, const auto& add) {
        const ContactSpaceReport& report = r.space->report();
        add(r.benchmark.title, report.triangles, r.benchmark.paper_triangles,
            report.genus, report.cavities, report.self_intersections,
            report.convolution_triangles, report.arrangement_faces,
            r.build_seconds, report.peak_mib);
      });
}

Table MotionsTable(const std::vector<PaperResult>& results) {
  return MakeTable({"benchmark", "metric", "frames inside", "jumps", "flagged",
                    "steep", "silent", "branch ends", "fallbacks", "ratio mean",
                    "ratio 99 %", "ratio max", "cold mean", "cold max"},
                   results, [](const PaperResult& r, const auto& add) {
                     for (const MotionTotals& t : r.totals) {
                       add(r.benchmark.title, t.label, t.frames_inside, t.jumps,
                           t.flagged_jumps, t.steep_jumps, t.silent_jumps,
                           t.branch_ends, t.fallbacks, Rounded(t.ratio_mean, 4),
                           Rounded(t.ratio_p99, 4), Rounded(t.ratio_max, 4),
                           Rounded(t.cold_ratio_mean, 4),
                           Rounded(t.cold_ratio_max, 4));
                     }
                   });
}

Table TimesTable(const std::vector<PaperResult>& results) {
  return MakeTable({"benchmark", "metric", "warm median [µs]", "warm 99 % [µs]",
                    "cold median [µs]", "Euclidean / warm"},
                   results, [](const PaperResult& r, const auto& add) {
                     const double euclidean = r.totals.front().cold_median_us;
                     for (const MotionTotals& t : r.totals) {
                       const bool warm = &t != &r.totals.front();
                       add(r.benchmark.title, t.label,
                           warm ? Rounded(t.median_us) : "–",
                           warm ? Rounded(t.p99_us) : "–", t.cold_median_us,
                           warm ? Rounded(euclidean / t.median_us) : "–");
                     }
                   });
}

Table CoverageTable(const std::vector<PaperResult>& results,
                    const PaperOptions& options) {
  return MakeTable(
      {"benchmark", "method", "all", "0–20 %", "20–40 %", "40–60 %", "60–80 %",
       "80–100 %"},
      results, [&](const PaperResult& r, const auto& add) {
        for (const Coverage& c : r.coverage) {
          const auto fifth = [&c](std::size_t k) {
            return Percent(c.missing[k], c.points[k]) + " (" +
                   Shown(c.points[k]) + ")";
          };
          const int missing =
              std::accumulate(c.missing.begin(), c.missing.end(), 0);
          add(r.benchmark.title, c.method, Percent(missing, options.points),
              fifth(0), fifth(1), fifth(2), fifth(3), fifth(4));
        }
      });
}

}  // namespace

std::vector<NamedTable> PaperTables(const std::vector<PaperResult>& results,
                                    const PaperOptions& options) {
  return {{"contact_spaces.csv", SizesTable(results)},
          {"random_motions.csv", MotionsTable(results)},
          {"query_times.csv", TimesTable(results)},
          {"coverage.csv", CoverageTable(results, options)}};
}

}  // namespace phongpd::bench
