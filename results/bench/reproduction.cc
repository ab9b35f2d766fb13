// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: do the published results still come out of this code?  Takes rows
// spread evenly over the published files, makes them anew with the same
// settings and seeds, and compares all but times cell by cell.  Writes
// reproduction.md; deviations are named, not judged.
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/ompl_planning.h"
#include "problems/scenes/kept_world.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/comparison_rows.h"
#include "problems/studies/comparison_run.h"
#include "problems/studies/study_metrics.h"
#include "results/bench/paper_rows.h"
#include "results/bench/planning_rows.h"
#include "results/bench/program.h"
#include "results/bench/slice_check.h"

namespace phongpd::bench {
namespace {

struct Published {
  std::string folder;  // results/
  std::size_t rows;    // of each file

  CsvTable Read(const std::string& file) const {
    return ReadCsvTable(folder + "/" + file);
  }
};

std::uint64_t SeedOf(const CsvTable& table, std::size_t row,
                     const std::string& column) {
  return static_cast<std::uint64_t>(table.Number(row, column));
}

// One published file, and those of its rows that are made anew.
struct PublishedFile {
  Slice slice;
  CsvTable table;
  std::vector<std::size_t> rows;
};

PublishedFile Open(const Published& published, const std::string& file,
                   const std::string& compared) {
  PublishedFile opened{{}, published.Read(file), {}};
  opened.slice.file = file;
  opened.slice.compared = compared;
  opened.slice.published = opened.table.rows().size();
  opened.rows = Spread(opened.slice.published, published.rows);
  return opened;
}

// As phongpd compare runs them.
Slice RemakeConvergence(const Published& published) {
  auto [slice, table, rows] =
      Open(published, "convergence/rows.csv", "all but seconds");
  KeptWorld worlds;
  for (const std::size_t row : rows) {
    const std::string& scene = table.Text(row, "scene");
    const std::string& protocol = table.Text(row, "protocol");
    const std::string& method = table.Text(row, "method");
    const std::uint64_t seed = SeedOf(table, row, "seed");
    const std::string name = scene + ", " + protocol + ", " + method +
                             ", seed " + std::to_string(seed);
    std::cerr << name << '\n';
    const SceneSource source(scene);
    const Scene loaded = source.Load(seed);
    const nlohmann::ordered_json found =
        RunComparison(loaded, worlds.Of(loaded),
                      {seed, FindProtocol(protocol),
                       ParseStudyMetric(method, "method"), source.is_family()});
    CompareRow(table, row, CsvTable(CompactCsv({found}), name), 0,
               {"seconds_callbacks", "seconds_total"}, name, &slice);
  }
  return slice;
}

PlanningProblem FindProblem(const std::vector<PlanningProblem>& problems,
                            const std::string& scene) {
  const auto found = std::find_if(
      problems.begin(), problems.end(),
      [&](const PlanningProblem& problem) { return problem.scene == scene; });
  if (found == problems.end()) {
    throw InputError("reproduction: no problem is called " + scene);
  }
  return *found;
}

const Table& FindTable(const std::vector<NamedTable>& tables,
                       const std::string& file) {
  const auto found =
      std::find_if(tables.begin(), tables.end(),
                   [&](const NamedTable& named) { return named.file == file; });
  if (found == tables.end()) {
    throw InputError("reproduction: no table is called " + file);
  }
  return found->table;
}

// The complete planner.
Slice RemakeExact(const Published& published) {
  auto [slice, table, rows] =
      Open(published, "planning/exact.csv",
           "all but times and the ratio to the best path of all runs");
  for (const std::size_t row : rows) {
    const std::string& scene = table.Text(row, "scene");
    std::cerr << scene << '\n';
    PlanningResults found;
    found.exact.push_back(MeasureExact(FindProblem(ExactProblems(), scene)));
    CompareRow(table, row, CsvTable(ToCsv(ExactTable(found)), scene), 0,
               {"query ms", "tables ms", "contact space ms", "ratio"}, scene,
               &slice);
  }
  return slice;
}

// Sampling planners, one run each.
Slice RemakeSamplers(const Published& published) {
  auto [slice, table, rows] = Open(
      published, "planning/runs.csv",
      "all but seconds, of runs solved by this library's planners, which get a "
      "minute now; whether it was solved, of OMPL's planners, which take more "
      "than one thread, and of runs that time ended");
  std::vector<PlanningProblem> problems = SamplerProblems();
  for (const PlanningProblem& problem : NarrowingProblems()) {
    problems.push_back(problem);
  }
  const std::set<std::string> times = {"seconds", "run"};
  std::set<std::string> counts(table.header().begin(), table.header().end());
  for (const char* kept : {"scene", "planner", "solved"}) counts.erase(kept);
  for (const std::size_t row : rows) {
    const std::string& scene = table.Text(row, "scene");
    const std::string& planner = table.Text(row, "planner");
    const std::uint64_t run = SeedOf(table, row, "run");
    const std::string name =
        scene + ", " + planner + ", run " + std::to_string(run);
    std::cerr << name << '\n';
    const bool has_counts = planner.compare(0, 10, "retraction") == 0 &&
                            table.Text(row, "solved") == "1";
    PlanningResults found;
    if (has_counts) found.options.limit = 60.0;
    found.options.seed += run - 1;
    found.options.seeds = 1;
    found.samplers =
        MeasureSamplers(FindProblem(problems, scene), {planner}, found.options);
    CompareRow(table, row, CsvTable(RunsCsv(found), name), 0,
               has_counts ? times : counts, name, &slice);
  }
  return slice;
}

// The paper's benchmarks: frames of its motions, and the totals of all random
// motions and points.
std::vector<Slice> RemakePaper(const Published& published) {
  PaperOptions options;
  options.builds = 1;
  std::vector<PaperResult> results;
  Slice frames;
  frames.file = "paper/*_across.csv, paper/*_along.csv";
  frames.compared = "all";
  for (const PaperBenchmark& benchmark : PaperBenchmarks()) {
    std::cerr << benchmark.title << '\n';
    results.push_back(Measure(benchmark, options));
    for (std::size_t i = 0; i < benchmark.motions.size(); ++i) {
      const std::string stem = benchmark.name + "_" + benchmark.motions[i].name;
      const CsvTable table = published.Read("paper/" + stem + ".csv");
      const CsvTable found(MotionCsv(results.back().traces[i]), stem);
      frames.published += table.rows().size();
      for (const std::size_t row :
           Spread(table.rows().size(), published.rows / 4)) {
        CompareRow(table, row, found, row, {},
                   stem + ", frame " + table.Text(row, "frame") + ", " +
                       table.Text(row, "metric"),
                   &frames);
      }
    }
  }
  std::vector<Slice> slices = {frames};
  const std::vector<NamedTable> tables = PaperTables(results, options);
  for (const char* file : {"random_motions.csv", "coverage.csv"}) {
    auto [totals, table, rows] =
        Open(published, std::string("paper/") + file, "all");
    const CsvTable found(ToCsv(FindTable(tables, file)), file);
    for (const std::size_t row : rows) {
      CompareRow(table, row, found, row, {},
                 table.rows()[row][0] + ", " + table.rows()[row][1], &totals);
    }
    slices.push_back(totals);
  }
  return slices;
}

std::string Report(const std::vector<Slice>& slices,
                   const std::string& command) {
  std::size_t remade = 0, identical = 0, rounded = 0;
  for (const Slice& slice : slices) {
    remade += slice.remade;
    identical += slice.identical;
    rounded += slice.rounded;
  }
  std::string text =
      "# Do the published results still come out?\n\n"
      "Rows spread evenly over the published files, made anew with the same "
      "settings and\nseeds by the code as it is, and compared cell by cell: " +
      std::to_string(identical) + " of " + std::to_string(remade) +
      " are identical, " + std::to_string(rounded) +
      " but for\nrounding (1e-12).\n\n";
  text += ToMarkdown(
      MakeTable("Rows", "",
                {"file", "rows", "made anew", "identical", "but for rounding",
                 "others", "compared"},
                slices, [](const Slice& s, const auto& add) {
                  add(s.file, s.published, s.remade, s.identical, s.rounded,
                      s.remade - s.identical - s.rounded, s.compared);
                }));
  const Table deviations =
      MakeTable("Deviations", "", {"file", "row", "column", "published", "now"},
                slices, [](const Slice& s, const auto& add) {
                  for (const Deviation& d : s.deviations) {
                    add(s.file, d.row, d.column, d.published, d.found);
                  }
                });
  if (!deviations.rows.empty()) text += '\n' + ToMarkdown(deviations);
  return text + '\n' + Circumstances(command, PaperOptions().seed);
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput(
      "Makes a slice of the published rows anew and compares.");
  std::string how;
  Published published{"results", 40};
  std::vector<std::string> parts = {"paper", "planning", "convergence"};
  app.add_option("--results", published.folder, "Where the published rows are")
      ->capture_default_str();
  app.add_option("--rows", published.rows, "Rows of each file")
      ->capture_default_str()
      ->check(CLI::Range(4, 100000));
  app.add_option("--parts", parts, "Only these")
      ->check(CLI::IsMember(parts))
      ->delimiter(',');
  app.add_option("--how", how, "The command that runs this");
  program->Parse();
  SilenceOmpl();
  const auto wanted = [&parts](const char* part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  std::vector<Slice> slices;
  if (wanted("paper")) slices = RemakePaper(published);
  if (wanted("planning")) {
    slices.push_back(RemakeExact(published));
    slices.push_back(RemakeSamplers(published));
  }
  if (wanted("convergence")) slices.push_back(RemakeConvergence(published));
  const std::string text =
      Report(slices, how.empty() ? program->Command() : how);
  program->Write("reproduction.md", text);
  program->Commit();
  std::cout << text;
  return 0;
}

}  // namespace phongpd::bench
