// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "problems/output/output_files.h"
#include "results/bench/report.h"

// The frame of every benchmark program: its options, the files that it writes
// together at the end, and the circumstances that every figure comes with.
namespace phongpd::bench {

class Program {
 public:
  Program(int argc, char** argv);

  // For options of its own; `what` stands above the help.  WithOutput has
  // --output DIR, which it asks for.
  CLI::App& Options(const std::string& what);
  CLI::App& WithOutput(const std::string& what);

  // Reads what was given, and makes the folder of --output.  To print help, or
  // to say what is wrong, it throws for main to do so.
  void Parse();
  bool writes() const { return !folder_.empty(); }  // was a folder given?
  const std::string& folder() const { return folder_; }

  // One file of that folder; the rows of tables, each the file it names.
  void Write(const std::string& file, const std::string& content);
  void Write(const std::vector<NamedTable>& tables);

  // Writes the circumstances of the command, unless another is told, as the
  // last file, and all of them appear.
  void Finish(std::uint64_t seed, const std::string& file = "measured.txt",
              const std::string& command = "");
  void Commit();

  std::string Name() const;
  // The command as it was given: "build/NAME --output …"; what is behind it.
  std::string Command() const;
  std::vector<std::string> arguments() const;
  // Those of this run, for a page.
  std::string Circumstances(std::uint64_t seed) const;

 private:
  int argc_;
  char** argv_;
  CLI::App app_;
  std::string folder_;
  std::optional<OutputFiles> outputs_;

  friend int Main(Program* program);
};

// The benchmark: what its source defines, and main runs.  Its exit code; an
// exception becomes one line on stderr, "name: why", and exit code 3.
int Run(Program* program);

}  // namespace phongpd::bench
