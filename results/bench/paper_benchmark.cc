// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the paper's three benchmarks, PhongPD beside Euclidean PD on the
// same contact spaces, in one binary and one run.  Writes CSV into a
// directory, of which paper_report.py makes the pages.
#include <CLI/CLI.hpp>
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

int Run(int argc, char** argv) {
  CLI::App app("The paper's three benchmarks: rows.");
  std::string directory;
  PaperOptions options;
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--motions", options.motions)->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--points", options.points)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<PaperResult> results;
  std::vector<DrawnMotion> drawn;
  OutputDirectory out(directory);
  for (const PaperBenchmark& benchmark : PaperBenchmarks()) {
    std::cerr << benchmark.title << '\n';
    results.push_back(Measure(benchmark, options));
    const PaperResult& result = results.back();
    for (std::size_t i = 0; i < benchmark.motions.size(); ++i) {
      const PaperMotion& motion = benchmark.motions[i];
      drawn.push_back({benchmark.name + "_" + motion.name,
                       benchmark.title + ": " + motion.summary,
                       options.jump * result.space->length()});
      out.Write(drawn.back().name + ".csv", MotionCsv(result.traces[i]));
    }
  }
  const PaperMotion moment = PaperMoment();
  const PaperResult& wrench = results.back();
  drawn.push_back(
      {"moment", moment.summary, options.jump * wrench.space->length()});
  out.Write("moment.csv", MotionCsv(TraceMoment(*wrench.space, moment.motion)));
  out.Write(
      "moment_cut.csv",
      ToCsv(MomentCut(wrench.benchmark, wrench.space->mesh(), moment.motion)));
  out.Write("motions.csv",
            ToCsv(MakeTable({"motion", "summary", "jump"}, drawn,
                            [](const DrawnMotion& m, const auto& add) {
                              add(m.name, m.summary, Rounded(m.jump_length, 6));
                            })));
  for (const NamedTable& named : PaperTables(results, options)) {
    out.Write(named.file, ToCsv(named.table));
  }
  out.Write("measured.txt",
            Circumstances(
                "`" + CommandLine("build/paper_benchmark", argc, argv) + "`",
                options.seed) +
                "\n");
  out.Commit();
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("paper_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
