// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/counted.h"
#include "problems/cli/command.h"
#include "problems/cli/comparison_output.h"
#include "problems/cli/flags.h"
#include "problems/cli/shard.h"
#include "problems/output/gnuplot.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/studies/comparison_rows.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MergeFlags {
  std::vector<std::string> folders;
  std::string output;
  bool json = false;
};

struct Part {
  std::string folder;
  ShardRecord record;
};

std::string Missing(const std::map<int, Part>& parts, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (parts.count(i) != 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(i) + "/" +
            std::to_string(count);
  }
  return text;
}

// All parts of one command, each once, by number.  Throws InputError naming
// what is lost, repeated or of another command.
std::map<int, Part> ReadParts(const std::vector<std::string>& folders) {
  std::map<int, Part> parts;
  std::string first_folder, command;
  int count = 0;
  for (const std::string& folder : folders) {
    const ShardRecord record = ReadShard(folder);
    if (first_folder.empty()) {
      first_folder = folder;
      command = record.command;
      count = record.shard.count;
    }
    if (record.command != command || record.shard.count != count) {
      throw InputError(folder + ": expected a part of the command that " +
                       first_folder + " is of, found one of another");
    }
    const auto [at, is_new] =
        parts.emplace(record.shard.index, Part{folder, record});
    if (!is_new) {
      throw InputError(folder + ": expected every part once, found " +
                       std::to_string(record.shard.index) + "/" +
                       std::to_string(count) + " in " + at->second.folder +
                       ", too");
    }
  }
  const std::string missing = Missing(parts, count);
  if (!missing.empty()) {
    throw InputError("merge: expected all " + std::to_string(count) +
                     " parts, found " + std::to_string(parts.size()) +
                     "; without " + missing);
  }
  return parts;
}

// One problem's rows follow each other.
bool AreOfOneProblem(const Json& a, const Json& b) {
  return a.at("scene") == b.at("scene") && a.at("seed") == b.at("seed");
}

// In the order of a command that was not parted: a problem of each part in
// turn.
std::vector<Json> Interleaved(const std::map<int, Part>& parts) {
  std::vector<std::vector<Json>> rows;
  for (const auto& [index, part] : parts) {
    const std::string path = part.folder + "/rows.jsonl";
    rows.push_back(part.record.rows == 0 ? std::vector<Json>()
                                         : ReadComparison(path));
    if (rows.back().size() == part.record.rows) continue;
    throw InputError(path + ": expected " + std::to_string(part.record.rows) +
                     " rows, as " + kShardFile + " says, found " +
                     std::to_string(rows.back().size()));
  }
  std::vector<std::size_t> next(rows.size(), 0);
  std::vector<Json> all;
  for (bool is_moving = true; is_moving;) {
    is_moving = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t begin = next[i];
      while (next[i] < rows[i].size() &&
             AreOfOneProblem(rows[i][begin], rows[i][next[i]])) {
        all.push_back(rows[i][next[i]++]);
        is_moving = true;
      }
    }
  }
  return all;
}

int Merge(const MergeFlags& flags) {
  const bool has_folder = !flags.output.empty();
  if (has_folder) RequireGnuplot();
  const std::map<int, Part> parts = ReadParts(flags.folders);
  std::vector<Json> rows = Interleaved(parts);
  if (rows.empty()) throw InputError("merge: expected rows, found none");
  std::string lines;
  for (const Json& row : rows) lines += JsonText(row) + '\n';
  OutputFiles outputs;
  std::string table;
  if (has_folder) {
    outputs.MakeDirectory(flags.output);
    const std::string path = flags.output + "/rows.jsonl";
    outputs.Declare(path);
    outputs.Write(path, lines);
    table = WriteSummaries(rows, flags.output, &outputs);
  } else {
    table = SummaryTable(rows);
  }
  const std::size_t count = rows.size();
  rows.clear();  // to destroy JSON takes memory: not after the outputs are
                 // there
  CommitAndTell(&outputs, flags.json ? lines : table);
  Note(Counted(count, "row") + " of " + Counted(parts.size(), "part"));
  return kDone;
}

}  // namespace

Command AddMerge(CLI::App* app) {
  auto flags = std::make_shared<MergeFlags>();
  app->add_option("parts", flags->folders,
                  "Directories that compare --shard i/n wrote: all n, in any "
                  "order")
      ->required()
      ->type_name("DIR");
  app->add_option("--output", flags->output,
                  "Directory for rows.jsonl, in the order of one whole "
                  "command, and what compare makes of it; if not set, the "
                  "table on standard output is all")
      ->type_name("DIR");
  AddJson(app, &flags->json, "The rows on standard output, as JSON Lines");
  AddExamples(
      app, {"phongpd merge part* --output comparison"},
      "A part that is lost, repeated, cut short or of another command is "
      "named, and nothing is written.");
  return [flags] { return Merge(*flags); };
}

}  // namespace phongpd::cli
