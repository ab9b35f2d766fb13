// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/counted.h"
#include "core/mesh/input_file.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/temporary_folder.h"
#include "problems/studies/reproduction.h"

namespace phongpd::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ReproduceFlags {
  std::string output;
  std::string replay;
  std::string folder;
  bool no_run = false;
  bool json = false;
  std::vector<std::string> command;
};

CommandOutcome RunIn(const fs::path& folder, const TemporaryFolder& scratch,
                     const Json& document, const std::string& name) {
  fs::create_directory(folder);
  UnpackCommand(document, name, folder.string());
  return RunCommand(PackedArguments(document, name), folder.string(),
                    scratch.path().string());
}

std::string Ending(int exit_code, int signal) {
  return exit_code >= 0 ? "exit code " + std::to_string(exit_code)
                        : "signal " + std::to_string(signal);
}

int Pack(const ReproduceFlags& flags) {
  const std::string target = AnswerTarget(flags.output);
  OutputFiles outputs;
  DeclareIfNamed(&outputs, target, "--output", {".json"});
  if (flags.json && !flags.output.empty()) RequireFreeStandardOutput(outputs);
  Json document = PackCommand(flags.command);
  PackedArguments(document, "reproduce");
  std::string ending = "not run";
  if (!flags.no_run) {
    Progress("running it");
    const TemporaryFolder temporary;
    const CommandOutcome outcome =
        RunIn(temporary.path() / "run", temporary, document, "reproduce");
    document["run"] = {{"exit_code", outcome.exit_code},
                       {"signal", outcome.signal},
                       {"seconds", outcome.seconds},
                       {"stdout", outcome.out},
                       {"stderr", outcome.err}};
    ending = Ending(outcome.exit_code, outcome.signal);
  }
  outputs.Write(target, JsonText(document, 1) + '\n');
  const std::size_t files = document["files"].size();
  const Json told = {{"file", flags.output}, {"files", files}, {"end", ending}};
  const bool is_told = flags.json && !flags.output.empty();
  CommitAndTell(&outputs, is_told ? JsonText(told) + '\n'
                                  : target + ": " + Counted(files, "file") +
                                        " packed, " + ending + '\n');
  return kDone;
}

int CompareAsJson(const Json& document, const CommandOutcome& now) {
  const auto outcome = [](int exit_code, int signal, const std::string& out,
                          const std::string& err) {
    return Json({{"exit_code", exit_code},
                 {"signal", signal},
                 {"stdout", out},
                 {"stderr", err}});
  };
  const Json& run = document.value("run", Json());
  Json recorded, is_same;
  if (run.is_object()) {
    recorded = outcome(run.value("exit_code", -1), run.value("signal", 0),
                       run.value("stdout", std::string()),
                       run.value("stderr", std::string()));
    is_same = recorded["exit_code"] == now.exit_code &&
              recorded["signal"] == now.signal && recorded["stderr"] == now.err;
  }
  const Json told = {
      {"same", is_same},
      {"now", outcome(now.exit_code, now.signal, now.out, now.err)},
      {"recorded", recorded}};
  std::cout << JsonText(told, 2) << '\n';
  return is_same.is_boolean() && !is_same.get<bool>() ? kNoAnswer : kDone;
}

// The inputs of a command, as text.
constexpr std::uintmax_t kMaxReplayBytes = std::uintmax_t{1} << 32;

int Replay(const ReproduceFlags& flags) {
  const Json document = Json::parse(
      ReadInputFile(flags.replay, "a file written by phongpd reproduce",
                    kMaxReplayBytes),
      nullptr, false);
  const TemporaryFolder temporary;
  const fs::path folder = flags.folder.empty() ? temporary.path() / "run"
                                               : fs::absolute(flags.folder);
  if (fs::exists(folder)) {
    throw InputError("--folder: expected a name that is free, found " +
                     flags.folder);
  }
  PackedArguments(document, flags.replay);
  const CommandOutcome now = RunIn(folder, temporary, document, flags.replay);
  if (flags.json) return CompareAsJson(document, now);
  std::cout << now.out;
  std::cerr << now.err;
  std::cout << Ending(now.exit_code, now.signal);
  const Json& run = document.value("run", Json());
  if (!run.is_object()) {
    std::cout << "; none was recorded\n";
    return kDone;
  }
  const int exit_code = run.value("exit_code", -1);
  const int signal = run.value("signal", 0);
  const bool same_end = exit_code == now.exit_code && signal == now.signal;
  const bool same_words = run.value("stderr", std::string()) == now.err;
  std::cout << (same_end ? ", as recorded"
                         : "; recorded: " + Ending(exit_code, signal))
            << (same_words ? "" : "; another text on stderr") << '\n';
  return same_end && same_words ? kDone : kNoAnswer;
}

int Reproduce(const ReproduceFlags& flags) {
  if (flags.replay.empty() == flags.command.empty()) {
    throw InputError(
        "reproduce: expected -- COMMAND ARGUMENTS, or --replay FILE, found " +
        std::string(flags.replay.empty() ? "neither" : "both"));
  }
  if (!flags.replay.empty()) return Replay(flags);
  return Pack(flags);
}

}  // namespace

Command AddReproduce(CLI::App* app) {
  auto flags = std::make_shared<ReproduceFlags>();
  app->add_option("--output", flags->output,
                  "JSON file with the command, its inputs, versions and "
                  "outcome; no folder, user or host is named in it (standard "
                  "output if not set)")
      ->type_name("FILE");
  app->add_flag("--no-run", flags->no_run,
                "Pack only, for a command that does not end");
  app->add_option("--replay", flags->replay,
                  "Run what such a file holds and compare exit code and "
                  "messages; 0: the same, 1: not")
      ->type_name("FILE");
  app->add_option("--folder", flags->folder,
                  "New folder to unpack the inputs of --replay to and to keep "
                  "them (otherwise a temporary one)")
      ->type_name("DIR");
  app->add_option("command", flags->command,
                  "After --: the command to pack, as it was given to phongpd")
      ->type_name("COMMAND ARGUMENTS");
  AddJson(app, &flags->json,
          "What was packed or replayed as JSON on standard output");
  AddExamples(app, {"phongpd reproduce --output report.json -- plan scene.json "
                    "--output p.jsonl",
                    "phongpd reproduce --replay report.json"});
  return [flags] { return Reproduce(*flags); };
}

}  // namespace phongpd::cli
