// SPDX-License-Identifier: GPL-3.0-or-later
// A peg that fills its hole exactly, and a lid on it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Json = nlohmann::json;

class CliRemove : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    WriteMesh(MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}), File("peg.off"));
    WriteMesh(MakePlateWithHole(4, 2, 1), File("plate.off"));
    WriteMesh(MakeBox({-2, -2, 1}, {2, 2, 1.5}), File("lid.off"));
    WriteMesh(MakeVessel(4, 3, 0), File("shell.off"));
    WriteMesh(MakeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), File("core.off"));
  }
};

TEST_F(CliRemove, SaysWhatItGrantedAnExactFit) {
  const std::string peg = "remove ../peg.off ../plate.off ../lid.off";
  const Outcome tight = Run(peg);
  EXPECT_EQ(tight.code, 1);
  EXPECT_NE(tight.out.find("touching"), std::string::npos) << tight.out;
  const Outcome out = Run(peg + " --tolerance 0.001 --output way.csv");
  EXPECT_EQ(out.code, 0) << out.err;
  EXPECT_NE(out.out.find("drawn in by 0.001 (vertices by at most 0.001732)"),
            std::string::npos)
      << out.out;
  // Down, for the lid is above it.
  const std::string way = Content(Output("way.csv"));
  EXPECT_EQ(way.rfind("step,part,x,y,z\n1,../peg.off,0,0,0\n", 0), 0U) << way;
  EXPECT_NE(way.find(",-2."), std::string::npos) << way;
}

TEST_F(CliRemove, TakesAllApartAndProvesWhatIsHeld) {
  const Outcome apart =
      Run("remove --all ../peg.off ../plate.off ../lid.off --tolerance 0.001 "
          "--json");
  EXPECT_EQ(apart.code, 0) << apart.err;
  const Json row = Json::parse(apart.out);
  EXPECT_EQ(row["status"], "out");
  ASSERT_EQ(row["steps"].size(), 2U);
  EXPECT_EQ(row["steps"][0]["part"], "../peg.off");
  EXPECT_EQ(row["steps"][0]["granted"]["faces"], 0.001);
  const Outcome held = Run("remove ../core.off ../shell.off");
  EXPECT_EQ(held.code, 1);
  EXPECT_EQ(held.out,
            "../core.off: held: no translation takes it out, proved\n");
}

TEST_F(CliRemove, WritesAPageOfOneWay) {
  EXPECT_EQ(
      Run("remove ../peg.off ../lid.off --tolerance 0.01 --html p.html").code,
      0);
  EXPECT_NE(Content(Output("p.html")).find("way out"), std::string::npos);
}

// A key whose bit lies across the slot below its plate: a quarter turn.
TEST_F(CliRemove, TurnsABayonetOutWhereThatIsAskedFor) {
  WriteMesh(
      MakeCells({-2, -0.6, -0.2, 0.2, 0.6, 2}, {-2, -0.2, -0.15, 0.15, 0.2, 2},
                {0, 0.5}, {{"#####", "##.##", "#...#", "##.##", "#####"}}),
      File("socket.off"));
  WriteMesh(MakeCells({-0.5, -0.12, -0.1, 0.1, 0.12, 0.5},
                      {-0.5, -0.1, 0.1, 0.5}, {-0.5, -0.25, 0.75, 1},
                      {{".###.", ".###.", ".###."},
                       {".....", "..#..", "....."},
                       {"#####", "#####", "#####"}}),
            File("key.off"));
  const std::string key = "remove ../key.off ../socket.off";
  ExpectRefused(key + " --time 3", {"--time", "--turns"});
  const Outcome held = Run(key + " --json");
  EXPECT_EQ(held.code, 1);
  const Json stuck = Json::parse(held.out)["stuck"][0];
  EXPECT_EQ(stuck["status"], "infeasible_proved");
  EXPECT_EQ(stuck["needs_turns"], true);
  const Outcome out =
      Run(key + " --turns --time 60 --output way.json --html p.html");
  EXPECT_EQ(out.code, 0) << out.out << out.err;
  EXPECT_NE(out.out.find("../key.off: out, turning, which it has to: "),
            std::string::npos)
      << out.out;
  const Json row = Json::parse(Content(Output("way.json")));
  EXPECT_EQ(row["status"], "out");
  const Json& step = row["steps"][0];
  EXPECT_EQ(step["needs_turns"], true);
  EXPECT_EQ(step["pivot"][2], 0.25);
  ASSERT_GE(step["path"].size(), 2U);
  ASSERT_EQ(step["path"][0].size(), 7U);
  EXPECT_EQ(step["path"][0][3], 1.0);
  EXPECT_NE(Content(Output("p.html")).find("\"turns\":[["), std::string::npos);
  const Outcome csv = Run(key + " --turns --time 60 --output way.csv");
  EXPECT_EQ(csv.code, 0) << csv.err;
  EXPECT_EQ(Content(Output("way.csv"))
                .rfind("step,part,x,y,z,qw,qx,qy,qz,pivot_x,pivot_y,pivot_z\n"
                       "1,../key.off,0,0,0.25,1,0,0,0,0,0,0.25\n",
                       0),
            0U);
  const Outcome none =
      Run("remove ../core.off ../shell.off --turns --time 0.2");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.out.find("no translation takes it out, proved; with turns no "
                          "path was found within 0.2 s, which does not prove"),
            std::string::npos)
      << none.out;
}

TEST_F(CliRemove, RefusesBadInput) {
  ExpectRefused("remove ../peg.off", {"../peg.off", "other parts"});
  ExpectRefused("remove ../peg.off ../peg.off", {"../peg.off", "once"});
  ExpectRefused("remove ../peg.off ../lid.off --tolerance 0.7",
                {"peg.off", "shrunk by 0.7", "smaller tolerance"});
  ExpectRefused("remove ../peg.off ../lid.off --tolerance nan",
                {"--tolerance"});
  ExpectRefused("remove --all ../peg.off ../lid.off --html p.html",
                {"--html", "--all"});
}

}  // namespace
}  // namespace phongpd
