// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "problems/output/programs.h"

extern char** environ;

namespace phongpd {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Anonymous files instead of pipes: gnuplot may write before it has read
// everything, and two full pipes would wait for each other for ever.
File AnonymousFile() {
  File file(std::tmpfile());
  if (!file) {
    throw InputError(std::string("plots: no temporary file for gnuplot (") +
                     std::strerror(errno) + ")");
  }
  return file;
}

std::string Content(std::FILE* file) {
  std::rewind(file);
  std::string text;
  char buffer[65536];
  for (std::size_t n = 0;
       (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
    text.append(buffer, n);
  }
  return text;
}

std::string FirstTextLine(const std::string& text) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  }
  return "no message";
}

// Of lines that name no colour: apart for colour-blind readers (Okabe and Ito,
// and two of Tol's), and none so light that it fades on white.
constexpr char kLineColors[] =
    "set linetype 1 lc rgb '#0060B0'\nset linetype 2 lc rgb '#D55E00'\n"
    "set linetype 3 lc rgb '#009E73'\nset linetype 4 lc rgb '#E69F00'\n"
    "set linetype 5 lc rgb '#CC79A7'\nset linetype 6 lc rgb '#56B4E9'\n"
    "set linetype 7 lc rgb '#882255'\nset linetype 8 lc rgb '#999933'\n";

}  // namespace

void RequireGnuplot() {
  if (!FindProgram({"gnuplot"}).empty()) return;
  throw InputError(
      "plots: expected the program gnuplot on PATH, found none; install the "
      "Debian package gnuplot-nox");
}

std::string GnuplotText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c;
    if (c == '\'') quoted += c;
  }
  return quoted + "'";
}

std::string RenderSvg(const std::string& script, int width, int height) {
  RequireGnuplot();
  const File input = AnonymousFile();
  const File output = AnonymousFile();
  const File errors = AnonymousFile();
  const std::string all =
      "set encoding utf8\nset terminal svg size " + std::to_string(width) +
      "," + std::to_string(height) +
      " dynamic enhanced font 'sans-serif,13' background rgb 'white'\n" +
      kLineColors + script + "\n";
  if (std::fwrite(all.data(), 1, all.size(), input.get()) != all.size() ||
      std::fflush(input.get()) != 0) {
    throw InputError(std::string("plots: a temporary file for gnuplot cannot "
                                 "be written (") +
                     std::strerror(errno) + ")");
  }
  std::rewind(input.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(input.get()), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(output.get()), 1);
  posix_spawn_file_actions_adddup2(&actions, fileno(errors.get()), 2);
  char program[] = "gnuplot";
  char* arguments[] = {program, nullptr};
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw InputError(std::string("plots: gnuplot could not be started (") +
                     std::strerror(failed) + ")");
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::string svg = Content(output.get());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 ||
      svg.find("</svg>") == std::string::npos) {
    throw std::runtime_error("gnuplot failed: " +
                             FirstTextLine(Content(errors.get())));
  }
  return svg;
}

}  // namespace phongpd
