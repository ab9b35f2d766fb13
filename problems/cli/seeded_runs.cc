// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/seeded_runs.h"

#include <iostream>
#include <limits>
#include <utility>

#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/cli/serve_view.h"
#include "problems/output/json_text.h"
#include "viewer/behind_json.h"
#include "viewer/path_picture.h"
#include "viewer/view_page.h"

namespace phongpd::cli {

void AddScene(CLI::App* app, SeededRunFlags* flags) {
  flags->app = app;
  app->add_option("scene", flags->scene,
                  "Scene file, or FAMILY:key=value,... (see scenes list)")
      ->required()
      ->type_name("SCENE");
  AddRoot(app, &flags->root);
  AddRepair(app, &flags->repair);
}

void AddRuns(CLI::App* app, const std::string& seed_help,
             SeededRunFlags* flags) {
  app->add_option("--seed", flags->seed, seed_help)
      ->check(AtLeast(0.0))
      ->type_name("S")
      ->capture_default_str();
  app->add_option("--runs", flags->runs, "Runs, with seeds S, S+1, ...")
      ->type_name("N")
      ->capture_default_str();
}

void AddRowOutput(CLI::App* app, SeededRunFlags* flags) {
  app->add_option(
         "--output", flags->output,
         "JSON Lines, one object a run. Until all are done they are in "
         "FILE.partial, from which the same command goes on if it "
         "is interrupted. If not set, a line a run is all")
      ->type_name("FILE");
  AddJson(app, &flags->json, "The rows on standard output without --output");
}

void AddPictures(CLI::App* app, SeededRunFlags* flags) {
  app->add_option("--html", flags->html,
                  "Page with obstacles, contact space, paths and the moving "
                  "robot, to turn and cut (as view makes it); needs nothing "
                  "from elsewhere")
      ->type_name("FILE");
  app->add_option("--svg", flags->svg,
                  "Contact space and paths as a still picture of lines")
      ->type_name("FILE");
}

void AddModel(CLI::App* app, const std::string& doing,
              const std::string& of_window, std::string* model) {
  app->add_option("--model", *model,
                  "What is built to " + doing +
                      " in: all of the contact space (full), free space alone, "
                      "at a fraction of the cost, " +
                      of_window +
                      " (window), or all of it where it is needed and the "
                      "limits below allow it (auto; scene's own if not set)")
      ->check(CLI::IsMember({"auto", "window", "full"}));
}

double NumberAt(const nlohmann::ordered_json& row, const char* pointer) {
  const auto& value = row.at(nlohmann::ordered_json::json_pointer(pointer));
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                         : value.get<double>();
}

std::string RunLine(const std::string& scene, const std::string& by,
                    std::uint64_t seed, const std::string& status,
                    const std::vector<std::string>& numbers) {
  std::string line =
      scene + ", " + by + ", " + std::to_string(seed) + ": " + status;
  for (const std::string& number : numbers) line += ", " + number;
  return line;
}

SeededRuns::SeededRuns(const SeededRunFlags& flags, const SceneSource& source,
                       const std::string& header, KeptSummarizer summarize)
    : flags_(flags),
      target_(flags.output.empty() && flags.json ? kStandardOutput
                                                 : flags.output),
      header_(header + '\n'),
      summarize_(std::move(summarize)) {
  if (!target_.empty()) DeclareRowFile(&outputs_, target_, "--output");
  DeclareIfNamed(&outputs_, flags.html, "--html", {".html", ".htm"});
  DeclareIfNamed(&outputs_, flags.svg, "--svg", {".svg"});
  if (!flags.html.empty()) RequireViewer();
  rows_ =
      std::make_unique<RowFile>(target_.empty() ? "" : outputs_.Target(target_),
                                CommandSettings(*flags.app, {source}));
  kept_ = static_cast<int>(rows_->rows().size());
  if (kept_ == 0) return;
  Note("going on after " + std::to_string(kept_) + " of " +
       std::to_string(flags.runs) + " runs in " + rows_->path());
  if (kept_ > flags.runs) {
    throw InputError(rows_->path() + ": expected at most " +
                     std::to_string(flags.runs) + " rows, found " +
                     std::to_string(kept_) + "; remove the file");
  }
  for (int i = 0; i < kept_; ++i) {
    const std::uint64_t seed = flags.seed + static_cast<std::uint64_t>(i);
    try {
      TakeUp(static_cast<std::size_t>(i), seed);
    } catch (const nlohmann::json::exception& error) {
      throw InputError(rows_->path() + ": expected in row " +
                       std::to_string(i + 1) +
                       " what this command writes, found something else (" +
                       error.what() + "); remove the file");
    }
  }
}

void SeededRuns::TakeUp(std::size_t i, std::uint64_t seed) {
  const auto row = nlohmann::ordered_json::parse(rows_->rows()[i]);
  if (row.at("seed") != seed) {
    throw InputError(rows_->path() + ": expected in row " +
                     std::to_string(i + 1) + " seed " + std::to_string(seed) +
                     ", found " + JsonText(row.at("seed")).substr(0, 40) +
                     "; remove the file");
  }
  Tell(summarize_(row));
  const std::string& aside = rows_->asides()[i];
  if (ShowsBehind() && !aside.empty()) {
    paths_.back().behind = BehindOf(nlohmann::ordered_json::parse(aside));
  }
}

void SeededRuns::Add(RunSummary run, const nlohmann::ordered_json& row,
                     ViewBehind behind) {
  rows_->Append(JsonText(row),
                ShowsBehind() ? JsonText(BehindJson(behind)) : "");
  Tell(std::move(run));
  paths_.back().behind = std::move(behind);
}

void SeededRuns::Tell(RunSummary run) {
  are_all_answered_ =
      are_all_answered_ && run.path.is_free && !run.misses_clearance;
  paths_.push_back(std::move(run.path));
  std::ostream& out = outputs_.UseStandardOutput() ? std::cerr : std::cout;
  out << std::exchange(header_, "") << run.line << '\n';
  if (!run.why.empty()) out << "  " << run.why << '\n';
}

void SeededRuns::Write(const std::function<View()>& make_view) {
  if (!target_.empty()) outputs_.Write(target_, rows_->Content());
  if (flags_.html.empty() && flags_.svg.empty()) return;
  View view = make_view();
  view.paths = paths_;
  view.serve_command = ServeCommand({flags_.scene}, flags_.root, flags_.repair);
  if (!ShowsBehind() && !flags_.html.empty()) {
    view.notes.push_back(
        "What lies behind a run, such as its iterations or trees, is on the "
        "page of a single run (--runs 1).");
  }
  if (!flags_.html.empty()) outputs_.Write(flags_.html, ViewPage(view));
  if (!flags_.svg.empty()) outputs_.Write(flags_.svg, PathSvg(view));
}

int SeededRuns::Commit() {
  outputs_.Commit();
  rows_->Finish();
  return are_all_answered_ ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
