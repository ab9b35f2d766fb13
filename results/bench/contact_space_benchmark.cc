// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: time and memory of contact spaces beside CGAL's Nef Minkowski sum
// and a union of hulls on the same inputs in one run, growth with the
// obstacle, one thread against all, and the checks of random pairs.  Writes
// CSV into a directory, of which contact_space_report.py makes the pages.
#include <iostream>
#include <thread>

#include "results/bench/contact_space_rows.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

struct Options {
  std::string only;
  int builds = 5;
  double limit = 60.0;
  double growth_limit = 240.0;
  int pairs = 400;
  int special_pairs = 100;
  double pair_limit = 60.0;
  std::uint64_t seed = 1;
};

void Say(const std::string& what) { std::cerr << what << '\n'; }

std::vector<CaseResult> MeasureCases(const Options& options) {
  std::vector<CaseResult> results;
  for (const BuildCase& build : BuildCases()) {
    Say(build.name);
    CaseResult& r = results.emplace_back();
    r.build = build;
    r.all_threads = MeasureBuild(build, options.builds, 0, options.limit);
    r.one_thread = MeasureBuild(build, options.builds, 1, options.limit);
    if (!build.compete || !HasCompetitors()) continue;
    r.nef = MeasureNef(build, options.limit);
    r.hulls = MeasureHulls(build, options.limit);
  }
  return results;
}

std::vector<GrowthResult> MeasureGrowth(const Options& options) {
  std::vector<GrowthResult> results;
  for (const GrowthSeries& series : GrowthCases()) {
    GrowthResult& r = results.emplace_back();
    r.robot = series.name;
    for (const BuildCase& build : series.cases) {
      Say(series.name + " on a torus of " + build.name);
      r.sizes.push_back(
          MeasureBuild(build, options.builds, 0, options.growth_limit));
    }
  }
  return results;
}

std::vector<FuzzCount> CheckAllPairs(const Options& options) {
  std::vector<FuzzCount> results;
  for (const PairKind kind : AllPairKinds()) {
    const bool voxels = kind <= PairKind::kJittered;
    Say("random pairs: " + Name(kind));
    results.push_back(CheckPairs(kind, options.seed,
                                 voxels ? options.pairs : options.special_pairs,
                                 options.pair_limit));
    for (const std::string& failure : results.back().failures) Say(failure);
  }
  return results;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput(
      "Contact spaces: time, memory, competitors, random pairs.");
  Options options;
  app.add_option("--only", options.only, "Measure one part only")
      ->check(CLI::IsMember({"builds", "growth", "pairs"}));
  app.add_option("--builds", options.builds, "Of each pair, for the median")
      ->capture_default_str();
  app.add_option("--limit", options.limit, "Seconds a process may take")
      ->capture_default_str();
  app.add_option("--growth-limit", options.growth_limit,
                 "Seconds, of the growing obstacles")
      ->capture_default_str();
  app.add_option("--pairs", options.pairs, "Random voxel pairs of each pose")
      ->capture_default_str();
  app.add_option("--special-pairs", options.special_pairs,
                 "Random pegs, touching pairs, cavities, worlds")
      ->capture_default_str();
  app.add_option("--pair-limit", options.pair_limit, "Seconds a random pair")
      ->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();

  ContactSpaceResults results;
  results.limit = options.limit;
  results.pair_limit = options.pair_limit;
  results.seed = options.seed;
  results.threads = static_cast<int>(std::thread::hardware_concurrency());
  const auto wanted = [&](const char* part) {
    return options.only.empty() || options.only == part;
  };
  if (wanted("builds")) results.cases = MeasureCases(options);
  if (wanted("growth")) results.growth = MeasureGrowth(options);
  if (wanted("pairs")) results.fuzz = CheckAllPairs(options);

  program->Write(ContactSpaceTables(results));
  program->Finish(options.seed, "measured.txt", "`" + program->Command() + "`");
  const int failed = FailedPairs(results);
  if (failed > 0) std::cerr << failed << " random pairs failed\n";
  return failed > 0 ? 1 : 0;
}

}  // namespace phongpd::bench
