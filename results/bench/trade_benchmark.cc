// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what presets and knobs buy and cost: fields, approximations of
// operands, levels of the model, samples.  Writes the rows that trade_report
// draws.
#include <algorithm>
#include <iostream>
#include <numeric>

#include "results/bench/program.h"
#include "results/bench/trade_measure.h"

namespace phongpd::bench {
namespace {

NamedTable KnobTable(const std::vector<TradeSum>& sums) {
  return {"knobs.csv",
          MakeTable("Presets and knobs", "",
                    {"consumer", "choice", "instances", "answered", "time",
                     "time, 90 %", "mean excess, %", "worst excess, %"},
                    sums, [](const TradeSum& s, const auto& add) {
                      add(s.consumer, s.choice, s.instances, s.answered, s.time,
                          s.slow, s.excess, s.worst);
                    })};
}

NamedTable FieldTable(const std::vector<FieldSum>& sums) {
  return {
      "fields.csv",
      MakeTable("Fields", "",
                {"ℓ", "longest edge / ℓ", "triangles", "build", "warm", "cold",
                 "frames inside", "jumps", "mean ratio", "ratio, 99 %"},
                sums, [](const FieldSum& s, const auto& add) {
                  const double all =
                      std::accumulate(s.ratios.begin(), s.ratios.end(), 0.0);
                  const auto frames = static_cast<double>(s.ratios.size());
                  add(s.ell,
                      s.ell == 0.0 || s.edge == 0.0 ? std::string("as it is")
                                                    : Rounded(s.edge),
                      s.triangles, s.build, s.warm, s.cold, s.ratios.size(),
                      s.jumps, all / std::max(1.0, frames),
                      Quantile(s.ratios, 0.99));
                })};
}

NamedTable ApproximationTable(const std::vector<ApproximationRow>& rows) {
  return {"approximations.csv",
          MakeTable("Approximations of operands", "",
                    {"pair", "choice", "triangles", "time of build",
                     "told bound, % of D", "mean error, % of D",
                     "worst error, % of D", "missed, %", "false, %"},
                    rows, [](const ApproximationRow& r, const auto& add) {
                      add(r.pair, r.choice, r.triangles, r.build, r.bound,
                          r.mean, r.worst, r.missed, r.false_hits);
                    })};
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("What knobs buy and cost: rows.");
  TradeOptions options;
  std::vector<std::string> parts = {"fields", "approximations", "knobs"};
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--seeds", options.seeds)->capture_default_str();
  app.add_option("--parts", parts)->check(CLI::IsMember(parts))->delimiter(',');
  program->Parse();
  for (const std::string& part : parts) {
    NamedTable table;
    if (part == "fields") {
      table = FieldTable(MeasureFields(options));
    } else if (part == "approximations") {
      table = ApproximationTable(MeasureApproximations(options));
    } else {
      std::vector<TradeTrial> trials = MeasurePlan();
      for (const auto& more :
           {MeasureOptimize(options), MeasureModels(options)}) {
        trials.insert(trials.end(), more.begin(), more.end());
      }
      table = KnobTable(Sum(trials));
    }
    std::cout << ToText(table.table) << std::endl;
    program->Write(table.file, ToCsv(table.table));
  }
  program->Finish(options.seed);
  return 0;
}

}  // namespace phongpd::bench
