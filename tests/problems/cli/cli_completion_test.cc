// SPDX-License-Identifier: GPL-3.0-or-later
// What shells offer, by those shells themselves, beside what --help says.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Names = std::set<std::string>;

class CliCompletion : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    for (const std::string& command : CommandsIn("")) {
      paths_.push_back(command);
      for (const std::string& below : CommandsIn(command)) {
        paths_.push_back(command + ' ' + below);
      }
    }
    ASSERT_GE(paths_.size(), 14U);
  }

  std::string Help(const std::string& path) const {
    return Run(path + " --help").out;
  }

  // The names under "Subcommands:" of that command's --help.
  std::vector<std::string> CommandsIn(const std::string& path) const {
    std::vector<std::string> commands;
    bool is_list = false;
    for (const std::string& line : Split(Help(path), '\n')) {
      if (is_list && line.compare(0, 2, "  ") != 0) is_list = false;
      if (is_list && line[2] != ' ') {
        commands.push_back(line.substr(2, line.find(' ', 2) - 2));
      }
      if (line == "Subcommands:") is_list = true;
    }
    return commands;
  }

  // Its long flags, wherever --help begins a line with them.
  Names FlagsIn(const std::string& path) const {
    Names flags;
    const std::regex flag("(--[a-z-]+)");
    for (const std::string& line : Split(Help(path), '\n')) {
      if (line.compare(0, 3, "  -") != 0) continue;
      // "-h,--help   ..." and "--verify,--no-verify{false} ..."
      const std::string names = line.substr(2, line.find(' ', 2) - 2);
      for (std::sregex_iterator i(names.begin(), names.end(), flag), end;
           i != end; ++i) {
        flags.insert((*i)[1]);
      }
    }
    return flags;
  }

  static bool HasProgram(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) ==
           0;
  }

  // What a shell's script prints: after each "== LINE" what is offered there.
  std::map<std::string, Names> Offers(const std::string& shell,
                                      const std::string& script) const {
    WriteText("script", script);
    const int status =
        std::system(("cd '" + Output("") + "' && PATH='" + ProgramFolder() +
                     "':$PATH " + shell + " >../offers 2>../offers_err")
                        .c_str());
    EXPECT_EQ(status, 0) << Content(folder_ / "offers_err");
    EXPECT_EQ(Content(folder_ / "offers_err"), "");
    std::map<std::string, Names> offers;
    Names* names = nullptr;
    for (const std::string& line : Split(Content(folder_ / "offers"), '\n')) {
      if (line.compare(0, 3, "== ") == 0) {
        names = &offers[line.substr(3)];
      } else if (names != nullptr && !line.empty()) {
        // fish adds a tab and a description.
        names->insert(line.substr(0, line.find('\t')));
      }
    }
    return offers;
  }

  static std::string ProgramFolder() {
    return std::filesystem::path(PHONGPD_PROGRAM).parent_path().string();
  }

  // Bash, with the words as it splits them.
  std::map<std::string, Names> Bash(
      const std::vector<std::string>& lines) const {
    std::string script = "source <(phongpd completion bash)\n";
    for (const std::string& line : lines) {
      script += "COMP_WORDS=(phongpd " + line + ")\n";
      // An empty last word is one.
      if (line.empty() || line.back() == ' ') script += "COMP_WORDS+=('')\n";
      script +=
          "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_phongpd\necho '== " + line +
          "'\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
    }
    return Offers("bash ../script", script);
  }

  std::map<std::string, Names> Fish(
      const std::vector<std::string>& lines) const {
    std::string script = "phongpd completion fish | source\n";
    for (const std::string& line : lines) {
      script += "echo '== " + line + "'\ncomplete -C 'phongpd " + line + "'\n";
    }
    return Offers("fish --no-config ../script", script);
  }

  std::map<std::string, Names> Zsh(
      const std::vector<std::string>& lines) const {
    const std::string folder = File("zsh");
    std::filesystem::create_directory(folder);
    std::ofstream(folder + "/_phongpd") << Run("completion zsh").out;
    std::string command = "zsh -f '" PHONGPD_COMPLETE_ZSH "' '" + folder + "'";
    for (const std::string& line : lines) command += " 'phongpd " + line + "'";
    std::map<std::string, Names> offers;
    for (auto& [line, names] : Offers(command, "")) {
      offers[line.substr(std::string("phongpd ").size())] = names;
    }
    return offers;
  }

  // Every command after nothing, every flag after "--" of every command.
  template <typename Shell>
  void ExpectAllOffered(const Shell& shell) {
    std::vector<std::string> lines = {"", "scenes "};
    for (const std::string& path : paths_) lines.push_back(path + " --");
    const std::map<std::string, Names> offers = shell(lines);
    ASSERT_EQ(offers.size(), lines.size());
    for (const std::string& group : {std::string(), std::string("scenes")}) {
      const std::vector<std::string> commands = CommandsIn(group);
      const Names& offered = offers.at(group.empty() ? "" : group + ' ');
      for (const std::string& command : commands) {
        EXPECT_EQ(offered.count(command), 1U) << command;
      }
    }
    for (const std::string& path : paths_) {
      Names long_ones;
      for (std::string name : offers.at(path + " --")) {
        if (name.back() == '=') name.pop_back();  // zsh's --flag=
        if (name.compare(0, 2, "--") == 0) long_ones.insert(name);
      }
      EXPECT_EQ(long_ones, FlagsIn(path)) << path;
    }
  }

  // Names of scenes, choices of a flag, also of one that is joined by '='.
  template <typename Shell>
  void ExpectValuesOffered(const Shell& shell, const std::string& joined) {
    Names families;
    for (const std::string& line : Split(Run("scenes list").out, '\n')) {
      const std::size_t colon = line.find(':');
      if (line[0] != ' ' && colon != std::string::npos &&
          line.find(' ') > colon) {
        families.insert(line.substr(0, colon));
      }
    }
    ASSERT_GE(families.size(), 25U);
    const std::vector<std::string> lines = {"plan x --model ", "optimize ",
                                            "scenes write ", joined};
    const std::map<std::string, Names> offers = shell(lines);
    for (const char* model : {"auto", "window", "full"}) {
      EXPECT_EQ(offers.at("plan x --model ").count(model), 1U) << model;
    }
    for (const std::string& family : families) {
      EXPECT_EQ(offers.at("optimize ").count(family), 1U) << family;
      EXPECT_EQ(offers.at("scenes write ").count(family), 1U) << family;
    }
    bool has_euclidean = false;
    for (const std::string& name : offers.at(joined)) {
      has_euclidean |= name.find("euclidean") != std::string::npos;
      EXPECT_EQ(name.find("phong"), std::string::npos) << name;
    }
    EXPECT_TRUE(has_euclidean);
  }

  // Names of files, also behind a flag and '='.
  template <typename Shell>
  void ExpectFilesOffered(const Shell& shell) {
    std::ofstream(Output("some_mesh.off")) << "OFF\n";
    const auto offers =
        shell(std::vector<std::string>{"depth some_", "plan --output=some_"});
    ASSERT_EQ(offers.size(), 2U);
    for (const auto& [line, names] : offers) {
      bool has_file = false;
      for (const std::string& name : names) {
        has_file |= name.find("some_mesh.off") != std::string::npos;
      }
      EXPECT_TRUE(has_file) << line;
    }
  }

  std::vector<std::string> paths_;
};

TEST_F(CliCompletion, BashOffersEveryCommandAndFlag) {
  ExpectAllOffered([this](const auto& lines) { return Bash(lines); });
}

TEST_F(CliCompletion, BashOffersValues) {
  ExpectValuesOffered([this](const auto& lines) { return Bash(lines); },
                      "query --metric = eu");
}

TEST_F(CliCompletion, BashLeavesFilesAndWhatFollowsTwoDashesToReadline) {
  const auto offers =
      Bash({"depth ", "depth a.off --output ", "reproduce -- plan --"});
  for (const auto& [line, names] : offers) {
    EXPECT_TRUE(names.empty()) << line << *names.begin();
  }
}

TEST_F(CliCompletion, FishOffersEveryCommandAndFlag) {
  if (!HasProgram("fish")) GTEST_SKIP() << "fish is not installed";
  ExpectAllOffered([this](const auto& lines) { return Fish(lines); });
}

TEST_F(CliCompletion, FishOffersValues) {
  if (!HasProgram("fish")) GTEST_SKIP() << "fish is not installed";
  ExpectValuesOffered([this](const auto& lines) { return Fish(lines); },
                      "query --metric=eu");
}

TEST_F(CliCompletion, FishOffersFiles) {
  if (!HasProgram("fish")) GTEST_SKIP() << "fish is not installed";
  ExpectFilesOffered([this](const auto& lines) { return Fish(lines); });
}

TEST_F(CliCompletion, ZshOffersEveryCommandAndFlag) {
  if (!HasProgram("zsh")) GTEST_SKIP() << "zsh is not installed";
  ExpectAllOffered([this](const auto& lines) { return Zsh(lines); });
}

TEST_F(CliCompletion, ZshOffersValues) {
  if (!HasProgram("zsh")) GTEST_SKIP() << "zsh is not installed";
  ExpectValuesOffered([this](const auto& lines) { return Zsh(lines); },
                      "query --metric=eu");
}

TEST_F(CliCompletion, ZshOffersFiles) {
  if (!HasProgram("zsh")) GTEST_SKIP() << "zsh is not installed";
  ExpectFilesOffered([this](const auto& lines) { return Zsh(lines); });
}

TEST_F(CliCompletion, OtherShellsAreRefused) {
  ExpectRefused("completion tcsh", {"shell", "tcsh", "bash", "zsh", "fish"});
  ExpectRefused("completion", {"shell", "expected", "none"});
}

}  // namespace
}  // namespace phongpd
