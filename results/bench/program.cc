// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/program.h"

#include <exception>
#include <filesystem>
#include <iostream>

namespace phongpd::bench {

Program::Program(int argc, char** argv) : argc_(argc), argv_(argv) {}

CLI::App& Program::Options(const std::string& what) {
  app_.description(what);
  return app_;
}

CLI::App& Program::WithOutput(const std::string& what) {
  app_.add_option("--output", folder_, "Directory to write into")->required();
  return Options(what);
}

void Program::Parse() {
  app_.parse(argc_, argv_);
  if (!folder_.empty()) std::filesystem::create_directories(folder_);
}

void Program::Write(const std::string& file, const std::string& content) {
  if (!outputs_) outputs_.emplace();
  const std::string path = folder_ + "/" + file;
  outputs_->Declare(path);
  outputs_->Write(path, content);
}

void Program::Write(const std::vector<NamedTable>& tables) {
  for (const NamedTable& named : tables) Write(named.file, ToCsv(named.table));
}

void Program::Finish(std::uint64_t seed, const std::string& file,
                     const std::string& command) {
  Write(
      file,
      bench::Circumstances(command.empty() ? Command() : command, seed) + "\n");
  Commit();
}

void Program::Commit() {
  outputs_->Commit();
  outputs_.reset();
}

std::string Program::Name() const {
  return std::filesystem::path(argv_[0]).filename().string();
}

std::string Program::Command() const {
  return CommandLine("build/" + Name(), argc_, argv_);
}

std::string Program::Circumstances(std::uint64_t seed) const {
  return bench::Circumstances(Command(), seed);
}

std::vector<std::string> Program::arguments() const {
  return {argv_ + 1, argv_ + argc_};
}

int Main(Program* program) {
  try {
    return Run(program);
  } catch (const CLI::ParseError& error) {
    return program->app_.exit(error);
  } catch (const std::exception& error) {
    std::cerr << program->Name() << ": " << error.what() << '\n';
    return 3;
  }
}

}  // namespace phongpd::bench

int main(int argc, char** argv) {
  phongpd::bench::Program program(argc, argv);
  return phongpd::bench::Main(&program);
}
