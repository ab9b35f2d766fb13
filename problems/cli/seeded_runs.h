// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "problems/output_files.h"
#include "problems/path_picture.h"

// Runs of one scene with the seeds S, S + 1, ...: the flags that commands made
// of them share, and what the runs leave behind.
namespace phongpd::cli {

struct SeededRunFlags {
  std::string scene;
  std::string root;        // of its mesh files; empty: anywhere
  std::uint64_t seed = 0;  // S
  int runs = 1;
  std::string time_limit;  // of a run; the command says what it limits
  std::string output;
  std::string html;
  std::string svg;
  bool no_cache = false;
};

// Declare the argument SCENE and --root, --seed and --runs, --output, --html
// and --svg.
void AddScene(CLI::App* app, SeededRunFlags* flags);
void AddRuns(CLI::App* app, const std::string& seed_help,
             SeededRunFlags* flags);
void AddRowOutput(CLI::App* app, SeededRunFlags* flags);
void AddPictures(CLI::App* app, SeededRunFlags* flags);

// A row of --output and a line on standard output for each run, and all paths
// in the pictures.
class SeededRuns {
 public:
  // Declares the outputs; `header` is the line above those of the runs, and
  // `flags` must outlive this.  Throws InputError naming a file.
  SeededRuns(const SeededRunFlags& flags, const std::string& header);

  // For outputs of the command's own, until Commit.
  OutputFiles& outputs() { return outputs_; }

  // Notes a run that is over.  `line` and, unless empty, `why` (the answer is
  // not what it might be) are for people; no path that is free: no answer.
  void Add(const nlohmann::ordered_json& row, const NamedPath& path,
           const std::string& line, const std::string& why);

  // Writes the rows, and the pictures of the scene with the paths of all runs.
  void Write(PathScene scene);

  // Returns kDone if every run had an answer, kNoAnswer otherwise.
  int Commit();

 private:
  const SeededRunFlags& flags_;
  std::string header_;  // until it is printed
  OutputFiles outputs_;
  std::string rows_;
  std::vector<NamedPath> paths_;
  bool are_all_answered_ = true;
};

}  // namespace phongpd::cli
