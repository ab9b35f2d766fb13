// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/tracker_report.h"

#include <algorithm>

#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

// Its inside and outside hang together by a window alone.
constexpr const char* kHardSpace = "hollow box";

void Add(const TrackerRow& other, TrackerRow* sum) {
  sum->triangles += other.triangles;
  sum->frames += other.frames;
  sum->jumps += other.jumps;
  sum->beyond += other.beyond;
  sum->exits += other.exits;
  sum->sliding += other.sliding;
  sum->ratios.insert(sum->ratios.end(), other.ratios.begin(),
                     other.ratios.end());
  sum->micros.insert(sum->micros.end(), other.micros.begin(),
                     other.micros.end());
}

// All spaces as one of that name, a row a metric.
std::vector<TrackerRow> Totals(const std::vector<TrackerRow>& rows,
                               const std::string& name) {
  std::vector<TrackerRow> totals;
  for (const TrackerRow& row : rows) {
    const auto same = std::find_if(
        totals.begin(), totals.end(),
        [&](const TrackerRow& r) { return r.metric == row.metric; });
    if (same == totals.end()) {
      totals.push_back(row);
      totals.back().space = name;
    } else {
      Add(row, &*same);
    }
  }
  return totals;
}

// Where the tracker misses what was aimed at, or a field does better than it.
std::string Losses(const std::vector<TrackerRow>& rows) {
  std::string text;
  const auto say = [&](const TrackerRow& row, const std::string& what) {
    text += "- " + row.space + ": " + what + "\n";
  };
  for (const TrackerRow& row : rows) {
    if (row.metric == "tracker") {
      if (row.beyond > 0) {
        say(row, std::to_string(row.beyond) + " changes beyond the bound");
      }
      if (row.exits > 0) {
        say(row, std::to_string(row.exits) + " exits elsewhere");
      }
      if (row.MeanRatio() > 1.1 || row.AboveThree() > 1.0) {
        say(row, "mean ratio " + Rounded(row.MeanRatio()) + ", " +
                     Rounded(row.AboveThree()) + " % above 3 (aim: 1.1, 1 %)");
      }
      if (Quantile(row.micros, 0.5) > 2.0 ||
          Quantile(row.micros, 1.0) > 200.0) {
        say(row, Rounded(Quantile(row.micros, 0.5)) + " µs median, " +
                     Rounded(Quantile(row.micros, 1.0)) + " µs worst at " +
                     std::to_string(row.triangles) +
                     " triangles (aim at 10⁴: 2, 200)");
      }
      continue;
    }
    if (row.metric == "euclidean") continue;
    for (const TrackerRow& tracker : rows) {
      if (tracker.metric != "tracker" || tracker.space != row.space) continue;
      if (row.jumps < tracker.jumps) {
        say(row, row.metric + " jumps " + std::to_string(row.jumps) +
                     " times, the tracker " + std::to_string(tracker.jumps));
      }
      if (row.MeanRatio() < tracker.MeanRatio()) {
        say(row, row.metric + " has mean ratio " + Rounded(row.MeanRatio()) +
                     ", the tracker " + Rounded(tracker.MeanRatio()));
      }
    }
  }
  return text.empty() ? "None in this run.\n" : text;
}

// How long a step takes beside the quickest field.
std::string Times(const std::vector<TrackerRow>& rows) {
  std::string text = "Median of a step inside, all spaces:";
  for (const TrackerRow& row : Totals(rows, "")) {
    text +=
        " " + row.metric + " " + Rounded(Quantile(row.micros, 0.5)) + " µs,";
  }
  text.back() = '.';
  return text + "\n";
}

}  // namespace

double TrackerRow::MeanRatio() const {
  double sum = 0.0;
  for (const double ratio : ratios) sum += ratio;
  return sum / std::max(1, frames);
}

double TrackerRow::AboveThree() const {
  const auto above =
      std::count_if(ratios.begin(), ratios.end(),
                    [](double ratio) { return ratio > 3.0 * (1.0 + 1e-9); });
  return 100.0 * static_cast<double>(above) / std::max(1, frames);
}

NamedTable TrackerTable(const std::vector<TrackerRow>& rows) {
  return {
      "tracker.csv",
      MakeTable(
          "Along motions",
          "A jump: PD changes by more than 5 % of the diagonal between two "
          "frames, exits elsewhere included. Beyond: it changes by more than "
          "11 times the robot's step, exits elsewhere apart. Exits elsewhere: "
          "`left_elsewhere` of the tracker, `branch_ended` outside of PhongPD; "
          "Euclidean PD has no state to leave. Ratio: depth over Euclidean "
          "depth, frames inside. Time of a step inside, the least of three "
          "repetitions.",
          {"contact space", "triangles", "metric", "frames inside", "jumps",
           "beyond", "exits elsewhere", "sliding, %", "mean ratio",
           "above 3, %", "worst ratio", "µs, median", "99 %", "worst"},
          rows, [](const TrackerRow& r, const auto& add) {
            add(r.space, r.triangles, r.metric, r.frames, r.jumps, r.beyond,
                r.exits, 100.0 * r.sliding / std::max(1, r.frames),
                r.MeanRatio(), r.AboveThree(), Quantile(r.ratios, 1.0),
                Quantile(r.micros, 0.5), Quantile(r.micros, 0.99),
                Quantile(r.micros, 1.0));
          })};
}

NamedTable TrackerTotals(const std::vector<TrackerRow>& rows) {
  std::vector<TrackerRow> easy = rows;
  const auto is_hard = [](const TrackerRow& row) {
    return row.space.find(kHardSpace) != std::string::npos;
  };
  easy.erase(std::remove_if(easy.begin(), easy.end(), is_hard), easy.end());
  NamedTable totals =
      TrackerTable(Totals(easy, std::string("all but the ") + kHardSpace));
  totals.file = "totals.csv";
  totals.table.title = "Contact spaces together";
  totals.table.note = "Columns as below; triangles: their sum.";
  return totals;
}

std::string TrackerPage(const std::vector<NamedTable>& tables,
                        const std::vector<TrackerRow>& rows) {
  return "# Metrics along motions\n\n"
         "What Euclidean PD, PhongPD (followed by its branch, smoothing length "
         "0, 0.1 and 0.2 of the diagonal) and `PenetrationTracker` (c = 3, "
         "κ = 10) do on the same motions: ways between random interior points, "
         "straight and bent in turn. The tracker is a state along a motion; it "
         "has no gradient for a solver.\n\n"
         "## Where the tracker loses\n\n" +
         Losses(rows) +
         "\nWalls are the hard case where the way round them is many times "
         "their "
         "thickness: a hollow body whose inside and outside hang together by a "
         "window, "
         "thin plates, slender bars. A contact that may not jump cannot come "
         "to the "
         "other side in time. `PenetrationTrackerCampaign` has five such among "
         "its 20 "
         "contact spaces and prints their figures in its long form.\n\n" +
         Times(rows) + "\n" + ToMarkdown(tables, {});
}

}  // namespace phongpd::bench
