// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/output/output_files.h"
#include "problems/output/row_file.h"
#include "problems/scenes/scene_source.h"
#include "viewer/view.h"

// Runs of one scene with the seeds S, S + 1, ...: the flags that commands made
// of them share, and what the runs leave behind.
namespace phongpd::cli {

struct SeededRunFlags {
  std::string scene;
  std::string root;               // of its mesh files; empty: anywhere
  std::string repair = "reject";  // of those that do not say
  std::uint64_t seed = 0;         // S
  int runs = 1;
  int threads = 2;         // of a robot that turns
  std::string time_limit;  // of a run; the command says what it limits
  std::string output;
  std::string html;
  std::string svg;
  bool json = false;
  bool no_cache = false;
  const CLI::App* app = nullptr;  // that they were declared on
};

// Declare the argument SCENE, --root and --repair, --seed and --runs, --output
// and --json, --html and --svg.
void AddScene(CLI::App* app, SeededRunFlags* flags);
void AddRuns(CLI::App* app, const std::string& seed_help,
             SeededRunFlags* flags);
void AddRowOutput(CLI::App* app, SeededRunFlags* flags);
void AddPictures(CLI::App* app, SeededRunFlags* flags);
// Declares --model (planners/world/model.h) of what is built "to <doing>";
// `of_window` says what free space alone is good for.
void AddModel(CLI::App* app, const std::string& doing,
              const std::string& of_window, std::string* model);

// What people see of a run, and whether it has an answer: of PathAnswer or
// RigidAnswer.
struct RunSummary {
  NamedPath path;                 // not free: no answer
  bool misses_clearance = false;  // which was required: none either
  std::string line;               // on standard output
  std::string why;  // the answer is not what it might be; or empty
};
// The same of the row of a run that an interrupted command has left.
using KeptSummarizer =
    std::function<RunSummary(const nlohmann::ordered_json& row)>;

// "u, contact-surface, 1: solved, 0.012, 5": the line of a run.
std::string RunLine(const std::string& scene, const std::string& by,
                    std::uint64_t seed, const std::string& status,
                    const std::vector<std::string>& numbers);

// The number at a JSON pointer; NaN for null, as JSON has it.
double NumberAt(const nlohmann::ordered_json& row, const char* pointer);

// A row of --output and a line for people for each run, and all paths in the
// pictures.  Without --output, rows go to standard output with --json, nowhere
// otherwise; lines go to standard error where rows have standard output.  Rows
// are kept as they come and taken up again (RowFile).
class SeededRuns {
 public:
  // Declares the outputs; `header` is the line above those of the runs, and
  // `flags` must outlive this.  Throws InputError naming a file.
  SeededRuns(const SeededRunFlags& flags, const SceneSource& source,
             const std::string& header, KeptSummarizer summarize);

  // For outputs of the command's own, until Commit.
  OutputFiles& outputs() { return outputs_; }

  // How many runs, the first ones, an interrupted command has left.
  int kept() const { return kept_; }

  // Will the page show what lies behind the run?  That of a single run does,
  // which is kept beside its row until the page is written.
  bool ShowsBehind() const { return !flags_.html.empty() && flags_.runs == 1; }

  // Notes a run that is over, with what its page shows behind it.
  void Add(RunSummary run, const nlohmann::ordered_json& row,
           ViewBehind behind = {});

  // Writes the rows, and the pictures of the view with the paths of all runs;
  // without pictures nobody asks for it.
  void Write(const std::function<View()>& view);

  // Returns kDone if every run had an answer, kNoAnswer otherwise.
  int Commit();

 private:
  void Tell(RunSummary run);
  // Kept row i.
  void TakeUp(std::size_t i, std::uint64_t seed);

  const SeededRunFlags& flags_;
  std::string target_;  // of the rows; empty: none
  std::string header_;  // until it is printed
  KeptSummarizer summarize_;
  OutputFiles outputs_;
  std::unique_ptr<RowFile> rows_;
  int kept_ = 0;
  std::vector<NamedPath> paths_;
  bool are_all_answered_ = true;
};

}  // namespace phongpd::cli
