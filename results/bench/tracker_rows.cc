// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/tracker_rows.h"

#include <algorithm>

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
  return {"tracker.csv",
          MakeTable(
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
  return totals;
}

}  // namespace phongpd::bench
