// SPDX-License-Identifier: GPL-3.0-or-later
// What optimize --limits writes for controllers and to look at.
#include <gtest/gtest.h>

#include "tests/problems/cli/timed_answers.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

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

}  // namespace
}  // namespace phongpd
