// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what the campaign at the extremes found.  Gathers the rows that the
// test programs printed, the motion checks and the fuzzing into README.md;
// exit code 1 where anything failed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "problems/output/json_text.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

using Json = nlohmann::ordered_json;

// The log of one test program: its rows, and what it ended with.
struct Log {
  std::string program;
  std::vector<Json> rows;
  int exit_code = -1;  // −1: the log has no end
  double seconds = 0.0;
};

// Lines "CAMPAIGN {…}" anywhere, and last "END <exit code> <seconds>".
Log ReadLog(const std::filesystem::path& path) {
  Log log;
  log.program = path.stem().string();
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    constexpr char kRow[] = "CAMPAIGN ";
    if (line.rfind(kRow, 0) == 0) {
      Json row = Json::parse(line.substr(sizeof kRow - 1));
      row["program"] = log.program;
      log.rows.push_back(std::move(row));
    } else if (line.rfind("END ", 0) == 0) {
      std::istringstream(line.substr(4)) >> log.exit_code >> log.seconds;
    }
  }
  return log;
}

std::vector<Log> ReadLogs(const std::string& directory) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".log") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Log> logs;
  for (const auto& path : paths) logs.push_back(ReadLog(path));
  if (logs.empty()) {
    throw InputError(directory +
                     ": expected logs of test programs, found none");
  }
  return logs;
}

bool IsAboveBound(const Json& row) {
  const double bound = row["bound"];
  return bound > 0.0 && !(row["worst"].get<double>() <= bound);
}

// A CSV file as a table; cells hold no commas.
Table ReadTable(const std::string& file, const std::string& title,
                const std::string& note) {
  Table table{title, note, {}, {}};
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) {
      cells.push_back(cell);
    }
    if (table.header.empty()) {
      table.header = cells;
    } else if (cells.size() == table.header.size()) {
      table.rows.push_back(cells);
    } else {
      throw InputError(file + ": expected " +
                       std::to_string(table.header.size()) +
                       " columns, found '" + line + "'");
    }
  }
  return table;
}

// Sum of a column of counts; 0 where there is no such column.
long Sum(const Table& table, const std::string& column) {
  const auto at = std::find(table.header.begin(), table.header.end(), column);
  if (at == table.header.end()) return 0;
  const auto index = static_cast<std::size_t>(at - table.header.begin());
  long sum = 0;
  for (const auto& row : table.rows) sum += std::stol(row[index]);
  return sum;
}

Table RowsTable(std::vector<Json> rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
    return a["item"].get<std::string>() < b["item"].get<std::string>();
  });
  const auto with_unit = [](const Json& row, const char* key) {
    const double value = row[key];
    if (value == 0.0 && row["bound"] == 0.0) return std::string("–");
    return Rounded(value) + ' ' + row["unit"].get<std::string>();
  };
  return MakeTable(
      "Campaign",
      "`worst` is the largest error seen, `bound` what it may be; without a "
      "bound the failures are all that counts.",
      {"item", "subject", "cases", "failures", "worst", "bound", "seed",
       "program"},
      rows, [&](const Json& row, const auto& add) {
        add(row["item"].get<std::string>(), row["subject"].get<std::string>(),
            std::to_string(row["cases"].get<long>()),
            std::to_string(row["failures"].get<long>()),
            with_unit(row, "worst"), with_unit(row, "bound"),
            std::to_string(row["seed"].get<std::uint64_t>()),
            row["program"].get<std::string>());
      });
}

struct Findings {
  std::string text;
  bool all_well = true;
};

Findings Find(const std::vector<Log>& logs, const Table& motions,
              const Table& fuzzing) {
  Findings found;
  long rows = 0, cases = 0, failures = 0;
  std::string broken;
  for (const Log& log : logs) {
    bool is_broken = log.exit_code != 0;
    for (const Json& row : log.rows) {
      ++rows;
      cases += row["cases"].get<long>();
      failures += row["failures"].get<long>();
      is_broken = is_broken || row["failures"] != 0 || IsAboveBound(row);
    }
    if (!is_broken) continue;
    broken += (broken.empty() ? "" : ", ") + log.program;
    if (log.exit_code != 0) {
      broken += " (exit code " + std::to_string(log.exit_code) + ")";
    }
  }
  found.text = "- " + std::to_string(cases) + " cases in " +
               std::to_string(rows) + " rows: **" + std::to_string(failures) +
               " failures**";
  found.text += broken.empty() ? ".\n" : "; not well: " + broken + ".\n";
  found.all_well = broken.empty() && rows > 0;
  if (!motions.rows.empty()) {
    long wrong = 0, segments = 0;
    for (const auto& row : motions.rows) {
      if (row[1] != "ours") continue;
      segments += std::stol(row[2]);
      wrong += std::stol(row[4]) + std::stol(row[5]);
    }
    found.text += "- Motion checks: " + std::to_string(wrong) + " of " +
                  std::to_string(segments) +
                  " segments judged wrongly by ours; the others below.\n";
    found.all_well = found.all_well && wrong == 0;
  }
  if (!fuzzing.rows.empty()) {
    const long crashes = Sum(fuzzing, "crashes");
    found.text += "- Fuzzing: " + std::to_string(Sum(fuzzing, "runs")) +
                  " runs, " + std::to_string(crashes) + " crashes.\n";
    found.all_well = found.all_well && crashes == 0;
  }
  return found;
}

int Run(int argc, char** argv) {
  CLI::App app("The campaign at the extremes: rows and README.");
  std::string logs_directory, directory, how;
  app.add_option("--logs", logs_directory, "Directory of NAME.log files")
      ->required();
  app.add_option("--output", directory,
                 "Directory to write into; motion_set.csv and fuzzing.csv are "
                 "read from it where they are")
      ->required();
  app.add_option("--how", how, "Command to quote")->required();
  CLI11_PARSE(app, argc, argv);

  const std::vector<Log> logs = ReadLogs(logs_directory);
  const Table motions = ReadTable(
      directory + "/motion_set.csv", "Motion checks",
      "Each class apart: `blocked wrongly` are false alarms, `freed wrongly` "
      "collisions that were missed. [What the set is](motion_set.md).");
  const Table fuzzing = ReadTable(directory + "/fuzzing.csv", "Fuzzing", "");
  std::vector<Json> rows;
  double seconds = 0.0;
  for (const Log& log : logs) {
    rows.insert(rows.end(), log.rows.begin(), log.rows.end());
    seconds += log.seconds;
  }
  const Findings found = Find(logs, motions, fuzzing);
  std::string text =
      "# Stability at the extremes\n\nLong forms of the tests named "
      "`*Campaign*`; each has a short one in the suite.\n\n" +
      found.text + "- What is open, written by hand: [open.md](open.md).\n\n" +
      ToMarkdown(RowsTable(rows)) + "Rows: [rows.jsonl](rows.jsonl).\n\n";
  if (!motions.rows.empty()) {
    text += ToMarkdown(motions) + "Rows: [motion_set.csv](motion_set.csv).\n\n";
  }
  if (!fuzzing.rows.empty()) {
    text += ToMarkdown(fuzzing) + "Rows: [fuzzing.csv](fuzzing.csv).\n\n";
  }
  text += "Command: " + how + ", " + Rounded(seconds / 60.0) +
          " minutes of tests. Machine: " + Machine() +
          ". Versions: " + VersionList() + ".\n";
  std::string lines;
  for (const Json& row : rows) lines += JsonText(row) + '\n';
  OutputDirectory out(directory);
  out.Write("rows.jsonl", lines);
  out.Write("README.md", text);
  out.Commit();
  std::cout << found.text;
  return found.all_well ? 0 : 1;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("extremes_report", phongpd::bench::Run,
                                    argc, argv);
}
