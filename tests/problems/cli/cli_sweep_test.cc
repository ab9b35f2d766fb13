// SPDX-License-Identifier: GPL-3.0-or-later
// A cube of side 2 that turns a quarter: its corners get to the root of 2.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/mesh/mesh_io.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Json = nlohmann::json;

class CliSweep : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    WriteWall("far.off", 1e-5);
    WriteWall("near.off", -1e-5);
    WriteWall("touching.off", 0.0);
    TriangleMesh open = MakeBox({1.3, -5, -4}, {2.3, 4, 3});
    open.triangles.pop_back();
    WriteMesh(open, File("open.off"));
  }

  // In front of the cube, so far from where its corner gets.
  void WriteWall(const std::string& name, double gap) const {
    const double x = std::sqrt(2.0) + gap;
    WriteMesh(MakeBox({x, -5, -4}, {x + 1, 4, 3}), File(name));
  }

  Outcome Sweep(const std::string& rest) const {
    return Run("sweep ../box.off " + rest);
  }
};

TEST_F(CliSweep, SaysInOneLineWhetherAQuarterTurnIsFree) {
  const Outcome free = Sweep("../far.off --to 0,0,0,0,0,90");
  EXPECT_EQ(free.code, 0) << free.err;
  EXPECT_EQ(free.out,
            "free: for the whole motion, proved; it turns by 90 degrees\n");
  EXPECT_EQ(free.err, "");
  const Outcome hit = Sweep("../near.off --to 0,0,0,0,0,90");
  EXPECT_EQ(hit.code, 1) << hit.err;
  ASSERT_EQ(hit.out.rfind("collides at ", 0), 0U) << hit.out;
  EXPECT_NEAR(std::stod(hit.out.substr(12)), 0.5, 0.01) << hit.out;
  EXPECT_NE(hit.out.find(" of ../near.off\n"), std::string::npos) << hit.out;
  const Outcome touch = Sweep("../touching.off --to 0,0,0,0,0,90");
  EXPECT_EQ(touch.code, 1);
  EXPECT_EQ(touch.out.rfind("undecided from 0.4", 0), 0U) << touch.out;
}

TEST_F(CliSweep, TakesDegreesAndRadiansByTheirWords) {
  const Outcome plain = Sweep("../far.off --to 0,0,0,0,0,90 --json");
  EXPECT_EQ(Sweep("../far.off --to 0,0,0,0,0,90deg --json").out, plain.out);
  // Half of π to 16 digits; poses are told in quaternions.
  const auto turn = [](const Outcome& answer) {
    return Json::parse(answer.out).at("end");
  };
  const Outcome radians =
      Sweep("../far.off --to 0,0,0,0,0rad,1.5707963267948966rad --json");
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(turn(radians)[i].get<double>(), turn(plain)[i].get<double>(),
                1e-15);
  }
}

// The wall is met where √2 cos(45° − φ) is its place.
TEST_F(CliSweep, TellsWhenTheCornerMeetsTheWallFirst) {
  const Outcome hit = Sweep("../open.off --to 0,0,0,0,0,90 --first --json");
  EXPECT_EQ(hit.code, 1) << hit.err;
  const Json row = Json::parse(hit.out);
  const double truth =
      0.5 - std::acos(1.3 / std::sqrt(2.0)) / (0.5 * std::acos(-1.0));
  EXPECT_EQ(row["status"], "collides");
  EXPECT_LE(row["from"].get<double>(), truth + 1e-12);
  EXPECT_GE(row["to"].get<double>(), truth - 1e-12);
  EXPECT_LE(row["to"].get<double>() - row["from"].get<double>(), 1e-9);
  EXPECT_EQ(row["time"], row["to"]);
  const Outcome words = Sweep("../open.off --to 0,0,0,0,0,90 --first");
  EXPECT_NE(words.out.find(", free before 0.2"), std::string::npos)
      << words.out;
  EXPECT_EQ(Sweep("../far.off --to 0,0,0,0,0,90 --first").out,
            Sweep("../far.off --to 0,0,0,0,0,90").out);
}

// A cube that is moved by 1 to a wall at 2 touches it, at the end.
TEST_F(CliSweep, DecidesExactlyWhatItIsNotSureOf) {
  WriteMesh(MakeBox({2, -5, -4}, {3, 4, 3}), File("at2.off"));
  EXPECT_EQ(Sweep("../at2.off --to 1,0,0").out.rfind("undecided", 0), 0U);
  const Outcome exact = Sweep("../at2.off --to 1,0,0 --exact");
  EXPECT_EQ(exact.code, 1) << exact.err;
  EXPECT_EQ(exact.out.rfind("collides, exactly, with its quaternion linear in "
                            "time at 1 of the way: triangle ",
                            0),
            0U)
      << exact.out;
  const Json row =
      Json::parse(Sweep("../at2.off --to 1,0,0 --exact --json").out);
  EXPECT_EQ(row["exact"], true);
  EXPECT_EQ(row["time"], 1.0);
  EXPECT_EQ(row["pose"], row["end"]);
  // What is sure is not asked again, and says so.
  const Json sure =
      Json::parse(Sweep("../far.off --to 0,0,0,0,0,90 --exact --json").out);
  EXPECT_EQ(sure["exact"], false);
  EXPECT_EQ(sure["status"], "free");
  EXPECT_FALSE(Json::parse(Sweep("../far.off --to 0,0,0,0,0,90 --json").out)
                   .contains("exact"));
}

TEST_F(CliSweep, TellsHowCloseItComes) {
  WriteWall("apart.off", 0.3);
  const Json row = Json::parse(
      Sweep("../apart.off --to 0,0,0,0,0,90 --clearance --json").out);
  const double lower = row["clearance"]["lower"].get<double>();
  const double upper = row["clearance"]["upper"].get<double>();
  EXPECT_LE(lower, 0.3);
  EXPECT_GE(upper, 0.3 - 1e-15);
  EXPECT_LE(upper - lower, 1e-3 * upper * (1.0 + 1e-9));
  EXPECT_NEAR(row["clearance"]["time"].get<double>(), 0.5, 0.01);
  const Outcome words = Sweep("../apart.off --to 0,0,0,0,0,90 --clearance");
  EXPECT_NE(words.out.find("\nclearance: at least 0.29"), std::string::npos)
      << words.out;
  const Json hit = Json::parse(
      Sweep("../open.off --to 0,0,0,0,0,90 --clearance --json").out);
  EXPECT_EQ(hit["clearance"]["lower"], 0.0);
}

TEST_F(CliSweep, TakesAnglesAndQuaternionsAlike) {
  const std::string turned = "0,0,0.5,";
  for (const std::string& pose :
       {turned + "0,0,45", turned + "0.9238795325112867,0,0,0.3826834323650898",
        turned + "180,180,225"}) {
    const Outcome outcome = Sweep("../near.off --json --to " + pose);
    EXPECT_EQ(outcome.code, 1) << pose << outcome.err;
    const Json row = Json::parse(outcome.out);
    EXPECT_EQ(row["status"], "collides");
    EXPECT_NEAR(row["turn"].get<double>(), 45.0, 1e-12);
    EXPECT_GT(row["time"].get<double>(), 0.98);
    EXPECT_EQ(row["end"][2], 0.5);
    EXPECT_NEAR(row["pose"][3].get<double>(), std::cos(kPi / 8), 1e-2);
    EXPECT_EQ(row["obstacle"], "../near.off");
    EXPECT_LT(row["robot_triangle"].get<int>(), 12);
  }
  // Roll, then pitch, then yaw: x to y to -z ... by the axes that they give.
  const Json row =
      Json::parse(Sweep("../far.off --json --to -9,0,0,90,0,90").out);
  for (int k = 3; k < 7; ++k)
    EXPECT_NEAR(row["end"][k].get<double>(), 0.5, 1e-15);
}

TEST_F(CliSweep, TakesSeveralObstaclesAndSurfaces) {
  const Outcome outcome =
      Sweep("../far.off ../open.off --from -2,0,0 --to 0,0,0,0,0,45 --json");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["obstacle"], "../open.off");
  EXPECT_EQ(outcome.err,
            "phongpd: ../open.off: no solid, as phongpd check says; its "
            "triangles are judged\n");
  WriteMesh(MakeBox({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), File("small.off"));
  const Outcome inside = Sweep("../small.off --to 0,0,0,0,0,30");
  EXPECT_EQ(inside.code, 1);
  EXPECT_EQ(inside.out,
            "collides at 0 of the way: one holds a part of the other\n");
}

TEST_F(CliSweep, RefusesWhatIsNoPose) {
  const std::string rest = "sweep ../box.off ../far.off --to ";
  ExpectRefused(rest + "1,2", {"--to", "X,Y,Z", "found 2 numbers"});
  ExpectRefused(rest + "1,2,3,4", {"--to", "found 4 numbers"});
  ExpectRefused(rest + "1,2,x", {"--to", "finite number", "'x'"});
  ExpectRefused(rest + "1,2,", {"--to", "finite number"});
  ExpectRefused(rest + "1,2,inf", {"--to", "finite number"});
  ExpectRefused(rest + "0,0,0,1,0,0,1", {"--to", "unit quaternion", "1.41"});
  ExpectRefused(rest + "1,2,3 --from 1", {"--from", "found 1 number"});
  ExpectRefused("sweep ../box.off ../far.off", {"--to"});
  ExpectRefused(rest + "1,2,3 --exact --first", {"--first", "--exact"});
  ExpectRefused("sweep ../box.off --to 1,2,3", {"B"});
  ExpectRefused("sweep ../box.off ../missing.off --to 1,2,3", {"missing.off"});
}

}  // namespace
}  // namespace phongpd
