// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd optimize --limits and retime as users run them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/scenes/scene_source.h"
#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// A Bézier piece as the file has it.
struct Piece {
  double duration = 0.0;
  std::vector<Vector3d> points;
};

// De Casteljau.
Vector3d PointAt(std::vector<Vector3d> points, double s) {
  while (points.size() > 1) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      points[i] += s * (points[i + 1] - points[i]);
    }
    points.pop_back();
  }
  return points.front();
}

// By time, of order 1, 2, ...
Piece DerivativeOf(Piece piece, int order) {
  for (; order > 0; --order) {
    const double n = static_cast<double>(piece.points.size()) - 1.0;
    for (std::size_t i = 0; i + 1 < piece.points.size(); ++i) {
      piece.points[i] =
          (piece.points[i + 1] - piece.points[i]) * (n / piece.duration);
    }
    piece.points.pop_back();
  }
  return piece;
}

Vector3d At(const Piece& piece, int order, double s) {
  return PointAt(DerivativeOf(piece, order).points, s);
}

std::size_t Occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(of, at)) != std::string::npos;
       ++at) {
    ++count;
  }
  return count;
}

class CliTimed : public CliScenes {
 protected:
  // The JSON that a command wrote to run/t.json.
  Json Answer(const std::string& command, int code) const {
    const Outcome outcome = Run(command + " --output t.json");
    EXPECT_EQ(outcome.code, code) << command << outcome.out << outcome.err;
    const std::string text = Content(Output("t.json"));
    std::filesystem::remove(Output("t.json"));
    return text.empty() ? Json::object() : Json::parse(text);
  }

  static Vector3d PointOf(const Json& p) {
    EXPECT_EQ(p.size(), 3U);
    return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
  }

  static std::vector<Piece> PiecesOf(const Json& row) {
    std::vector<Piece> pieces;
    for (const Json& one : row.at("pieces")) {
      Piece piece;
      piece.duration = one.at("duration").get<double>();
      for (const Json& p : one.at("points")) piece.points.push_back(PointOf(p));
      EXPECT_EQ(piece.points.size(), 6U);
      pieces.push_back(piece);
    }
    return pieces;
  }

  // What the row promises, on the curve as it is written: free by FCL on the
  // solids and within the bounds, within the limits, of class C², from rest to
  // rest between these ends.
  static void ExpectKept(const Json& row, const phongpd::Scene& scene,
                         const Vector3d& start, const Vector3d& goal,
                         const std::array<Vector3d, 3>& limits) {
    EXPECT_EQ(row.at("certified"), true);
    EXPECT_EQ(row.at("solved"), true);
    EXPECT_EQ(row.at("verified"), "confirmed");
    const std::vector<Piece> pieces = PiecesOf(row);
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces.front().points.front(), start);
    EXPECT_EQ(pieces.back().points.back(), goal);
    std::vector<CollisionOracle> oracles;
    for (const Solid& obstacle : scene.workspace.obstacles) {
      oracles.emplace_back(scene.workspace.robot, obstacle);
    }
    const BoundingBox& bounds = scene.workspace.bounds;
    std::array<double, 3> used = {};
    double duration = 0.0, gap = 0.0;
    int hits = 0;
    std::array<Vector3d, 2> before = {Vector3d::Zero(), Vector3d::Zero()};
    Vector3d end = start;
    const auto jump = [&](const Piece& piece, double s) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Vector3d now = At(piece, static_cast<int>(k) + 1, s);
        if (s == 0.0) {
          gap =
              std::max(gap, (now - before[k]).cwiseQuotient(limits[k]).norm());
        }
        before[k] = now;
      }
    };
    for (const Piece& piece : pieces) {
      ASSERT_GT(piece.duration, 0.0);
      EXPECT_EQ(piece.points.front(), end);
      end = piece.points.back();
      duration += piece.duration;
      jump(piece, 0.0);
      jump(piece, 1.0);
      constexpr int kSamples = 200;
      for (int i = 0; i <= kSamples; ++i) {
        const double s = static_cast<double>(i) / kSamples;
        for (std::size_t k = 0; k < 3; ++k) {
          used[k] = std::max(used[k], At(piece, static_cast<int>(k) + 1, s)
                                          .cwiseAbs()
                                          .cwiseQuotient(limits[k])
                                          .maxCoeff());
        }
        const Vector3d q = PointAt(piece.points, s);
        hits += !bounds.IsEmpty() && ((q.array() <= bounds.min.array()).any() ||
                                      (q.array() >= bounds.max.array()).any());
        for (const CollisionOracle& oracle : oracles) {
          hits += oracle.Collides(q);
        }
      }
    }
    EXPECT_EQ(hits, 0);
    EXPECT_LT(gap, 1e-7) << "not C²";
    EXPECT_LT(before[0].norm(), 1e-9 * limits[0].norm()) << "no rest";
    EXPECT_LT(before[1].norm(), 1e-7 * limits[1].norm()) << "no rest";
    EXPECT_NEAR(row.at("duration").get<double>(), duration, 1e-12 * duration);
    const char* const names[] = {"velocity", "acceleration", "jerk"};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(used[k], 1.0 + 1e-9) << names[k];
      // Upper bounds, and no idle ones.
      const double told = row.at("limits_used").at(names[k]).get<double>();
      EXPECT_LE(told, 1.0);
      EXPECT_GE(told, used[k] * (1.0 - 1e-9));
      EXPECT_EQ(PointOf(row.at("limits").at(names[k])), limits[k]);
    }
    EXPECT_GT(*std::max_element(used.begin(), used.end()), 0.9);
  }

  static std::array<Vector3d, 3> Same(double v, double a, double j) {
    return {Vector3d::Constant(v), Vector3d::Constant(a),
            Vector3d::Constant(j)};
  }

  // Ends of pieces come as close to the places, one after the other, and where
  // it is to dwell it stands still so long.
  static void ExpectPassed(const Json& row) {
    const std::vector<Piece> pieces = PiecesOf(row);
    std::size_t at = 0;
    for (const Json& via : row.at("via")) {
      const Vector3d place = PointOf(via.at("point"));
      const double tolerance = via.at("tolerance").at("unit").get<double>();
      const double dwell = via.at("dwell").get<double>();
      double rest = 0.0;
      bool is_passed = false;
      while (at < pieces.size() && !is_passed) {
        is_passed = (pieces[at].points.back() - place).norm() <= tolerance;
        ++at;
      }
      EXPECT_TRUE(is_passed) << via.dump();
      for (std::size_t i = at; i < pieces.size(); ++i) {
        const bool stands =
            std::all_of(pieces[i].points.begin(), pieces[i].points.end(),
                        [&](const Vector3d& point) { return point == place; });
        rest += stands ? pieces[i].duration : 0.0;
      }
      EXPECT_NEAR(rest, dwell, 1e-12 * dwell) << via.dump();
    }
  }

  // A detour over the wall, as somebody would draw it.
  void WriteDetour() const {
    WriteText("detour.csv",
              "x,y,z\n-1.5,0,0\n-0.5,1,0\n0,1.2,0\n1,1,0\n1.5,0,0\n");
  }
};

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

TEST_F(CliTimed, WritesRowsInTimeAtTheRate) {
  const std::string command =
      "optimize " + Scene(TwoObstacles()) + " --limits 1,2,10";
  const Json row = Answer(command, 0);
  const std::vector<Piece> pieces = PiecesOf(row);
  const double duration = row["duration"].get<double>();
  for (const double rate : {100.0, 37.5}) {
    const std::string flag =
        rate == 100.0 ? "" : " --rate 37.5";  // the default
    ASSERT_EQ(Run(command + flag + " --output t.csv").code, 0);
    const std::vector<std::string> lines =
        Split(Content(Output("t.csv")), '\n');
    EXPECT_EQ(lines.at(0), "t,x,y,z,vx,vy,vz,ax,ay,az");
    const auto steps = static_cast<std::size_t>(std::floor(duration * rate));
    ASSERT_GE(lines.size(), steps + 2);
    ASSERT_LE(lines.size(), steps + 3);  // and the end
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> cells = Split(lines[i], ',');
      ASSERT_EQ(cells.size(), 10U) << lines[i];
      std::array<double, 10> v;
      for (std::size_t k = 0; k < 10; ++k) v[k] = Number(cells[k]);
      const double t =
          i + 1 == lines.size() ? duration : static_cast<double>(i - 1) / rate;
      EXPECT_NEAR(v[0], t, 1e-12 * duration);
      // The same curve at that time.
      double left = v[0];
      std::size_t at = 0;
      while (at + 1 < pieces.size() && left > pieces[at].duration) {
        left -= pieces[at++].duration;
      }
      const double s = left / pieces[at].duration;
      for (int order = 0; order < 3; ++order) {
        const Vector3d told(v[1 + 3 * order], v[2 + 3 * order],
                            v[3 + 3 * order]);
        EXPECT_LT((told - At(pieces[at], order, s)).norm(), 1e-6)
            << lines[i] << " order " << order;
      }
    }
  }
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

TEST_F(CliTimed, WritesWhatMachinesRead) {
  Json json = TwoObstacles();
  json["unit"] = "mm";
  const std::string command = "optimize " + Scene(json) + " --limits 1,2,10";
  ASSERT_EQ(Run(command + " --output t.csv --rate 20").code, 0);
  ASSERT_EQ(Run(command + " --output t.yaml --rate 20").code, 0);
  const std::string yaml = Content(Output("t.yaml"));
  const auto rows = Split(Content(Output("t.csv")), '\n').size() - 1;
  EXPECT_NE(yaml.find("- positions: [-0.0015, 0, 0]"), std::string::npos);
  ASSERT_EQ(Run(command + " --output t.multidof.yaml --rate 20").code, 0);
  const std::string body = Content(Output("t.multidof.yaml"));
  EXPECT_EQ(Occurrences(yaml, "- positions: ["), rows);
  EXPECT_EQ(Occurrences(body, "- transforms: ["), rows);
  EXPECT_EQ(Occurrences(body, "nanosec: "), rows);
  EXPECT_NE(body.find("- transforms: [{translation: {x: -0.0015, y: 0, z: 0}, "
                      "rotation: {x: 0, y: 0, z: 0, w: 1}}]\n"
                      "  velocities: [{linear: {x: 0, y: 0, z: 0}, angular: "
                      "{x: 0, y: 0, z: 0}}]\n"),
            std::string::npos)
      << body.substr(0, 400);
  for (const std::string name : {"t.gcode", "t.nc"}) {
    ASSERT_EQ(Run(command + " --output " + name).code, 0);
    const std::string gcode = Content(Output(name));
    EXPECT_NE(gcode.find("G21 ; mm\n"), std::string::npos) << gcode;
    EXPECT_NE(gcode.find("G1 X1.50000 Y0.00000 Z0.00000 F"), std::string::npos)
        << gcode;
  }
}

// What the page plays is the curve of the JSON, at equal times.
TEST_F(CliTimed, PlaysAPageInItsOwnTime) {
  const std::string command =
      "optimize " + Scene(TwoObstacles()) + " --limits 1,2,10 --html ../p.html";
  const Json row = Answer(command, 0);
  const std::string page = Content(File("p.html"));
  const std::string open = "id=\"view-data\">";
  const std::size_t at = page.find(open);
  ASSERT_NE(at, std::string::npos);
  const std::size_t from = at + open.size();
  const Json view =
      Json::parse(page.substr(from, page.find("</script>", from) - from));
  const Json& path = view["paths"][0];
  const Json& pace = path["pace"];
  EXPECT_EQ(path["free"], true);
  EXPECT_EQ(pace["duration"], row["duration"]);
  const std::vector<Piece> pieces = PiecesOf(row);
  const std::size_t last = path["points"].size() - 1;
  ASSERT_EQ(pace["jerk"].size(), last + 1);
  double begin = 0.0, least = 1e300, most = 0.0;
  std::size_t piece = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const double t = row["duration"].get<double>() * static_cast<double>(i) /
                     static_cast<double>(last);
    while (piece + 1 < pieces.size() && t >= begin + pieces[piece].duration) {
      begin += pieces[piece++].duration;
    }
    const Piece& here = pieces[piece];
    const double s = std::min(1.0, (t - begin) / here.duration);
    EXPECT_LT((PointOf(path["points"][i]) - At(here, 0, s)).norm(), 1e-9) << i;
    EXPECT_NEAR(pace["velocity"][i].get<double>(),
                At(here, 1, s).cwiseAbs().maxCoeff() / 1.0, 1e-6);
    EXPECT_NEAR(pace["acceleration"][i].get<double>(),
                At(here, 2, s).cwiseAbs().maxCoeff() / 2.0, 1e-6);
    least = std::min(least, pace["clearance"][i].get<double>());
    most = std::max(most, pace["jerk"][i].get<double>());
  }
  EXPECT_GE(least, row["clearance"].get<double>() * (1.0 - 1e-9));
  EXPECT_GT(most, 0.5);
  EXPECT_LE(most, 1.0 + 1e-9);
  WriteDetour();
  EXPECT_EQ(Run("retime ../detour.csv --scene ../scene.json --limits 1,2,10 "
                "--html r.html")
                .code,
            0);
  EXPECT_NE(Content(Output("r.html")).find("\"pace\""), std::string::npos);
}

TEST_F(CliTimed, EndsAtCtrlCWithTheBestSoFar) {
  // A hundred places to pass: a search of many seconds.
  std::string path = "x,y,z\n-1.5,0,0\n", places;
  for (int i = 0; i < 100; ++i) {
    const std::string place = "-1.8," +
                              std::to_string(i % 2 == 0 ? 1.2 : -1.2) + "," +
                              std::to_string(1.8 - 0.035 * i);
    path += place + "\n";
    if (i < 99) places += " --via=" + place;
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
