// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/mesh/counted.h"
#include "problems/cli/command.h"
#include "problems/cli/comparison_jobs.h"
#include "problems/cli/comparison_output.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/cli/shard.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/gnuplot.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/row_file.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/study_metrics.h"
#include "problems/studies/trajectory_comparison.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CompareFlags {
  std::vector<std::string> scenes;
  std::string root;  // of their mesh files; empty: anywhere
  std::string repair = "reject";
  std::vector<std::string> metrics = {"euclidean", "phong@0", "phong@0.1",
                                      "phong@0.2"};
  std::vector<std::string> protocols = {
      "straight-monotone", "straight-adaptive", "repaired-monotone",
      "repaired-adaptive", "pipeline"};
  int runs = 50;
  int max_iterations = 0;  // of a round of Ipopt; 0: the protocol's own
  std::uint64_t seed = 1;
  std::string shard = "0/1";
  std::vector<std::string> rows;
  std::string output;
  bool keep_paths = false;
  bool json = false;
  bool no_cache = false;
};

// What is compared.
struct Methods {
  std::vector<SceneSource> sources;
  std::vector<StudyMetric> metrics;
  std::vector<TrajectoryProtocol> protocols;
};

// Throws InputError for all that can be told to be wrong before a run.
Methods ReadMethods(const CompareFlags& flags) {
  RequireRuns(flags.runs);
  Methods methods;
  std::set<std::string> names;
  for (const std::string& text : flags.scenes) {
    methods.sources.emplace_back(text, flags.root,
                                 ParseRepair(flags.repair, "--repair"));
    const Scene scene = methods.sources.back().Load(flags.seed);
    // Rows know their scene by its name.
    if (!names.insert(scene.name).second) {
      throw InputError(text + ": expected scenes of different names, found '" +
                       scene.name + "' twice");
    }
  }
  for (const std::string& text : flags.metrics) {
    methods.metrics.push_back(ParseStudyMetric(text, "--metrics"));
  }
  for (const std::string& name : flags.protocols) {
    methods.protocols.push_back(FindProtocol(name));
    if (flags.max_iterations > 0) {
      methods.protocols.back().options.optimizer.ipopt.max_iterations =
          flags.max_iterations;
    }
  }
  return methods;
}

// Those of the shard, in the order of their rows.
std::vector<ComparisonJob> Jobs(const CompareFlags& flags,
                                const Methods& methods, const Shard& shard) {
  std::vector<ComparisonJob> jobs;
  ComparisonPart part;
  part.index = shard.index;
  part.count = shard.count;
  part.all_problems = static_cast<int>(methods.sources.size()) * flags.runs;
  for (const SceneSource& source : methods.sources) {
    for (int run = 0; run < flags.runs; ++run, ++part.problem) {
      if (!shard.Has(part.problem)) continue;
      const std::uint64_t seed = flags.seed + static_cast<std::uint64_t>(run);
      for (const TrajectoryProtocol& protocol : methods.protocols) {
        for (const StudyMetric& metric : methods.metrics) {
          jobs.push_back({&source, seed, protocol, metric, part});
        }
      }
    }
  }
  return jobs;
}

// Where the rows go: a file in the folder; without one standard output for
// --json, nowhere (empty) otherwise.
std::string DeclareRows(const CompareFlags& flags, OutputFiles* outputs) {
  std::string path;
  if (!flags.output.empty()) {
    outputs->MakeDirectory(flags.output);
    path = flags.output + "/rows.jsonl";
  } else if (flags.json) {
    path = kStandardOutput;
  }
  if (!path.empty()) outputs->Declare(path);
  return path;
}

int Compare(const CLI::App& app, const CompareFlags& flags) {
  if (flags.scenes.empty() == flags.rows.empty()) {
    throw InputError(
        "compare: expected scenes, or --rows with what was written before, "
        "found " +
        std::string(flags.rows.empty() ? "neither" : "both"));
  }
  const Shard shard = ParseShard(flags.shard, "--shard");
  const bool has_folder = !flags.output.empty();
  if (!has_folder && !shard.IsWhole()) {
    throw InputError("--shard: expected --output DIR with it, found none");
  }
  if (shard.IsWhole() && has_folder) RequireGnuplot();
  Methods methods;
  std::vector<Json> rows;
  if (flags.rows.empty()) {
    methods = ReadMethods(flags);
  } else {
    rows = JoinComparisons(flags.rows);
  }
  OutputFiles outputs;
  const std::string rows_path = DeclareRows(flags, &outputs);
  std::string lines;
  std::unique_ptr<RowFile> file;
  const Json settings = CommandSettings(app, methods.sources);
  if (flags.rows.empty()) {
    file = std::make_unique<RowFile>(
        rows_path.empty() ? "" : outputs.Target(rows_path), settings);
    RunJobs(Jobs(flags, methods, shard), UserCache(flags.no_cache),
            flags.keep_paths, file.get());
    lines = file->Content();
    // As from --rows, so that kept rows and new ones count alike.
    for (const std::string& row : file->rows()) {
      rows.push_back(Json::parse(row));
    }
  } else {
    for (const Json& row : rows) lines += JsonText(row) + '\n';
  }
  if (!rows_path.empty()) outputs.Write(rows_path, lines);
  std::string words;
  if (!shard.IsWhole()) {
    words = Counted(rows.size(), "row") +
            "; join the parts with phongpd compare --rows\n";
  } else if (has_folder) {
    words = WriteSummaries(rows, flags.output, &outputs);
  } else {
    words = SummaryTable(rows);
  }
  rows.clear();  // to destroy JSON takes memory: not after the outputs are
                 // there
  const bool rows_are_told = flags.json && has_folder;
  CommitAndTell(&outputs, rows_are_told ? lines : words);
  if (file != nullptr) file->Finish();
  return kDone;
}

std::string ProtocolsHelp() {
  std::string text = "Ways of running:";
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    text += " " + protocol.name + " (" + protocol.meaning + ");";
  }
  text.back() = '.';
  return text;
}

// What is run on every problem.
void AddComparedMethods(CLI::App* app, CompareFlags* flags) {
  app->add_option("--metrics", flags->metrics,
                  "euclidean, phong@L, phong@L/exact, phong@L/tangent-plane, "
                  "smoothed@L, smoothed-foot@L (Euclid's depth, smoothed "
                  "direction at the position or the contact); L "
                  "is the smoothing length, 0.2 or 0.2D (a share of D) or "
                  "0.5unit (the scene's unit). For this study alone: followed "
                  "(Euclid's local minimum, followed), mixed@L (Euclid's "
                  "value, Phong's direction), faded@L (the same, Euclid's "
                  "direction where walls are near each other), diffused@L "
                  "(Euclid's value, the normal of Phong's field at its "
                  "contact), placebo@L (the same, any direction as far from "
                  "Euclid's as the smoothed one)")
      ->expected(1, -1)
      ->type_name("NAME")
      ->capture_default_str();
  app->add_option("--protocols", flags->protocols, ProtocolsHelp())
      ->expected(1, -1)
      ->type_name("NAME")
      ->capture_default_str();
}

// Which problems of the scenes, and which of them here.
void AddComparedRuns(CLI::App* app, CompareFlags* flags) {
  app->add_option("--runs", flags->runs, "Seeds a scene, paired over methods")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--max-iter", flags->max_iterations,
                  "Iterations that a round of Ipopt may take; 0: as the "
                  "protocol has it, 200")
      ->check(AtLeast(0.0))
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--seed", flags->seed, "The first of them, at least 1")
      ->check(AtLeast(1.0))
      ->type_name("S")
      ->capture_default_str();
  app->add_option("--shard", flags->shard,
                  "Run the i-th of n parts and write rows.jsonl only; --rows "
                  "joins the parts")
      ->type_name("i/n")
      ->capture_default_str();
}

// Rows there are already, what rows hold, and where they go.
void AddComparedRows(CLI::App* app, CompareFlags* flags) {
  app->add_option("--rows", flags->rows,
                  "Summarise these rows instead of running: rows.jsonl of one "
                  "command or of all parts of it, in any order; a part that "
                  "is missing is refused")
      ->expected(1, -1)
      ->type_name("FILE");
  app->add_flag("--paths", flags->keep_paths, "Keep the paths in the rows");
  app->add_option("--output", flags->output,
                  "Directory for rows.jsonl, rows.csv, summary.csv and "
                  "performance profiles. Until all rows are done they are in "
                  "rows.jsonl.partial, from which the same command goes on if "
                  "it is interrupted, by a time limit for example. If not set, "
                  "the table on standard output is all")
      ->type_name("DIR");
  AddJson(app, &flags->json, "The rows on standard output, as JSON Lines");
}

}  // namespace

Command AddCompare(CLI::App* app) {
  auto flags = std::make_shared<CompareFlags>();
  app->add_option("scenes", flags->scenes,
                  "Scene files, or FAMILY:key=value,... (see scenes list)")
      ->type_name("SCENE");
  AddRoot(app, &flags->root);
  AddRepair(app, &flags->repair);
  AddComparedMethods(app, flags.get());
  AddComparedRuns(app, flags.get());
  AddComparedRows(app, flags.get());
  AddNoCache(app, &flags->no_cache);
  AddExamples(
      app,
      {"phongpd compare u_axis plate:thickness=0.02 --runs 10 --output cmp",
       "phongpd compare u_axis --runs 2 --protocols pipeline --json"},
      "On several cores:  seq 0 7 | parallel phongpd compare SCENES --shard "
      "{}/8 --output part{}\n"
      "On a cluster:      sbatch --array=0-31 --wrap 'phongpd compare SCENES "
      "--shard $SLURM_ARRAY_TASK_ID/32 --output part$SLURM_ARRAY_TASK_ID'\n"
      "Parts that were cut off go on where they were when started again.\n"
      "Then:              phongpd compare --rows part*/rows.jsonl --output "
      "DIR");
  return [app, flags] { return Compare(*app, *flags); };
}

}  // namespace phongpd::cli
