// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"
#include "problems/studies/reproduction.h"

namespace phongpd {
namespace {

std::string Content(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Says nothing of where it ran.
void Forget(const std::string& folder, std::string* text) {
  for (std::size_t at = text->find(folder); at != std::string::npos;
       at = text->find(folder, at + 1)) {
    text->replace(at, folder.size(), ".");
  }
}

}  // namespace

CommandOutcome RunCommand(const std::vector<std::string>& arguments,
                          const std::string& folder,
                          const std::string& scratch) {
  const Stopwatch stopwatch;
  const std::string out = scratch + "/out", err = scratch + "/err";
  const std::string program =
      std::filesystem::read_symlink("/proc/self/exe").string();

  std::vector<std::string> words = {"phongpd"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv, environment;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::string own_cache = "PHONGPD_CACHE_DIR=" + scratch + "/cache";
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    if (std::string(*entry).rfind("PHONGPD_CACHE_DIR=", 0) == 0) continue;
    environment.push_back(*entry);
  }
  environment.push_back(own_cache.data());
  environment.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), flags, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int failure = posix_spawn(&child, program.c_str(), &actions, nullptr,
                                  argv.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failure != 0 || waitpid(child, &status, 0) != child) {
    throw InputError("the program cannot be started in " + folder);
  }
  CommandOutcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  outcome.seconds = stopwatch.Seconds();
  outcome.out = Content(out);
  outcome.err = Content(err);
  for (std::string* text : {&outcome.out, &outcome.err}) {
    Forget(folder, text);
    Forget(scratch, text);
  }
  return outcome;
}

}  // namespace phongpd
