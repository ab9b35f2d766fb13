// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/paper_report.h"

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
      "Contact spaces",
      "The paper's meshes are unpublished. Of ours, cone (78 triangles) and "
      "wrench (772) have exactly its sizes, the ball (1008) is its \"about "
      "1K\", and the axes are a closed solid of 60 triangles (35, as printed, "
      "cannot close). Seconds: median of all builds, one process; memory: "
      "peak of the process up to there, so later rows include earlier ones.",
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

Table MotionsTable(const std::vector<PaperResult>& results,
                   const PaperOptions& options) {
  return MakeTable(
      "Continuity and depth along random motions",
      Shown(options.motions) + " straight motions of " + Shown(options.frames) +
          " frames between random interior points of each benchmark. Jump: PD "
          "changes by more than " +
          Rounded(100.0 * options.jump) +
          " % of the diagonal between two frames. Flagged: the frame's status "
          "says so, because the branch folded or the robot left the obstacle "
          "on another side than its branch led to; steep: no jump when the "
          "step is divided by 1000; silent: none of these. Ratio: depth over "
          "Euclidean depth, with the branch carried along, and asked cold at "
          "every frame; it grows without bound towards an exit on another "
          "side, where the Euclidean depth goes to 0.",
      {"benchmark", "metric", "frames inside", "jumps", "flagged", "steep",
       "silent", "branch ends", "fallbacks", "ratio mean", "ratio 99 %",
       "ratio max", "cold mean", "cold max"},
      results, [](const PaperResult& r, const auto& add) {
        for (const MotionTotals& t : r.totals) {
          add(r.benchmark.title, t.label, t.frames_inside, t.jumps,
              t.flagged_jumps, t.steep_jumps, t.silent_jumps, t.branch_ends,
              t.fallbacks, Rounded(t.ratio_mean, 4), Rounded(t.ratio_p99, 4),
              Rounded(t.ratio_max, 4), Rounded(t.cold_ratio_mean, 4),
              Rounded(t.cold_ratio_max, 4));
        }
      });
}

Table TimesTable(const std::vector<PaperResult>& results) {
  return MakeTable(
      "Query times",
      "Per interior frame of the same random motions, single thread, all in "
      "one run, each query timed alone (the clock's own cost included). Warm: "
      "with the previous frame's branch; Euclidean PD has none. Last column: "
      "Euclidean time over warm time.",
      {"benchmark", "metric", "warm median [µs]", "warm 99 % [µs]",
       "cold median [µs]", "Euclidean / warm"},
      results, [](const PaperResult& r, const auto& add) {
        const double euclidean = r.totals.front().cold_median_us;
        for (const MotionTotals& t : r.totals) {
          const bool warm = &t != &r.totals.front();
          add(r.benchmark.title, t.label, warm ? Rounded(t.median_us) : "–",
              warm ? Rounded(t.p99_us) : "–", t.cold_median_us,
              warm ? Rounded(euclidean / t.median_us) : "–");
        }
      });
}

Table CoverageTable(const std::vector<PaperResult>& results,
                    const PaperOptions& options) {
  return MakeTable(
      "Interior points without a Phong projection",
      "Share of " + Shown(options.points) +
          " random interior points at which a cold query finds no "
          "projection, by fifths of the depth of the deepest point "
          "(shallow to deep; points per fifth in brackets).",
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

// How many (benchmark, ℓ) pairs answer faster than Euclidean PD.
std::string Speed(const std::vector<PaperResult>& results) {
  int warm = 0;
  int cold = 0;
  int pairs = 0;
  for (const PaperResult& r : results) {
    const double euclidean = r.totals.front().cold_median_us;
    for (std::size_t k = 1; k < r.totals.size(); ++k) {
      ++pairs;
      warm += r.totals[k].median_us < euclidean ? 1 : 0;
      cold += r.totals[k].cold_median_us < euclidean ? 1 : 0;
    }
  }
  const std::string of = " of " + Shown(pairs) + " cases";
  return "Depth is lost everywhere: PhongPD is never less than Euclidean PD. "
         "Time: the median warm query is faster than a Euclidean one in " +
         Shown(warm) + of + ", the median cold one in " + Shown(cold) + of +
         ".";
}

// What the numbers say, in words that follow from them.
std::string Findings(const std::vector<PaperResult>& results) {
  std::string text;
  for (const PaperResult& r : results) {
    const int euclidean = r.totals.front().jumps;
    text += "- " + r.benchmark.title + ": Euclidean PD jumps " +
            Shown(euclidean) + " times.";
    for (std::size_t k = 1; k < r.totals.size(); ++k) {
      const MotionTotals& t = r.totals[k];
      text += " " + t.label + " jumps " + Shown(t.jumps) + " times (" +
              (t.jumps < euclidean   ? "a win"
               : t.jumps > euclidean ? "a loss"
                                     : "a draw") +
              "), " + Shown(t.silent_jumps) +
              " of them silently, and pays with depths " +
              Rounded(t.ratio_mean) + " times the Euclidean on average, " +
              Rounded(t.ratio_p99) + " or more at 1 % of the frames.";
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::vector<NamedTable> PaperTables(const std::vector<PaperResult>& results,
                                    const PaperOptions& options) {
  return {{"contact_spaces.csv", SizesTable(results)},
          {"random_motions.csv", MotionsTable(results, options)},
          {"query_times.csv", TimesTable(results)},
          {"coverage.csv", CoverageTable(results, options)}};
}

Table ShortTable(const std::vector<PaperResult>& results) {
  return MakeTable(
      "The paper's three benchmarks", "",
      {"benchmark", "triangles", "paper", "build [s]", "jumps Eucl.", "ℓ = 0",
       "ℓ = 0.1", "warm [µs]", "Eucl. [µs]"},
      results, [](const PaperResult& r, const auto& add) {
        add(r.benchmark.title, r.space->report().triangles,
            r.benchmark.paper_triangles, r.build_seconds, r.totals[0].jumps,
            r.totals[1].jumps, r.totals[2].jumps, r.totals[1].median_us,
            r.totals[0].cold_median_us);
      });
}

std::string PaperReadme(const std::vector<PaperResult>& results,
                        const std::vector<NamedTable>& tables,
                        const std::vector<Figure>& figures,
                        const PaperOptions& options,
                        const std::string& command) {
  std::string text =
      "# The paper's three benchmarks\n\nPhongPD (ℓ = 0 is the paper's "
      "field, ℓ = 0.1 the field smoothed over a tenth of the contact space's "
      "diagonal) beside Euclidean PD on the same contact spaces. This file is "
      "written by the command below; do not edit it.\n\n" +
      Circumstances("`" + command + "`", options.seed) +
      "\n\n## What is won and lost\n\n" + Findings(results) +
      "\nA PD that is defined on all of a solid cannot be continuous "
      "everywhere: a Phong branch ends where its field folds, or leads to "
      "another side than the one the robot leaves by. The status "
      "`branch_ended` says both. " +
      Speed(results) + "\n\n";
  return text + ToMarkdown(tables, figures);
}

std::string PaperPage(const std::vector<NamedTable>& tables,
                      const std::vector<Figure>& figures,
                      const PaperOptions& options, const std::string& command) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<title>PhongPD: the paper's three benchmarks</title>\n<style>\n"
      ":root{color-scheme:light dark;--line:#8886;--code:#8882}\n"
      "body{font:16px/1.5 system-ui,sans-serif;max-width:70em;margin:2em auto;"
      "padding:0 1em}\n"
      "table{border-collapse:collapse;font-size:14px;display:block;"
      "overflow-x:auto}\n"
      "th,td{border-bottom:1px solid var(--line);padding:.25em .6em;"
      "text-align:right}\n"
      "th:first-child,td:first-child{text-align:left}\n"
      "figure{margin:2em 0}figure svg{max-width:100%;height:auto;"
      "background:#fff;border-radius:8px}\n"
      "code{background:var(--code);padding:0 .2em;overflow-wrap:anywhere}\n"
      "</style></head><body>\n"
      "<h1>PhongPD: the paper's three benchmarks</h1>\n"
      "<p>PhongPD (ℓ = 0 is the paper's field, ℓ = 0.1 the field smoothed "
      "over a tenth of the contact space's diagonal) beside Euclidean PD on "
      "the same contact spaces.</p>\n<p>" +
      Circumstances("<code>" + command + "</code>", options.seed) + "</p>\n";
  for (const NamedTable& named : tables) html += ToHtml(named.table);
  html += "<h2>Figures</h2>\n";
  for (const Figure& figure : figures) {
    // Without the XML prologue the picture is valid inside HTML.
    const std::size_t start = figure.svg.find("<svg");
    html += "<figure><figcaption>" + figure.caption + "</figcaption>\n" +
            figure.svg.substr(start == std::string::npos ? 0 : start) +
            "</figure>\n";
  }
  return html + "</body></html>\n";
}

}  // namespace phongpd::bench
