// SPDX-License-Identifier: GPL-3.0-or-later
// `phongpd man`, judged by man and groff.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

class CliMan : public Cli {
 protected:
  // What a shell command that reads the page as its input prints.
  Outcome Formatted(const std::string& command) const {
    const Outcome page = Run("man");
    EXPECT_EQ(page.code, 0) << page.err;
    WriteText("page", page.out);
    Outcome outcome;
    outcome.code = std::system(("LC_ALL=C.UTF-8 MANWIDTH=80 " + command +
                                " <'" + File("page") + "' >'" + File("text") +
                                "' 2>'" + File("warnings") + "'")
                                   .c_str());
    outcome.out = Content(folder_ / "text");
    outcome.err = Content(folder_ / "warnings");
    return outcome;
  }

  static bool HasProgram(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) ==
           0;
  }
};

TEST_F(CliMan, HoldsEveryCommandAndFlagInPlainAscii) {
  const std::string page = Run("man").out;
  for (const char c : page) {
    ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
  }
  // "\-" is a hyphen that stays one.
  const std::string text = std::regex_replace(page, std::regex("\\\\-"), "-");
  const std::regex flag("--[a-z][a-z-]+");
  int flags = 0;
  for (const std::string path :
       {"depth", "plan", "optimize", "scenes write", "view", "compare"}) {
    const std::size_t begin = text.find(".SS phongpd " + path + '\n');
    ASSERT_NE(begin, std::string::npos) << path;
    const std::string section =
        text.substr(begin, text.find("\n.SS", begin) - begin);
    for (const std::string& line : Split(Run(path + " --help").out, '\n')) {
      if (line.compare(0, 3, "  -") != 0) continue;
      const std::string names = line.substr(2, line.find(' ', 2) - 2);
      for (std::sregex_iterator i(names.begin(), names.end(), flag), end;
           i != end; ++i) {
        ++flags;
        EXPECT_NE(section.find("\\fB" + i->str() + "\\fR"), std::string::npos)
            << path << ' ' << i->str();
      }
    }
  }
  EXPECT_GT(flags, 60);
}

TEST_F(CliMan, ManFormatsItWithoutAWarning) {
  if (!HasProgram("man")) GTEST_SKIP() << "man-db is not installed";
  const Outcome outcome = Formatted("man --warnings --local-file -");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("NAME"), std::string::npos);
}

TEST_F(CliMan, GroffFormatsItWithoutAWarning) {
  if (!HasProgram("groff")) GTEST_SKIP() << "groff is not installed";
  const Outcome outcome =
      Formatted("groff -ww -man -Tutf8 -P-c -P-b -P-u -P-o");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  // As --help says it, quotes and dashes included.
  for (const char* const words :
       {"phongpd depth", "--max-radius", "$PHONGPD_CACHE_DIR",
        "the robot's way as an animation"}) {
    const std::regex spaces("[ \n]+");
    EXPECT_NE(std::regex_replace(outcome.out, spaces, " ").find(words),
              std::string::npos)
        << words;
  }
}

}  // namespace
}  // namespace phongpd
