// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/flags.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

// Accepts numbers for which `is_good`.
template <typename Test>
CLI::Validator Numbers(const std::string& range, const Test& is_good) {
  return CLI::Validator(
      [range, is_good](const std::string& text) -> std::string {
        double value = std::nan("");
        const bool is_number = CLI::detail::lexical_cast(text, value);
        if (is_number && is_good(value)) return "";
        return "expected a number " + range + ", found " + text;
      },
      "");
}

// What a number before a unit of time is multiplied by and divided by: both are
// exact, so that 100ms is the same number as 0.1.
struct TimeUnit {
  const char* name;
  double times, over;
};

constexpr TimeUnit kTimeUnits[] = {{"us", 1.0, 1e6},
                                   {"ms", 1.0, 1e3},
                                   {"min", 60.0, 1.0},
                                   {"s", 1.0, 1.0},
                                   {"h", 3600.0, 1.0}};

// Not a number for what is no time.
double SecondsOf(const std::string& text) {
  const std::size_t end = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz");
  const std::string name = text.substr(end + 1);
  std::string number = text.substr(0, end + 1);
  if (number.empty()) return std::nan("");  // inf, nan
  double times = 1.0, over = 1.0;
  if (!name.empty()) {
    const auto* const unit =
        std::find_if(std::begin(kTimeUnits), std::end(kTimeUnits),
                     [&](const TimeUnit& known) { return name == known.name; });
    if (unit == std::end(kTimeUnits)) return std::nan("");
    times = unit->times;
    over = unit->over;
    number.resize(number.find_last_not_of(' ') + 1);
  }
  try {
    const double seconds = ParseDouble(number, "") * times / over;
    return std::isfinite(seconds) ? seconds : std::nan("");
  } catch (const InputError&) {
    return std::nan("");
  }
}

std::string TimeSyntax(const std::string& range) {
  return "expected a number " + range +
         " of seconds, or with its unit as 500ms, 5min or 2h, found ";
}

CLI::Validator Seconds(bool from_zero) {
  return CLI::Validator(
      [from_zero](std::string& text) -> std::string {
        const double seconds = SecondsOf(text);
        if (from_zero ? seconds >= 0.0 : seconds > 0.0) {
          text = FormatDouble(seconds);
          return "";
        }
        return TimeSyntax(from_zero ? ">= 0" : "> 0") + text;
      },
      "");
}

bool IsNoFile(const std::string& path) {
  return path.empty() || path == kStandardOutput || path.rfind("/dev/", 0) == 0;
}

}  // namespace

double ParseSeconds(const std::string& text, const std::string& what) {
  const double seconds = SecondsOf(text);
  if (seconds >= 0.0) return seconds;
  throw InputError(what + ": " + TimeSyntax(">= 0") + text);
}

CLI::Validator SecondsAboveZero() { return Seconds(false); }
CLI::Validator SecondsFromZero() { return Seconds(true); }

void AddJson(CLI::App* app, bool* json, const std::string& what) {
  app->add_flag("--json", *json, what);
}

std::string EndingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return ending;
}

std::string AnswerTarget(const std::string& output) {
  return output.empty() ? kStandardOutput : output;
}

AnswerForm FormOf(const std::string& output, bool json) {
  const std::string found = EndingOf(output);
  if (found == ".csv") {
    if (!json) return AnswerForm::kCsv;
    throw InputError("--json: expected --output FILE.json, found " + output);
  }
  const bool is_json = json || found == ".json" || found == ".jsonl";
  return is_json ? AnswerForm::kJson : AnswerForm::kUsual;
}

void RequireEnding(const std::string& path, const std::string& flag,
                   const std::vector<std::string>& endings) {
  if (IsNoFile(path)) return;
  const std::string found = EndingOf(path);
  if (std::find(endings.begin(), endings.end(), found) != endings.end()) return;
  throw InputError(flag + ": expected a name that ends in " +
                   Joined(endings, " or ") + ", found " + path);
}

void DeclareIfNamed(OutputFiles* outputs, const std::string& path,
                    const std::string& flag,
                    const std::vector<std::string>& endings) {
  if (path.empty()) return;
  RequireEnding(path, flag, endings);
  outputs->Declare(path);
}

void DeclareTable(OutputFiles* outputs, const std::string& path,
                  const std::string& flag) {
  static const std::vector<std::string> others = {
      ".png", ".jpg", ".jpeg", ".gif", ".svg", ".pdf",  ".html", ".htm", ".off",
      ".obj", ".stl", ".ply",  ".glb", ".pcs", ".gltf", ".dae",  ".3mf"};
  const std::string found = IsNoFile(path) ? "" : EndingOf(path);
  if (std::find(others.begin(), others.end(), found) != others.end()) {
    throw InputError(flag +
                     ": expected the name of a table, such as .jsonl, "
                     ".csv or .json, found " +
                     path);
  }
  outputs->Declare(path);
}

void DeclareRowFile(OutputFiles* outputs, const std::string& path,
                    const std::string& flag) {
  const std::string found = IsNoFile(path) ? "" : EndingOf(path);
  if (found == ".csv" || found == ".tsv" || found == ".xlsx" ||
      found == ".parquet") {
    throw InputError(flag +
                     ": expected the name of rows, one line of JSON a run, "
                     "such as .jsonl, found " +
                     path +
                     "; of those, pandas.read_json(FILE, lines=True) makes a "
                     "table");
  }
  DeclareTable(outputs, path, flag);
}

void RequireFreeStandardOutput(const OutputFiles& outputs) {
  if (!outputs.UseStandardOutput()) return;
  throw InputError(
      "--json: expected standard output to be free, found another output "
      "there; name a file");
}

CLI::Validator IsFolder() {
  return CLI::Validator(
      [](const std::string& path) -> std::string {
        std::error_code none;
        if (std::filesystem::is_directory(path, none)) return "";
        const bool is_there = std::filesystem::exists(path, none);
        return "expected a folder, found " +
               (is_there ? path + ", a file" : "nothing at " + path);
      },
      "");
}

CLI::Validator AtLeast(double least) {
  return Numbers(">= " + FormatDouble(least),
                 [least](double value) { return value >= least; });
}

CLI::Validator Above(double least) {
  return Numbers("> " + FormatDouble(least),
                 [least](double value) { return value > least; });
}

CLI::Validator Between(double least, double most) {
  return Numbers("from " + FormatDouble(least) + " to " + FormatDouble(most),
                 [=](double value) { return value >= least && value <= most; });
}

void AddExamples(CLI::App* app, const std::vector<std::string>& lines,
                 const std::string& before) {
  std::string text = before.empty() ? "Examples:" : before + "\nExamples:";
  for (const std::string& line : lines) text += "\n  " + line;
  app->footer(text);
}

}  // namespace phongpd::cli
