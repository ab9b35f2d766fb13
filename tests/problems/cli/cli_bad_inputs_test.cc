// SPDX-License-Identifier: GPL-3.0-or-later
// Each mistake of bad_inputs.txt is answered with the sentence that stands
// there: one line, exit code 2, and nothing is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

// One line of the table and what belongs to it.
struct Mistake {
  std::string line;      // "$ depth", "S start []", "J {"
  std::string sentence;  // "..." stands for any text
};
struct Group {
  std::string name;
  std::vector<Mistake> mistakes;
};
struct Table {
  std::vector<std::string> files;  // the lines about them
  std::vector<Group> groups;
};

Table ReadTable() {
  std::ifstream stream(PHONGPD_BAD_INPUTS);
  Table table;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      table.groups.push_back({line.substr(1, line.size() - 2), {}});
    } else if (table.groups.empty()) {
      table.files.push_back(line);
    } else if (line.compare(0, 2, "> ") == 0) {
      table.groups.back().mistakes.back().sentence = line.substr(2);
    } else {
      table.groups.back().mistakes.push_back({line, ""});
    }
  }
  return table;
}

const Table& TheTable() {
  static const Table table = ReadTable();
  return table;
}

std::vector<std::string> GroupNames() {
  std::vector<std::string> names;
  for (const Group& group : TheTable().groups) names.push_back(group.name);
  return names;
}

// Is `text` the sentence, with any text where that has "..."?
bool Says(const std::string& text, const std::string& sentence) {
  const std::string gap = "...";
  std::size_t at = 0, from = 0;
  while (true) {
    const std::size_t end = sentence.find(gap, from);
    const std::string part = sentence.substr(from, end - from);
    if (end == std::string::npos) {  // the last part ends the text
      return text.size() >= at + part.size() &&
             (from > 0 || text.size() == part.size()) &&
             text.compare(text.size() - part.size(), part.size(), part) == 0;
    }
    const std::size_t found = text.find(part, at);
    if (found == std::string::npos || (from == 0 && found != 0)) return false;
    at = found + part.size();
    from = end + gap.size();
  }
}

class CliBadInputs : public Cli,
                     public testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    Cli::SetUp();
    std::filesystem::path file;
    for (const std::string& line : TheTable().files) {
      if (line.compare(0, 2, "| ") == 0) {
        std::ofstream(file, std::ios::app) << line.substr(2) << '\n';
        continue;
      }
      const std::vector<std::string> words = Split(line, ' ');
      ASSERT_GE(words.size(), 2U) << line;
      file = File(words[1]);
      MakeFile(words, file);
    }
  }

  void MakeFile(const std::vector<std::string>& words,
                const std::filesystem::path& file) const {
    const std::string& kind = words[0];
    std::string bytes;
    if (kind == "folder") {
      std::filesystem::create_directory(file);
      return;
    }
    if (kind == "cut") {
      bytes = Content(File(words.at(2))).substr(0, std::stoul(words.at(3)));
    } else if (kind == "noise") {
      bytes.resize(std::stoul(words.at(2)));
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<char>((i * 37 + i * i) % 256);
      }
    } else {
      ASSERT_EQ(kind, "file") << file;
    }
    std::ofstream(file, std::ios::binary) << bytes;
  }

  // A good scene but for that key.
  static std::string SceneWith(const std::string& key,
                               const std::string& value) {
    std::vector<std::pair<std::string, std::string>> keys = {
        {"robot", R"({"shape": {"type": "box", "size": [0.2, 0.2, 0.2]}})"},
        {"obstacles", R"([{"id": "wall", "shape": {"type": "box",
                           "size": [0.2, 1, 1]}}])"},
        {"bounds", R"({"min": [-2, -2, -2], "max": [2, 2, 2]})"},
        {"start", "[-1.5, 0, 0]"},
        {"goal", "[1.5, 0, 0]"}};
    const auto same =
        std::find_if(keys.begin(), keys.end(),
                     [&](const auto& k) { return k.first == key; });
    if (same == keys.end()) {
      keys.emplace_back(key, value);
    } else {
      same->second = value;
    }
    std::string text;
    for (const auto& [name, json] : keys) {
      text += (text.empty() ? "{\"" : ", \"") + name + "\": " + json;
    }
    return text + "}\n";
  }

  // The arguments of a mistake, whose scene is written.
  std::string ArgumentsOf(const std::string& line) const {
    const std::string rest = line.size() > 2 ? line.substr(2) : "";
    if (line[0] == '$') return rest;
    const std::size_t space = rest.find(' ');
    WriteText("scene.json", line[0] == 'J' ? rest + '\n'
                                           : SceneWith(rest.substr(0, space),
                                                       rest.substr(space + 1)));
    return "optimize ../scene.json";
  }

  void ExpectAnswer(const Mistake& mistake) const {
    SCOPED_TRACE(mistake.line);
    const Outcome outcome = Run(ArgumentsOf(mistake.line));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    const std::string text = outcome.err.substr(
        0, outcome.err.size() - (outcome.err.empty() ? 0 : 1));
    EXPECT_TRUE(Says(text, "phongpd: " + mistake.sentence))
        << text << "\n  is not: " << mistake.sentence;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "run"));
  }
};

TEST_P(CliBadInputs, AreAnsweredInOneSentence) {
  for (const Group& group : TheTable().groups) {
    if (group.name != GetParam()) continue;
    EXPECT_FALSE(group.mistakes.empty());
    for (const Mistake& mistake : group.mistakes) ExpectAnswer(mistake);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, CliBadInputs, testing::ValuesIn(GroupNames()),
                         [](const auto& one) { return one.param; });

TEST(BadInputs, AreManyAndEachSaysMoreThanThatItIsWrong) {
  std::size_t count = 0;
  for (const Group& group : TheTable().groups) {
    for (const Mistake& mistake : group.mistakes) {
      ++count;
      // Not of "..." alone, and every one says what was found.
      EXPECT_GE(mistake.sentence.size(), 20U) << mistake.line;
      EXPECT_TRUE(mistake.sentence.find("found") != std::string::npos ||
                  mistake.sentence.find("expected") != std::string::npos ||
                  mistake.sentence.find("cannot be written") !=
                      std::string::npos ||
                  mistake.sentence.find("needs") != std::string::npos ||
                  mistake.sentence.find("no parameter") != std::string::npos ||
                  mistake.sentence.find("must be") != std::string::npos)
          << mistake.sentence;
    }
  }
  EXPECT_GE(count, 300U);
}

TEST(BadInputs, SentencesAreComparedWhole) {
  EXPECT_TRUE(Says("a: b", "a: b"));
  EXPECT_FALSE(Says("a: b; did you mean c?", "a: b"));
  EXPECT_FALSE(Says("x a: b", "a: b"));
  EXPECT_TRUE(Says("one of x, y; found z", "one of ...; found z"));
  EXPECT_FALSE(Says("one of x, y; found z?", "one of ...; found z"));
  EXPECT_FALSE(Says("1 one of x; found z", "one of ...; found z"));
  EXPECT_TRUE(Says("any", "..."));
}

}  // namespace
}  // namespace phongpd
