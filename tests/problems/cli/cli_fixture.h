// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"

// Runs the phongpd program as a user would.
namespace phongpd {

inline std::string Content(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

// The double that the whole of `text` spells.
inline double Number(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto end = text.data() + text.size();
  const std::from_chars_result read = std::from_chars(text.data(), end, value);
  EXPECT_TRUE(read.ec == std::errc() && read.ptr == end) << text;
  return value;
}

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
  bool has_begun = true;  // false: libraries were not even loaded (RunWatched)
};

// Every test runs in a directory of its own, with a cache of its own.
class Cli : public testing::Test {
 protected:
  void SetUp() override {
    std::string name =
        (std::filesystem::temp_directory_path() / "phongpd_cli_XXXXXX")
            .string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::filesystem::create_directory(folder_ / "run");
    WriteMesh(MakeBox({-1, -1, -1}, {1, 1, 1}), File("box.off"));
    WriteMesh(MakeCone(0.8, 1.6, 8), File("cone.off"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Inputs lie beside run/, in which the program runs and writes.
  std::string File(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::string Output(const std::string& name) const {
    return (folder_ / "run" / name).string();
  }
  void WriteText(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  // What the shell is asked for; `before` are its variables or limits.
  std::string CommandLine(const std::string& arguments,
                          const std::string& before = "") const {
    return "cd '" + Output("") + "' && " + before +
           " PHONGPD_PROGRESS=never PHONGPD_CACHE_DIR='" + File("cache") +
           "' '" PHONGPD_PROGRAM "' " + arguments + " >../out 2>../err";
  }

  // The exit code is 128 + the number of the signal that ended it, if any.
  Outcome Run(const std::string& arguments,
              const std::string& before = "") const {
    const int status = std::system(CommandLine(arguments, before).c_str());
    Outcome outcome;
    outcome.code =
        WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = Content(folder_ / "out");
    outcome.err = Content(folder_ / "err");
    return outcome;
  }

  // The same, and by the loader's own account whether it handed over to the
  // program: where libraries find no memory they end in many ways, and main,
  // which has words for it, was never reached.
  Outcome RunWatched(const std::string& arguments,
                     const std::string& before) const {
    Outcome outcome =
        Run(arguments, before + " LD_DEBUG=files LD_DEBUG_OUTPUT='" +
                           File("loader") + "'");
    outcome.has_begun = false;
    std::vector<std::filesystem::path> accounts;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      if (entry.path().stem() == "loader") accounts.push_back(entry.path());
    }
    for (const std::filesystem::path& account : accounts) {
      outcome.has_begun =
          outcome.has_begun ||
          Content(account).find("transferring control") != std::string::npos;
      std::filesystem::remove(account);
    }
    return outcome;
  }

  // Exit code 2, one line on stderr with every one of `words`, no file.
  void ExpectRefused(const std::string& arguments,
                     const std::vector<std::string>& words) const {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
        << outcome.err;
    EXPECT_EQ(outcome.err.rfind("phongpd: ", 0), 0U) << outcome.err;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos)
          << "no '" << word << "' in: " << outcome.err;
    }
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "run")) << arguments;
  }

  // The same for a mesh as robot and as obstacle.
  void ExpectMeshRefused(const std::string& file,
                         const std::vector<std::string>& words) const {
    std::vector<std::string> all = words;
    all.push_back(file);
    ExpectRefused("contact-space --robot ../" + file +
                      " --obstacle ../box.off --output c.off --report r.json",
                  all);
    ExpectRefused("motion --robot ../box.off --obstacle ../" + file +
                      " --from 0 0 0 --to 1 0 0 --frames 5 --output m.csv",
                  all);
  }

  std::filesystem::path folder_;
};

}  // namespace phongpd
