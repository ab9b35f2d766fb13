// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "tests/problems/cli/cli_scenes.h"

// Runs commands that are interrupted.
namespace phongpd {

class CliProcess : public CliScenes {
 protected:
  // Starts the command; returns its process.
  pid_t Start(const std::string& arguments) const {
    // The program takes the shell's place.
    const std::string shell = CommandLine(arguments, "exec env");
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", shell.c_str(), nullptr);
      _exit(127);
    }
    return child;
  }

  // As Outcome::code.
  static int Wait(pid_t process) {
    int status = 0;
    EXPECT_EQ(waitpid(process, &status, 0), process);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  // Starts the command and sends it `signal` after that time; returns as Wait.
  int Interrupt(const std::string& arguments, std::chrono::microseconds after,
                int signal) const {
    const pid_t process = Start(arguments);
    std::this_thread::sleep_for(after);
    kill(process, signal);
    return Wait(process);
  }

  // Until there is such a file in run/ with at least `size` bytes.
  void Await(const std::string& name, std::uintmax_t size) const {
    std::error_code none;
    for (int i = 0; i < 3000; ++i) {
      const std::uintmax_t found =
          std::filesystem::file_size(Output(name), none);
      if (!none && found >= size) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "no " << name;
  }

  // Names in run/, and those in folders there as folder/name.
  std::set<std::string> Names() const {
    namespace fs = std::filesystem;
    std::set<std::string> names;
    const fs::path run = folder_ / "run";
    for (const auto& entry : fs::recursive_directory_iterator(run)) {
      names.insert(fs::relative(entry.path(), run).string());
    }
    return names;
  }

  // How long the command takes.
  std::chrono::microseconds Duration(const std::string& arguments) const {
    const auto start = std::chrono::steady_clock::now();
    Run(arguments);
    return std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::steady_clock::now() - start);
  }

  // Between 0 and `most`.
  std::chrono::microseconds RandomTime(std::chrono::microseconds most) {
    return std::chrono::microseconds(
        std::uniform_int_distribution<long>(0, most.count())(random_));
  }

  std::mt19937 random_{7};
};

}  // namespace phongpd
