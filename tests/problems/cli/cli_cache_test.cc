// SPDX-License-Identifier: GPL-3.0-or-later
// The program's cache of contact spaces.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

const char kBuild[] =
    "contact-space --robot ../cone.off --obstacle ../box.off ";

class CliCache : public Cli {
 protected:
  // The report of a build, which must succeed.
  nlohmann::json Report(const std::string& flags) const {
    const Outcome outcome =
        Run(kBuild + ("--output c.off --report r.json " + flags));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(Content(Output("r.json")));
  }
  std::size_t CachedFiles() const {
    const std::filesystem::path cache = folder_ / "cache";
    if (!std::filesystem::exists(cache)) return 0;
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(cache), {}));
  }
};

TEST_F(CliCache, TheSecondBuildReadsTheFirst) {
  const nlohmann::json first = Report("");
  const std::string mesh = Content(Output("c.off"));
  EXPECT_EQ(first["from_cache"], false);
  EXPECT_EQ(CachedFiles(), 1U);
  nlohmann::json second = Report("");
  EXPECT_EQ(second["from_cache"], true);
  EXPECT_EQ(Content(Output("c.off")), mesh);
  second["from_cache"] = false;
  // Judged when it was built.
  EXPECT_EQ(second["verification"], nullptr);
  second["verification"] = first["verification"];
  EXPECT_EQ(second, first);
  EXPECT_NE(Run(kBuild + std::string("--output d.off")).out.find("cache"),
            std::string::npos);

  // motion needs the same contact space.
  const std::string motion =
      "motion --robot ../cone.off --obstacle ../box.off --from -3 0 0.1 "
      "--to 3 0 0 --frames 20 --output ";
  ASSERT_EQ(Run(motion + "cached.csv").code, 0);
  EXPECT_EQ(CachedFiles(), 1U);
  ASSERT_EQ(Run(motion + "anew.csv --no-cache").code, 0);
  EXPECT_EQ(Content(Output("cached.csv")), Content(Output("anew.csv")));
}

TEST_F(CliCache, NoCacheNeitherReadsNorWrites) {
  EXPECT_EQ(Report("--no-cache")["from_cache"], false);
  EXPECT_EQ(CachedFiles(), 0U);
  Report("");
  EXPECT_EQ(Report("--no-cache")["from_cache"], false);
}

TEST_F(CliCache, ADamagedFileIsAWarning) {
  Report("");
  const auto file =
      std::filesystem::directory_iterator(folder_ / "cache")->path();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const Outcome outcome = Run(kBuild + std::string("--output c.off"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("damaged"), std::string::npos) << outcome.err;
  EXPECT_EQ(Report("")["from_cache"], true);
}

TEST_F(CliCache, ProcessesShareIt) {
  std::string command = "cd '" + Output("") + "' && export " +
                        "PHONGPD_CACHE_DIR='" + File("cache") + "'; ";
  for (int i = 0; i < 6; ++i) {
    command += "'" PHONGPD_PROGRAM "' " + std::string(kBuild) + "--output p" +
               std::to_string(i) + ".off >/dev/null & ";
  }
  ASSERT_EQ(std::system((command + "wait").c_str()), 0);
  EXPECT_EQ(CachedFiles(), 1U);
  Report("--no-cache");
  const std::string mesh = Content(Output("c.off"));
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(Content(Output("p" + std::to_string(i) + ".off")), mesh);
  }
  EXPECT_EQ(Report("")["from_cache"], true);
}

}  // namespace
}  // namespace phongpd
