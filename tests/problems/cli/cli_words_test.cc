// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of every command is asked of every command: the list of them is
// the program's own, and so are their flags.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

class CliWords : public CliScenes {
 protected:
  // The paths of all commands: "plan", "scenes list", ...
  std::vector<std::string> Commands() const {
    std::vector<std::string> commands;
    for (const std::string& name : Below("")) {
      const std::vector<std::string> below = Below(name);
      if (below.empty()) commands.push_back(name);
      for (const std::string& more : below) {
        commands.push_back(name + " " + more);
      }
    }
    return commands;
  }

  std::string Help(const std::string& command) const {
    const Outcome help = Run(command + " --help");
    EXPECT_EQ(help.code, 0) << command;
    return help.out;
  }

  // "  --planner TEXT:{a,b} ...": the flag and what stands behind it.
  struct Flag {
    std::string name;
    std::string value;  // the rest of its line
  };
  static std::vector<Flag> Flags(const std::string& help) {
    std::vector<Flag> flags;
    static const std::regex pattern("^  (?:-[a-z],)?(--[a-z-]+)[^ ]* *(.*)$");
    for (const std::string& line : Split(help, '\n')) {
      std::smatch match;
      if (!std::regex_match(line, match, pattern)) continue;
      flags.push_back({match[1].str(), match[2].str()});
    }
    return flags;
  }

  // Refused in one short line that has all the words.
  void ExpectLine(const std::string& command,
                  const std::vector<std::string>& words) const {
    const Outcome outcome = Run(command);
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_TRUE(outcome.out.empty()) << command << outcome.out;
    EXPECT_EQ(Split(outcome.err, '\n').size(), 1U) << command << outcome.err;
    EXPECT_FALSE(HasLongNumber(outcome.err)) << command << outcome.err;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos)
          << command << ": no " << word << " in " << outcome.err;
    }
  }

  static bool HasLongNumber(const std::string& text) {
    return std::regex_search(text, std::regex("[0-9]{16}|0{8}|e\\+?30[0-9]"));
  }

 private:
  std::vector<std::string> Below(const std::string& command) const {
    std::vector<std::string> names;
    bool is_list = false;
    static const std::regex pattern("^  ([a-z-]+) .*$");
    for (const std::string& line : Split(Help(command), '\n')) {
      std::smatch match;
      if (line.rfind("Subcommands:", 0) == 0) {
        is_list = true;
      } else if (line.empty()) {
        is_list = false;
      } else if (is_list && std::regex_match(line, match, pattern)) {
        names.push_back(match[1].str());
      }
    }
    return names;
  }
};

TEST_F(CliWords, EveryTimeSaysItsUnit) {
  int times = 0;
  for (const std::string& command : Commands()) {
    for (const Flag& flag : Flags(Help(command))) {
      const std::string kind =
          flag.value.substr(0, flag.value.find_first_of(" =:"));
      // S is a time, and of --seed a seed.
      if (flag.name == "--seed") continue;
      if (kind != "S" && kind != "SECONDS") continue;
      ++times;
      const std::string with = command + " " + flag.name + " ";
      ExpectLine(with + "1parsec", {flag.name, "500ms", "1parsec"});
      ExpectLine(with + "-2s", {flag.name, "500ms", "-2s"});
      for (const std::string good :
           {"3", "3s", "3000ms", "0.05min", "0.001 h"}) {
        const Outcome outcome = Run(with + "'" + good + "' --no-such-flag");
        EXPECT_EQ(outcome.err.find("500ms"), std::string::npos) << outcome.err;
      }
    }
  }
  EXPECT_GT(times, 10);
}

TEST_F(CliWords, EveryHelpHasExamplesThatAreOfItsCommandAndNoEndlessNumber) {
  const std::vector<std::string> commands = Commands();
  EXPECT_GE(commands.size(), 17U);
  for (const std::string& command : commands) {
    const std::string help = Help(command);
    const std::size_t examples = help.find("Examples:\n");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_NE(help.find("\n  phongpd " + command, examples), std::string::npos)
        << command;
    EXPECT_FALSE(HasLongNumber(help)) << command;
    // What they call by flags, they have.
    std::set<std::string> names;
    for (const Flag& flag : Flags(help)) names.insert(flag.name);
    static const std::regex flag(" (--[a-z-]+)");
    for (const std::string& line : Split(help.substr(examples), '\n')) {
      if (line.rfind("  phongpd " + command + " ", 0) != 0) continue;
      // Behind "--" comes another command.
      const std::string own = line.substr(0, line.find(" -- "));
      for (std::sregex_iterator i(own.begin(), own.end(), flag), end; i != end;
           ++i) {
        EXPECT_EQ(names.count((*i)[1].str()), 1U)
            << command << " has no " << (*i)[1].str();
      }
    }
  }
}

TEST_F(CliWords, AnswersOfAllCommandsComeAsJsonToo) {
  // Text for other programs, in their own formats.
  const std::set<std::string> texts = {"completion", "man"};
  for (const std::string& command : Commands()) {
    const bool has_json = Help(command).find("\n  --json") != std::string::npos;
    EXPECT_EQ(has_json, texts.count(command) == 0) << command;
  }
}

TEST_F(CliWords, MistypedNamesAreAnsweredWithTheNearest) {
  std::vector<std::string> first;
  for (const std::string& command : Commands()) {
    // A letter too many, in the command and in each of its flags.
    const std::size_t last = command.size() - 1;
    ExpectLine(
        command.substr(0, last) + "x" + command.substr(last),
        {"did you mean " + command.substr(command.find(' ') == std::string::npos
                                              ? 0
                                              : command.find(' ') + 1)});
    for (const Flag& flag : Flags(Help(command))) {
      if (flag.name == "--help" || flag.name == "--at") continue;
      std::string wrong = flag.name;
      wrong.insert(wrong.size() - 1, "q");
      ExpectLine(command + " " + wrong, {"did you mean " + flag.name});
    }
  }
  ExpectLine("plan u_axs", {"did you mean u_axis?"});
  ExpectLine("scenes write u_axs", {"did you mean u_axis?"});
  ExpectLine("plan tunnel:delt=0.1", {"did you mean delta?"});
  ExpectLine("plan u_axis --planner RRTConnect",
             {"found 'RRTConnect'", "did you mean rrt-connect?"});
  ExpectLine("scenes", {"expected list or write, found nothing"});
}

TEST_F(CliWords, ValuesOfAListAreAnsweredWithTheNearest) {
  int lists = 0;
  static const std::regex choices("^[A-Z ]*:?\\{([^}]*)\\}.*$");
  for (const std::string& command : Commands()) {
    for (const Flag& flag : Flags(Help(command))) {
      std::smatch match;
      if (!std::regex_match(flag.value, match, choices)) continue;
      const std::string name = Split(match[1].str(), ',').back();
      ExpectLine(command + " " + flag.name + " " + name + "x",
                 {flag.name + ": expected one of ", "found '" + name + "x'",
                  "did you mean " + name});
      ++lists;
    }
  }
  EXPECT_GT(lists, 10);
}

// Numbers that are none, and values that are missing.
TEST_F(CliWords, WrongNumbersAndMissingValuesAreToldInWords) {
  ExpectLine("plan u_axis --runs 1e400",
             {"--runs: expected a whole number within range, found 1e400"});
  ExpectLine("depth a b --at 1 2",
             {"--at: expected at least 3 values, found 2"});
  ExpectLine("depth a", {"expected B, found none (see phongpd depth --help)"});
  ExpectLine("optimize u_axis --seed", {"--seed", "found none"});
  for (const std::string& command : Commands()) {
    for (const Flag& flag : Flags(Help(command))) {
      static const std::regex number("^(N|F|S|K|SECONDS|MIB) .*$");
      if (!std::regex_match(flag.value, number)) continue;
      const Outcome outcome = Run(command + " " + flag.name + " 1e999x");
      EXPECT_EQ(outcome.code, 2) << command << ' ' << flag.name;
      EXPECT_FALSE(HasLongNumber(outcome.err)) << outcome.err;
    }
  }
}

TEST_F(CliWords, PointsAreWrittenWithBlanksOrCommas) {
  const std::string depth = "depth ../cone.off ../box.off --json --at ";
  // All of the answer but the time it took.
  const auto answer = [&](const std::string& point) {
    static const std::regex seconds("\"seconds\":[^}]*");
    return std::regex_replace(Run(depth + point).out, seconds, "");
  };
  EXPECT_NE(answer("1,0.5,-2").find("\"penetrating\""), std::string::npos);
  EXPECT_EQ(answer("1,0.5,-2"), answer("1 0.5 -2"));
  EXPECT_EQ(answer("-1,0.5,2"), answer("-1 0.5 2"));
  const std::string motion =
      "motion --robot ../cone.off --obstacle ../box.off --frames 3 ";
  EXPECT_EQ(Run(motion + "--from -3,0,0 --to 3,0,0").out,
            Run(motion + "--from -3 0 0 --to 3 0 0").out);
  ExpectLine("depth a b --at 1,2",
             {"--at: expected at least 3 values, found 2"});
  ExpectLine("depth ../cone.off ../box.off --at 1,2,x", {"--at", "'x'"});
}

TEST_F(CliWords, RowsAreNotWrittenUnderTheNameOfATable) {
  for (const char* name : {"r.csv", "r.CSV", "r.tsv", "r.parquet"}) {
    ExpectLine(std::string("plan u_axis --output ") + name,
               {"--output", "one line of JSON", ".jsonl", name, "lines=True"});
    // What has a table over time is a motion.
    ExpectLine(std::string("optimize u_axis --output ") + name,
               {"--output", ".jsonl", name});
  }
  ExpectLine("optimize u_axis --output r.csv", {"--limits V,A,J"});
}

// Wherever a picture or a page can be asked for.
TEST_F(CliWords, OutputsOfAnotherKindAreRefused) {
  const std::string pair = " --robot ../cone.off --obstacle ../box.off ";
  const std::string motion =
      "motion" + pair + "--from -3 0 0 --to 3 0 0 --frames 3 ";
  for (const std::string& command :
       {motion, std::string("optimize u_axis "), std::string("plan u_axis ")}) {
    ExpectLine(command + "--svg p.png", {"--svg", "ends in .svg", "p.png"});
    ExpectLine(command + "--html p.svg", {"--html", ".html", "p.svg"});
  }
  WriteText("points.csv", "x,y,z\n0.3,0,0.1\n");
  for (const std::string& command :
       {motion,
        std::string("query --contact-space ../box.off --points ../points.csv "),
        std::string("depth ../cone.off ../box.off "),
        std::string("optimize u_axis "), std::string("plan u_axis ")}) {
    for (const char* name : {"r.png", "r.HTML", "r.off", "r.svg", "r.pcs"}) {
      ExpectLine(command + "--output " + name,
                 {"--output", "table", ".csv", name});
    }
  }
  // Any other name, or none that is a file's.
  for (const char* name : {"rows", "r.txt", "r.csv", "r.png.jsonl", "-"}) {
    const std::string query =
        "query --contact-space ../box.off --points ../points.csv --output ";
    EXPECT_EQ(Run(query + name).code, 0) << name;
  }
  std::filesystem::remove_all(folder_ / "run");
  std::filesystem::create_directory(folder_ / "run");
  ExpectLine("reproduce --output r.png -- check ../box.off",
             {"--output", ".json", "r.png"});
  ExpectLine("scenes write u_axis --output r.png", {"--output", "r.png"});
  ExpectLine("view ../box.off --html p.png", {"--html", "p.png"});
  ExpectLine("view ../box.off --glb p.gltf", {"--glb", "p.gltf"});
  ExpectLine("view ../box.off --png p.svg", {"--png", "p.svg"});
  ExpectLine("contact-space" + pair + "--output c.png", {"c.png"});
  ExpectLine("contact-space" + pair + "--output c.off --report r.csv",
             {"--report", "r.csv"});
  ExpectLine("minkowski ../box.off ../cone.off --output c.html", {"c.html"});
  ExpectLine("check ../box.off --defects d.html", {"d.html"});
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "run"));
}

// Every flag that is a length, and a command in which it is one.  Refused is
// what none of them knows, and what is accepted is beside it.
TEST_F(CliWords, EveryLengthTakesAWordForItsUnit) {
  WriteText("p.csv", "x,y,z\n0.3,0,0\n0.4,0,0\n");
  WriteMesh(MakeBox({3, 3, 3}, {4, 4, 4}), File("far.off"));
  const std::map<std::string, std::string> calls = {
      {"depth --max-radius", "depth ../box.off ../cone.off"},
      {"depth --smoothing-length", "depth ../box.off ../cone.off"},
      {"motion --smoothing-length",
       "motion --robot ../box.off --obstacle ../cone.off --from 3 0 0 --to 4 0 "
       "0 "
       "--frames 2"},
      {"optimize --margin", "optimize u_axis"},
      {"optimize --smoothing-length", "optimize u_axis"},
      {"plan --clearance", "plan tunnel"},
      {"query --smoothing-length",
       "query --contact-space ../box.off --points ../p.csv"},
      {"remove --tolerance", "remove ../box.off ../far.off"},
      {"retime --margin", "retime ../p.csv --scene u_axis --limits 1,9,99"},
  };
  std::set<std::string> found;
  for (const std::string& command : Commands()) {
    for (const Flag& flag : Flags(Help(command))) {
      if (flag.value.rfind("LENGTH", 0) != 0) continue;
      found.insert(command + " " + flag.name);
    }
  }
  std::set<std::string> known;
  for (const auto& [name, call] : calls) {
    known.insert(name);
    const std::string flag = name.substr(name.find(' ') + 1);
    const std::string with = call + " " + flag + " ";
    ExpectLine(with + "1furlong", {flag, "length", "1furlong", "unit"});
    // Those have answers of their own to wait for, or a path to be free.
    if (name.rfind("motion", 0) == 0 || name.rfind("retime", 0) == 0) continue;
    const Outcome taken = Run(with + "0.05unit --json");
    EXPECT_LE(taken.code, 1) << with << taken.err;
  }
  EXPECT_EQ(found, known);
  // Where the meshes' unit has a name.
  for (const char* flag : {"depth ../box.off ../cone.off --max-radius ",
                           "remove ../box.off ../far.off --tolerance "}) {
    EXPECT_LE(Run(std::string(flag) + "1e-3mm --unit mm").code, 1) << flag;
    ExpectLine(std::string(flag) + "1mm", {"'1mm'", "--unit mm"});
    ExpectLine(std::string(flag) + "1in --unit mm", {"'1in'", "that is mm"});
    ExpectLine(std::string(flag) + "1mm --unit yard", {"--unit"});
  }
}

}  // namespace
}  // namespace phongpd
