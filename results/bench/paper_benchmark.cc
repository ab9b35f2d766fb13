// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the paper's three benchmarks, PhongPD beside Euclidean PD on the
// same contact spaces, in one binary and one run.  Writes CSV, SVG and
// README.md into a directory.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/output/gnuplot.h"
#include "results/bench/moment_figure.h"
#include "results/bench/paper_measure.h"
#include "results/bench/paper_report.h"
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

// What to see in a figure of traces, in one sentence.
std::string Seen(const std::vector<MotionTrace>& traces, double jump_length) {
  std::string text = ". Jumps by more than " + Rounded(jump_length) +
                     " from frame to frame, greatest depth in brackets:";
  for (const MotionTrace& trace : traces) {
    const MotionSummary summary = Summarize(trace, jump_length);
    text += std::string(&trace == &traces.front() ? " " : "; ") + trace.label +
            ": " + std::to_string(summary.jumps) + " (" +
            Rounded(summary.max_magnitude) + ")";
  }
  return text;
}

int Run(int argc, char** argv) {
  CLI::App app("The paper's three benchmarks: tables and figures.");
  std::string directory;
  PaperOptions options;
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--motions", options.motions)->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--points", options.points)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  bool page = false;
  app.add_flag("--page", page, "Write index.html, everything on one page");
  CLI11_PARSE(app, argc, argv);
  RequireGnuplot();

  const std::string command = CommandLine("build/paper_benchmark", argc, argv);

  std::vector<PaperResult> results;
  std::vector<Figure> figures;
  OutputDirectory out(directory);
  for (const PaperBenchmark& benchmark : PaperBenchmarks()) {
    std::cerr << benchmark.title << '\n';
    results.push_back(Measure(benchmark, options));
    const PaperResult& result = results.back();
    for (std::size_t i = 0; i < benchmark.motions.size(); ++i) {
      const PaperMotion& motion = benchmark.motions[i];
      const std::string stem = benchmark.name + "_" + motion.name;
      const std::string caption = benchmark.title + ": " + motion.summary;
      out.Write(stem + ".csv", MotionCsv(result.traces[i]));
      figures.push_back({stem + ".svg",
                         caption + Seen(result.traces[i],
                                        options.jump * result.space->length()),
                         MotionPage(result.traces[i], caption)});
    }
  }
  const PaperMotion moment = PaperMoment();
  const PaperResult& wrench = results.back();
  const std::vector<MotionTrace> traces =
      TraceMoment(*wrench.space, moment.motion);
  out.Write("moment.csv", MotionCsv(traces));
  figures.push_back(
      {"moment.svg",
       moment.summary + Seen(traces, options.jump * wrench.space->length()),
       MomentFigure(wrench.benchmark, wrench.space->mesh(), moment.motion,
                    traces)});

  const std::vector<NamedTable> tables = PaperTables(results, options);
  WriteReport(tables, figures,
              PaperReadme(results, tables, figures, options, command), &out);
  if (page) {
    out.Write("index.html", PaperPage(tables, figures, options, command));
  }
  out.Commit();
  std::cout << ToText(ShortTable(results));
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("paper_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
