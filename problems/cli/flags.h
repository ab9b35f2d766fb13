// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "problems/output/output_files.h"

// What flags of several commands have in common.
namespace phongpd::cli {

// Declares --json: the answer as JSON, to --output where that is its file, else
// to standard output; `what` says of what it consists.
void AddJson(CLI::App* app, bool* json, const std::string& what);

// The name a command writes its answer to: standard output for none.
std::string AnswerTarget(const std::string& output);

// How the name of a file ends, in small letters, with the point.
std::string EndingOf(const std::string& path);

// How an answer is written: as the name of its file ends, in .csv, .json or
// .jsonl; else as JSON where --json asks for it, or as the command usually
// does. Throws InputError where --json meets a .csv.
enum class AnswerForm { kUsual, kCsv, kJson };
AnswerForm FormOf(const std::string& output, bool json);

// Throws InputError unless the name of a file says what the flag writes: ends
// in one of `endings` (".svg"), in any case; standard output and devices have
// no ending.  Empty names are no files.
void RequireEnding(const std::string& path, const std::string& flag,
                   const std::vector<std::string>& endings);

// Declares an output that may be left out (empty), with a name as above.
void DeclareIfNamed(OutputFiles* outputs, const std::string& path,
                    const std::string& flag,
                    const std::vector<std::string>& endings);

// Declares an output of values, which may have any name but one that promises
// a picture, a page, a mesh or a contact space.
void DeclareTable(OutputFiles* outputs, const std::string& path,
                  const std::string& flag);
// The same of rows, JSON Lines, which no table's name may hide.
void DeclareRowFile(OutputFiles* outputs, const std::string& path,
                    const std::string& flag);

// Refuse numbers outside of a range, and all that is none, in words; CLI11's
// own write out the largest double.
CLI::Validator AtLeast(double least);
CLI::Validator Above(double least);
CLI::Validator Between(double least, double most);

// A time in seconds: a number, or one that says its unit: 500us, 500ms, 2s,
// 5min, 2h.  Throws InputError "WHAT: expected ..., found TEXT" for anything
// else, negative numbers among them.
double ParseSeconds(const std::string& text, const std::string& what);

// Take what ParseSeconds reads, of what is above 0 or not below, and make plain
// numbers of it, in seconds: for Option::transform.
CLI::Validator SecondsAboveZero();
CLI::Validator SecondsFromZero();

// Refuses what is no folder.
CLI::Validator IsFolder();

// Throws InputError where an output is standard output: --json is to be there.
void RequireFreeStandardOutput(const OutputFiles& outputs);

// The end of a command's --help: commands that work as they stand.
void AddExamples(CLI::App* app, const std::vector<std::string>& lines,
                 const std::string& before = "");

}  // namespace phongpd::cli
