// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the paper's three benchmarks, PhongPD beside Euclidean PD on the
// same contact spaces, in one binary and one run.  Writes CSV into a
// directory, of which paper_report.py makes the pages.
#include <iostream>
#include <string>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "results/bench/moment_cut.h"
#include "results/bench/paper_measure.h"
#include "results/bench/paper_rows.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

std::vector<MotionTrace> TraceMoment(const ContactSpace& contact,
                                     const StraightMotion& motion) {
  std::vector<MotionTrace> traces;
  traces.push_back(TraceMotion(EuclideanMetric(contact), motion, "euclidean",
                               "Euclidean PD"));
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.0;  // the paper's field
  traces.push_back(TraceMotion(PhongMetric(contact, options), motion, "phong@0",
                               "PhongPD, ℓ = 0"));
  options.field_options.smoothing_length = 0.1;
  traces.push_back(TraceMotion(PhongMetric(contact, options), motion,
                               "phong@0.1", "PhongPD, ℓ = 0.1"));
  return traces;
}

// A motion that is drawn; jumps are longer than that.
struct DrawnMotion {
  std::string name, summary;
  double jump_length;
};

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("The paper's three benchmarks: rows.");
  PaperOptions options;
  app.add_option("--motions", options.motions)->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--points", options.points)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();

  std::vector<PaperResult> results;
  std::vector<DrawnMotion> drawn;
  for (const PaperBenchmark& benchmark : PaperBenchmarks()) {
    std::cerr << benchmark.title << '\n';
    results.push_back(Measure(benchmark, options));
    const PaperResult& result = results.back();
    for (std::size_t i = 0; i < benchmark.motions.size(); ++i) {
      const PaperMotion& motion = benchmark.motions[i];
      drawn.push_back({benchmark.name + "_" + motion.name,
                       benchmark.title + ": " + motion.summary,
                       options.jump * result.space->length()});
      program->Write(drawn.back().name + ".csv", MotionCsv(result.traces[i]));
    }
  }
  const PaperMotion moment = PaperMoment();
  const PaperResult& wrench = results.back();
  drawn.push_back(
      {"moment", moment.summary, options.jump * wrench.space->length()});
  program->Write("moment.csv",
                 MotionCsv(TraceMoment(*wrench.space, moment.motion)));
  program->Write(
      "moment_cut.csv",
      ToCsv(MomentCut(wrench.benchmark, wrench.space->mesh(), moment.motion)));
  program->Write("motions.csv",
                 ToCsv(MakeTable({"motion", "summary", "jump"}, drawn,
                                 [](const DrawnMotion& m, const auto& add) {
                                   add(m.name, m.summary,
                                       Rounded(m.jump_length, 6));
                                 })));
  program->Write(PaperTables(results, options));
  program->Finish(options.seed, "measured.txt", "`" + program->Command() + "`");
  return 0;
}

}  // namespace phongpd::bench
