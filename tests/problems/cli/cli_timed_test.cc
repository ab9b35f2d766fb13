// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd optimize --limits and retime as users run them.
#include <gtest/gtest.h>

#include "tests/problems/cli/timed_answers.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TEST_F(CliTimed, WritesACurveThatKeepsWhatItPromises) {
  Scene(TwoObstacles());
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  const std::array<Vector3d, 3> uneven = {
      Vector3d(1, 0.5, 2), Vector3d(2, 2, 2), Vector3d(10, 20, 10)};
  for (const std::string flags : {"", " --model window", " --preset fast"}) {
    const Json row =
        Answer("optimize ../scene.json --limits 1,2,10" + flags, 0);
    ExpectKept(row, scene, scene.start, scene.goal, Same(1, 2, 10));
    EXPECT_EQ(row["scene"], "two");
    EXPECT_EQ(row["planner"], "contact-surface");
    EXPECT_EQ(row["model"], flags == " --model window" ? "window" : "full");
    EXPECT_GT(row["clearance"].get<double>(), 0.0);
    EXPECT_EQ(row["lengths"]["clearance"]["unit"], row["clearance"]);
    EXPECT_LE(row["duration"], row["stops_duration"]);
    EXPECT_GE(row["length"].get<double>(), 3.0);
  }
  const Json by_axis =
      Answer("optimize ../scene.json --limits 1/0.5/2,2,10/20/10", 0);
  ExpectKept(by_axis, scene, scene.start, scene.goal, uneven);
  const Json family = Answer("optimize u_trap:triangles=80 --limits 1,2,10", 0);
  const phongpd::Scene trap = SceneSource("u_trap:triangles=80").Load();
  ExpectKept(family, trap, trap.start, trap.goal, Same(1, 2, 10));
}

TEST_F(CliTimed, TakesTheLimitsOfTheScene) {
  Json json = TwoObstacles();
  json["limits"] = {
      {"velocity", 1}, {"acceleration", {2, 2, 2}}, {"jerk", 10.0}};
  const Json row = Answer("optimize " + Scene(json), 0);
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  ExpectKept(row, scene, scene.start, scene.goal, Same(1, 2, 10));
  const Json other = Answer("optimize ../scene.json --limits 2,4,20", 0);
  ExpectKept(other, scene, scene.start, scene.goal, Same(2, 4, 20));
  // The flag wins; none of them: a path without time, as ever.
  const Json path = OneRow("optimize ../scene.json --limits none", 0);
  EXPECT_EQ(path["status_class"].is_string(), true);
  EXPECT_FALSE(path.contains("pieces"));
}

TEST_F(CliTimed, TimesMayHaveTheirUnits) {
  Scene(TwoObstacles());
  const std::string ask =
      "optimize ../scene.json --limits 1,2,10 --preset fast";
  EXPECT_EQ(Answer(ask + " --duration 0.2min", 0)["asked_duration"], 12.0);
  const Json row = Answer(ask + " --via 0,1.2,0,0.1unit,500ms", 0);
  EXPECT_EQ(row["via"][0]["dwell"], 0.5);
}

TEST_F(CliTimed, AsksWhetherLimitsAreInTheUnitOfTheScene) {
  Scene(TwoObstacles());
  const std::string slow =
      "optimize ../scene.json --limits 0.001,2,10 --preset fast";
  const std::string ask = "are the limits in the scene's unit";
  EXPECT_NE(Run(slow).err.find(ask), std::string::npos);
  EXPECT_EQ(Run(slow + " --duration 2h").err.find(ask), std::string::npos);
}

TEST_F(CliTimed, RetimesAPathOfOnesOwn) {
  Scene(TwoObstacles());
  WriteDetour();
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  const Json row =
      Answer("retime ../detour.csv --scene ../scene.json --limits 1,2,10", 0);
  ExpectKept(row, scene, {-1.5, 0, 0}, {1.5, 0, 0}, Same(1, 2, 10));
  EXPECT_EQ(row["planner"], nullptr);
  EXPECT_EQ(row["path"].size(), 5U);
  EXPECT_LT(row["duration"], row["stops_duration"]);
  // The scene's own start and goal count for nothing.
  WriteText("back.csv", "x,y,z\n1,-1,0.5\n-1,-1,0.5\n");
  const Json back =
      Answer("retime ../back.csv --scene ../scene.json --limits 1,2,10", 0);
  ExpectKept(back, scene, {1, -1, 0.5}, {-1, -1, 0.5}, Same(1, 2, 10));
}

TEST_F(CliTimed, TellsWhereAPathCollides) {
  Scene(TwoObstacles());
  // Robot and wall meet from x = −0.2: at 1.2 of the 2 from −1.4.
  WriteText("through.csv", "x,y,z\n-1.5,0,0\n-1.4,0,0\n0.6,0,0\n1.5,0,0\n");
  const Json row =
      Answer("retime ../through.csv --scene ../scene.json --limits 1,2,10", 1);
  EXPECT_EQ(row["status"], "not_free");
  EXPECT_EQ(row["certified"], false);
  EXPECT_EQ(row["solved"], false);
  EXPECT_TRUE(row["pieces"].empty());
  const std::string reason = row["reason"].get<std::string>();
  for (const std::string word : {"segment 1", "fraction 0.6", "wall"}) {
    EXPECT_NE(reason.find(word), std::string::npos) << reason;
  }
  const Outcome told = Run(
      "retime ../through.csv --scene ../scene.json --limits 1,2,10 --output "
      "t.csv");
  EXPECT_EQ(told.code, 1);
  EXPECT_NE(told.out.find("no trajectory, not_free"), std::string::npos);
  EXPECT_EQ(Content(Output("t.csv")), "t,x,y,z,vx,vy,vz,ax,ay,az\n");
}

TEST_F(CliTimed, SaysWhyThereIsNoMotion) {
  Json blocked = TwoObstacles();
  blocked["start"] = {0.1, 0, 0};
  const Json start =
      Answer("optimize " + Scene(blocked) + " --limits 1,2,10", 1);
  EXPECT_EQ(start["status"], "start_in_collision");
  EXPECT_NE(start["reason"].get<std::string>().find("wall"), std::string::npos);
  const Json shut =
      Answer("optimize " + Scene(ShutOff()) + " --limits 1,2,10", 1);
  EXPECT_EQ(shut["status"], "infeasible_proved");
  // More room than there is, as a wish and as a condition.
  const std::string wide =
      "optimize " + Scene(TwoObstacles()) + " --limits 1,2,10 --margin 0.4D";
  EXPECT_EQ(Answer(wide, 0)["certified"], true);
  const Json missed = Answer(wide + " --require", 1);
  EXPECT_EQ(missed["status"], "clearance_missed");
  EXPECT_EQ(missed["certified"], true);
  EXPECT_EQ(missed["solved"], false);
  // What a machine reads is answers only.
  EXPECT_EQ(Run(wide + " --require --output t.csv").code, 1);
  EXPECT_EQ(Content(Output("t.csv")), "t,x,y,z,vx,vy,vz,ax,ay,az\n");
}

TEST_F(CliTimed, PassesPlacesOnTheWay) {
  Json json = TwoObstacles();
  const std::string command = "optimize " + Scene(json) + " --limits 1,2,10";
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  const Json free = Answer(command, 0);
  EXPECT_TRUE(free["via"].empty());
  EXPECT_EQ(free["asked_duration"], nullptr);
  const Json row =
      Answer(command + " --via=-1,-1.2,0 --via 0,1.5,0.3,0.05unit,0.25", 0);
  ExpectKept(row, scene, scene.start, scene.goal, Same(1, 2, 10));
  ASSERT_EQ(row["via"].size(), 2U);
  EXPECT_EQ(row["via"][0]["tolerance"]["share"], 0.001);
  EXPECT_EQ(row["via"][1]["tolerance"]["unit"], 0.05);
  EXPECT_EQ(row["via"][1]["dwell"], 0.25);
  ExpectPassed(row);
  EXPECT_GT(row["duration"], free["duration"]);
  // The same places in the scene; a flag wins over all of them.
  json["via"] = {
      {{"point", {-1, -1.2, 0}}},
      {{"point", {0, 1.5, 0.3}}, {"tolerance", "0.05unit"}, {"dwell", 0.25}}};
  json["limits"] = {{"velocity", 1}, {"acceleration", 2}, {"jerk", 10}};
  const Json own = Answer("optimize " + Scene(json), 0);
  EXPECT_EQ(own["pieces"], row["pieces"]);
  const Json other = Answer("optimize ../scene.json --via 0,1.5,0.3,0.01D", 0);
  ASSERT_EQ(other["via"].size(), 1U);
  ExpectPassed(other);
  // A place on a path of one's own, and not the scene's.
  WriteDetour();
  const std::string retime = "retime ../detour.csv --scene ../scene.json";
  EXPECT_TRUE(Answer(retime, 0)["via"].empty());
  const Json stop = Answer(retime + " --via 0,1.2,0,0.01unit,0.5", 0);
  ExpectKept(stop, scene, scene.start, scene.goal, Same(1, 2, 10));
  ExpectPassed(stop);
}

TEST_F(CliTimed, TakesTheTimeAskedFor) {
  Json json = TwoObstacles();
  const std::string command = "optimize " + Scene(json) + " --limits 1,2,10";
  const double least = Answer(command, 0)["duration"].get<double>();
  const Json calm = Answer(command + " --duration 6", 0);
  EXPECT_NEAR(calm["duration"].get<double>(), 6.0, 1e-9);
  EXPECT_EQ(calm["asked_duration"], 6.0);
  EXPECT_EQ(calm["verified"], "confirmed");
  EXPECT_LT(calm["limits_used"]["jerk"], 0.9);
  const Json hasty = Answer(command + " --duration 1.5", 1);
  EXPECT_EQ(hasty["status"], "duration_too_short");
  EXPECT_TRUE(hasty["pieces"].empty());
  EXPECT_EQ(hasty["verified"], nullptr);
  const std::string reason = hasty["reason"].get<std::string>();
  EXPECT_NE(reason.find("the fastest that was found takes "), std::string::npos)
      << reason;
  EXPECT_NE(reason.find("not 1.5"), std::string::npos) << reason;
  json["limits"] = {{"velocity", 1}, {"acceleration", 2}, {"jerk", 10}};
  json["duration"] = 6;
  const std::string own = "optimize " + Scene(json);
  EXPECT_EQ(Answer(own, 0)["pieces"], calm["pieces"]);
  EXPECT_EQ(Answer(own + " --duration 0", 0)["duration"], least);
}

// Of a motion that passes: it neither begins nor ends at rest.
TEST_F(CliTimed, BeginsAndEndsAsItIsTold) {
  Json json = TwoObstacles();
  const std::string command = "optimize " + Scene(json) + " --limits 1,2,10";
  const Json rest = Answer(command, 0);
  EXPECT_EQ(rest["departure"]["velocity"], Json({0, 0, 0}));
  const Json row =
      Answer(command + " --departure 0,0.4,0.1,0.1,0,0 --arrival=0,-0.2,0", 0);
  EXPECT_EQ(row["departure"]["velocity"], Json({0, 0.4, 0.1}));
  EXPECT_EQ(row["departure"]["acceleration"], Json({0.1, 0, 0}));
  EXPECT_EQ(row["verified"], "confirmed");
  const std::vector<Piece> pieces = PiecesOf(row);
  ASSERT_FALSE(pieces.empty());
  const auto far = [&pieces](int order, bool is_end,
                             const Vector3d& asked) -> Vector3d {
    return (is_end ? At(pieces.back(), order, 1.0)
                   : At(pieces.front(), order, 0.0)) -
           asked;
  };
  EXPECT_LT(far(1, false, {0, 0.4, 0.1}).norm(), 1e-9);
  EXPECT_LT(far(2, false, {0.1, 0, 0}).norm(), 1e-7);
  EXPECT_LT(far(1, true, {0, -0.2, 0}).norm(), 1e-9);
  EXPECT_LT(far(2, true, Vector3d::Zero()).norm(), 1e-7);
  // The same in the scene; what is not a speed of the machine is refused.
  json["limits"] = {{"velocity", 1}, {"acceleration", 2}, {"jerk", 10}};
  json["departure"] = {{"velocity", {0, 0.4, 0.1}},
                       {"acceleration", {0.1, 0, 0}}};
  json["arrival"] = {{"velocity", {0, -0.2, 0}}};
  EXPECT_EQ(Answer("optimize " + Scene(json), 0)["pieces"], row["pieces"]);
  for (const std::string bad : {"--departure 0,3,0", "--arrival 1,2",
                                "--departure 0,x,0", "--arrival 0,0,0,9,0,0"}) {
    const Outcome refused = Run(command + " " + bad);
    EXPECT_EQ(refused.code, 2) << bad;
    EXPECT_EQ(Occurrences(refused.err, "\n"), 1U) << refused.err;
  }
  const Outcome path =
      Run("optimize ../scene.json --limits none --arrival 0,0,0");
  EXPECT_EQ(path.code, 2);
  EXPECT_NE(path.err.find("--arrival"), std::string::npos) << path.err;
}

// Where start and goal have room, what is asked for is kept all the way, with
// rests and without, and whatever the preset; so that it may be required.
TEST_F(CliTimed, KeepsAMarginThatIsAskedFor) {
  Json json = TwoObstacles();
  Scene(json);
  json["via"] = {{{"point", {-0.8, 0.9, 0.3}}, {"dwell", 0.2}}};
  Scene(json, "via.json");
  for (const std::string scene : {"scene", "via"}) {
    double longer = 0.0;  // than without
    for (const std::string preset : {"fast", "balanced", "tight"}) {
      const std::string command =
          "optimize ../" + scene + ".json --limits 1,2,10 --preset " + preset;
      const double free = Answer(command, 0)["duration"].get<double>();
      for (const double margin : {0.02, 0.05, 0.1}) {
        const std::string asked =
            command + " --margin " + std::to_string(margin) + "unit";
        const Json wish = Answer(asked, 0);
        EXPECT_GE(wish["clearance"].get<double>(), 0.999 * margin) << asked;
        const Json row = Answer(asked + " --require", 0);
        EXPECT_EQ(row["certified"], true) << asked;
        EXPECT_GE(row["clearance"].get<double>(), (1.0 - 1e-6) * margin)
            << asked;
        EXPECT_LE(row["lengths"]["kept_margin"]["unit"].get<double>(),
                  margin * (1.0 + 1e-9));
        longer = std::max(longer, row["duration"].get<double>() / free - 1.0);
      }
    }
    EXPECT_LT(longer, 0.15) << scene;
  }
}

TEST_F(CliTimed, EndsAtCtrlCWithTheBestSoFar) {
  // A thousand places to pass: the first curve within a second, half a minute
  // until the search ends by itself.
  std::string path = "x,y,z\n-1.5,0,0\n", places;
  for (int i = 0; i < 1000; ++i) {
    const std::string place = "-1.8," +
                              std::to_string(i % 2 == 0 ? 1.2 : -1.2) + "," +
                              std::to_string(1.8 - 0.0035 * i);
    path += place + "\n";
    if (i < 999) places += " --via=" + place;
  }
  WriteText("long.csv", path);
  const std::string command =
      "retime ../long.csv --scene " + Scene(TwoObstacles()) +
      " --limits 1,2,10 --preset tight --output t.json" + places;
  // Where it comes before there is a curve, it ends the program as ever.
  Outcome outcome;
  for (int seconds = 1; seconds < 60; seconds *= 2) {
    outcome =
        Run(command, "timeout --preserve-status -s INT " +
                         std::to_string(seconds) + " env --default-signal=INT");
    if (outcome.code == 0) break;
    EXPECT_EQ(outcome.code, 128 + 2);
  }
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json row = Json::parse(Content(Output("t.json")));
  EXPECT_EQ(row["status"], "interrupted");
  EXPECT_EQ(row["certified"], true);
  EXPECT_EQ(row["verified"], "confirmed");
}

TEST_F(CliTimed, SaysWhichPlaceIsNotReached) {
  const std::string rest = " --limits 1,2,10 --via ";
  const Json within =
      Answer("optimize " + Scene(TwoObstacles()) + rest + "0,0,0.1", 1);
  EXPECT_EQ(within["status"], "via_not_free");
  EXPECT_EQ(within["verified"], nullptr);
  const std::string why = within["reason"].get<std::string>();
  EXPECT_EQ(why.find("via 0"), 0U) << why;
  EXPECT_NE(why.find("wall"), std::string::npos) << why;
  // What is proved of these places is not of those near them.
  const Json shut = Answer("optimize " + Scene(ShutOff()) + rest +
                               "-1,0,0 --via 1,0,0 --via 1,0.1,0",
                           1);
  EXPECT_EQ(shut["status"], "failed");
  EXPECT_EQ(shut["verified"], nullptr);
  EXPECT_EQ(shut["reason"],
            "from via 0 to via 1: no path, proved for these places, not for "
            "places near them");
  // An end that is not free is said first.
  Json blocked = ShutOff();
  blocked["goal"] = {0.1, 0, 0};
  EXPECT_EQ(Answer("optimize " + Scene(blocked) + rest + "1,0,0", 1)["status"],
            "goal_in_collision");
  // There and back again, if one can be there.
  Json loop = TwoObstacles();
  loop["goal"] = loop["start"];
  const Json back = Answer("optimize " + Scene(loop) + rest + "1.5,0,0", 0);
  EXPECT_EQ(back["certified"], true);
  ExpectPassed(back);
  loop["start"] = loop["goal"] = {0.1, 0, 0};
  EXPECT_EQ(Answer("optimize " + Scene(loop) + rest + "1.5,0,0", 1)["status"],
            "start_in_collision");
}

}  // namespace
}  // namespace phongpd
