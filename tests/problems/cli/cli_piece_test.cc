// SPDX-License-Identifier: GPL-3.0-or-later
// `phongpd contact-space --piece` and `phongpd join` as a user calls them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_process.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

using CliPieces = CliProcess;

std::string PieceArguments(int i, int n, const std::string& output) {
  return "contact-space --robot ../star.off --obstacle ../torus.off --piece " +
         std::to_string(i) + '/' + std::to_string(n) + " --output " + output;
}

TEST_F(CliPieces, FourProcessesJoinedAreOneProcess) {
  WriteMesh(MakeStar(0.5, 1.2), File("star.off"));
  WriteMesh(MakeTorus(2, 0.6, 24, 12), File("torus.off"));
  std::vector<pid_t> processes;
  for (int i = 0; i < 4; ++i) {
    processes.push_back(
        Start(PieceArguments(i, 4, "part" + std::to_string(i))));
  }
  for (const pid_t process : processes) EXPECT_EQ(Wait(process), 0);
  const Outcome joined =
      Run("join part3 part0 part2 part1 --output joined.off --report r.json");
  ASSERT_EQ(joined.code, 0) << joined.err;
  EXPECT_FALSE(Content(Output("r.json")).empty());
  ASSERT_EQ(Run(PieceArguments(0, 1, "all")).code, 0);
  ASSERT_EQ(Run("join all --output all.off").code, 0);
  ASSERT_EQ(Run("contact-space --robot ../star.off --obstacle ../torus.off "
                "--no-cache --output whole.off")
                .code,
            0);
  const std::string whole = Content(Output("whole.off"));
  EXPECT_GT(whole.size(), 10000U);
  EXPECT_EQ(Content(Output("joined.off")), whole);
  EXPECT_EQ(Content(Output("all.off")), whole);
  // And everything else but what it took.
  ASSERT_EQ(Run("join part0 part1 part2 part3 --output 4.pcs").code, 0);
  ASSERT_EQ(Run("join all --output 1.pcs").code, 0);
  EXPECT_EQ(Content(Output("4.pcs")), Content(Output("1.pcs")));
}

TEST_F(CliPieces, PiecesThatAreNotOneBuildAreNamed) {
  WriteMesh(MakeStar(0.5, 1.2), File("star.off"));
  WriteMesh(MakeBox({-1, -1, -1}, {1, 1, 1}), File("torus.off"));
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(Run(PieceArguments(i, 3, "../p" + std::to_string(i))).code, 0);
  }
  WriteMesh(MakeBox({-1, -1, -1}, {1, 1, 2}), File("torus.off"));
  ASSERT_EQ(Run(PieceArguments(1, 3, "../other")).code, 0);
  const std::string bytes = Content(File("p2"));
  std::ofstream(File("cut"), std::ios::binary)
      << bytes.substr(0, bytes.size() / 2);
  ExpectRefused("join ../p0 ../p2 --output c.off",
                {"expected all 3 pieces, found 2", "without 1/3"});
  ExpectRefused("join ../p0 ../p1 ../p2 ../p1 --output c.off",
                {"../p1: expected every piece once"});
  ExpectRefused("join ../p0 ../other ../p2 --output c.off",
                {"../other: expected a piece of the build"});
  ExpectRefused("join ../p0 ../p1 ../cut --output c.off",
                {"../cut: expected", "it was cut off"});
  ExpectRefused("join ../p0 ../p1 ../none --output c.off", {"../none"});
  ExpectRefused("join ../p0 ../p1 ../box.off --output c.off",
                {"../box.off: expected a piece"});
  ExpectRefused(PieceArguments(3, 3, "c"), {"--piece: expected i/n"});
  ExpectRefused(PieceArguments(0, 3, "c") + " --json",
                {"--piece: expected --output and neither"});
  ExpectRefused(
      "contact-space --robot ../box.off --obstacle ../box.off --piece 0/2",
      {"--piece: expected --output"});
  EXPECT_TRUE(fs::is_empty(Output("")));
}

}  // namespace
}  // namespace phongpd
