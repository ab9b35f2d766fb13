// SPDX-License-Identifier: GPL-3.0-or-later
// Good runs of the phongpd program: columns, and doubles that read back.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "core/solid/solid.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

TEST_F(Cli, AMeshThatDoesNotSayItIsAContactSpaceIsTakenForOneAloud) {
  WriteText("p.csv", "x,y,z\n0.3,0,0\n");
  const std::string rest = " --points ../p.csv --output o.csv";
  Outcome outcome = Run("query --contact-space ../box.off" + rest);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("box.off: taken as a contact space"),
            std::string::npos)
      << outcome.err;
  for (const std::string file : {"c.off", "c.OBJ"}) {
    ASSERT_EQ(Run("contact-space --robot ../cone.off --obstacle ../box.off "
                  "--output " +
                  file)
                  .code,
              0);
    outcome = Run("query --contact-space " + file + rest);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_FALSE(ReadMesh(Output(file)).triangles.empty());
  }
}

TEST_F(Cli, ASavedContactSpaceAnswersAsTheOneThatWasBuilt) {
  const std::string pair = "--robot ../cone.off --obstacle ../box.off ";
  ASSERT_EQ(Run("contact-space " + pair + "--output c.pcs").code, 0);
  const std::string rest =
      "--from -3 -.1 0.2 --to 3 .1 -.4 --frames 30 --smoothing-length 0 0.1 "
      "--output ";
  ASSERT_EQ(Run("motion " + pair + rest + "built.csv").code, 0);
  Outcome outcome = Run("motion --contact-space c.pcs " + rest + "read.csv");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(Content(Output("read.csv")), Content(Output("built.csv")));
  ASSERT_EQ(
      Run("minkowski --difference ../cone.off ../box.off --output d.PCS").code,
      0);
  outcome = Run("motion --contact-space d.PCS " + rest + "read.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(Content(Output("read.csv")), Content(Output("built.csv")));
}

TEST_F(Cli, QueryWritesTheDoublesOfTheLibrary) {
  ASSERT_EQ(Run("contact-space --robot ../cone.off --obstacle ../box.off "
                "--output c.off")
                .code,
            0);
  // Columns in another order, one more, CRLF, and numbers of every size.
  WriteText("p.csv",
            "id, z ,x,y\r\n1,0.1,-.3,+0.2\r\n2,1e-300,0.25,0\r\n"
            "3,0.30000000000000004,1e6,-2\r\n4,4.9e-324,0,-0.7\r\n");
  const std::vector<Eigen::Vector3d> points = {{-0.3, 0.2, 0.1},
                                               {0.25, 0.0, 1e-300},
                                               {1e6, -2.0, 0.30000000000000004},
                                               {0.0, -0.7, 4.9e-324}};
  const TriangleMesh contact = ReadMesh(Output("c.off"));
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.1;
  const PhongMetric phong(TakeAsContactSpace(contact), options);
  const PhongMetric by_default(TakeAsContactSpace(contact));
  const EuclideanMetric euclidean(TakeAsContactSpace(contact));
  const std::vector<std::pair<std::string, const PenetrationMetric*>> metrics =
      {{"--smoothing-length 0.1", &phong},
       {"", &by_default},
       {"--metric euclidean", &euclidean}};
  for (const auto& [flags, metric] : metrics) {
    const Outcome outcome =
        Run("query --contact-space c.off --points ../p.csv "
            "--output o.csv " +
            flags);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> lines =
        Split(Content(Output("o.csv")), '\n');
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_EQ(lines[0],
              "x,y,z,status,inside,signed_distance,contact_x,contact_y,"
              "contact_z,direction_x,direction_y,direction_z,gradient_x,"
              "gradient_y,gradient_z,triangle");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::vector<std::string> cells = Split(lines[i + 1], ',');
      ASSERT_EQ(cells.size(), 16U);
      const PenetrationResult expected = metric->Query(points[i]);
      EXPECT_EQ(cells[3], "ok");
      EXPECT_EQ(cells[4], expected.inside ? "1" : "0");
      EXPECT_EQ(Number(cells[5]), expected.signed_distance);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        EXPECT_EQ(Number(cells[k]), points[i][axis]);
        EXPECT_EQ(Number(cells[6 + k]), expected.contact[axis]);
        EXPECT_EQ(Number(cells[9 + k]), expected.direction[axis]);
        EXPECT_EQ(Number(cells[12 + k]), expected.gradient[axis]);
      }
      EXPECT_EQ(cells[15], std::to_string(expected.triangle));
    }
  }
}

TEST_F(Cli, ContactSpaceReportsEveryField) {
  const Outcome outcome =
      Run("contact-space --robot ../cone.off --obstacle ../box.off "
          "--output c.off --report r.json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(Content(Output("r.json")));
  for (const char* field :
       {"triangles", "vertices", "closed", "manifold", "components", "genus",
        "cavities", "volume", "self_intersections", "seconds", "peak_mib",
        "method", "predicted_cost", "approximation", "warnings"}) {
    EXPECT_TRUE(report.contains(field)) << field;
  }
  const TriangleMesh mesh = ReadMesh(Output("c.off"));
  EXPECT_EQ(report["triangles"], mesh.triangles.size());
  EXPECT_EQ(report["vertices"], mesh.vertices.size());
  EXPECT_EQ(report["closed"], true);
  EXPECT_EQ(report["manifold"], true);
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["genus"], 0);
  EXPECT_EQ(report["cavities"], 0);
  EXPECT_EQ(report["self_intersections"], 0);
  EXPECT_EQ(report["volume"].get<double>(), SignedVolume(mesh));
  EXPECT_GT(report["peak_mib"].get<double>(), 0.0);
  EXPECT_TRUE(report["method"].is_string());
  EXPECT_TRUE(report["warnings"].is_array());
  ASSERT_TRUE(report["seconds"].is_object());
  EXPECT_TRUE(report["seconds"].contains("arrangement"));
  for (const auto& [stage, seconds] : report["seconds"].items()) {
    EXPECT_TRUE(seconds.is_number()) << stage;
  }
  EXPECT_TRUE(report["approximation"]["kind"].is_string());
  EXPECT_GE(report["approximation"]["bound"].get<double>(), 0.0);
}

TEST_F(Cli, TrackedQueryFollowsTheBranch) {
  // A plate pushed through at its middle: cold answers flip sides, the
  // tracked one stays where it came from.
  WriteMesh(MakeBox({-2, -2, -0.5}, {2, 2, 0.5}), File("plate.off"));
  std::string points = "x,y,z\n";
  for (int i = 0; i <= 40; ++i) {
    points += "0.1,0.2," + std::to_string(0.4 - 0.02 * i) + "\n";
  }
  WriteText("p.csv", points);
  const std::string query =
      "query --contact-space ../plate.off --points ../p.csv --output o.csv ";
  const auto sides = [&](const std::string& flags) {
    EXPECT_EQ(Run(query + flags).code, 0);
    std::set<double> seen;
    for (const std::string& line : Split(Content(Output("o.csv")), '\n')) {
      const std::vector<std::string> cells = Split(line, ',');
      if (cells[0] != "x") seen.insert(Number(cells[8]));
    }
    return seen.size();
  };
  EXPECT_EQ(sides(""), 2U);
  EXPECT_EQ(sides("--tracked"), 1U);
  EXPECT_EQ(sides("--tracked --metric euclidean"), 2U);
}

TEST_F(Cli, SlidingQueryNeverJumpsAndSaysWhatItDoes) {
  // Into a plate from above and out below, which is too far around its rim.
  WriteMesh(MakeBox({-2, -2, -0.5}, {2, 2, 0.5}), File("plate.off"));
  std::string points = "x,y,z\n";
  for (int i = 0; i <= 60; ++i) {
    points += "0.1,0.2," + std::to_string(0.6 - 0.02 * i) + "\n";
  }
  WriteText("p.csv", points);
  const Outcome outcome =
      Run("query --contact-space ../plate.off --points ../p.csv --output o.csv "
          "--metric sliding --tracked --slide-ratio 2.5 --slide-speed 4");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::map<std::string, int> statuses;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (const std::string& line : Split(Content(Output("o.csv")), '\n')) {
    const std::vector<std::string> cells = Split(line, ',');
    if (cells[0] == "x") continue;
    ASSERT_EQ(cells.size(), 16U);
    ++statuses[cells[3]];
    const auto point = [&](std::size_t i) {
      return Eigen::Vector3d(Number(cells[i]), Number(cells[i + 1]),
                             Number(cells[i + 2]));
    };
    const bool inside = cells[4] == "1";
    const Eigen::Vector3d pd =
        inside ? Eigen::Vector3d(point(6) - point(0)) : Eigen::Vector3d::Zero();
    if (inside) {
      EXPECT_NEAR(Number(cells[5]), -pd.norm(), 1e-15);
      EXPECT_NEAR((point(9) * pd.norm() - pd).norm(), 0.0, 1e-15);
    }
    EXPECT_EQ(point(9), point(12));
    if (cells[3] != "left_elsewhere") {
      EXPECT_LE((pd - before).norm(), 5.0 * 0.02 + 1e-12) << line;
    }
    before = pd;
  }
  EXPECT_EQ(statuses["left_elsewhere"], 1);
  EXPECT_GT(statuses["following"], 20);
  EXPECT_GT(statuses["sliding"], 3);
  EXPECT_GT(statuses["outside"], 5);
  EXPECT_EQ(statuses.size(), 4U);
}

TEST_F(Cli, MotionWritesARowPerFrameAndMetricAndAPlot) {
  const Outcome outcome =
      Run("motion --robot ../cone.off --obstacle ../box.off --from -3 -.1 0.2 "
          "--to 3 .1 -.4 --frames 30 --output m.csv --svg m.svg "
          "--smoothing-length 0 0.1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = Split(Content(Output("m.csv")), '\n');
  ASSERT_EQ(lines.size(), 121U);
  EXPECT_EQ(lines[0], "frame,metric,status,pd_x,pd_y,pd_z,magnitude");
  const std::vector<std::string> names = {"euclidean", "phong@0", "phong@0.1",
                                          "sliding"};
  int inside = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = Split(lines[i], ',');
    ASSERT_EQ(cells.size(), 7U);
    EXPECT_EQ(cells[0], std::to_string((i - 1) / 4));
    EXPECT_EQ(cells[1], names[(i - 1) % 4]);
    const Eigen::Vector3d pd(Number(cells[3]), Number(cells[4]),
                             Number(cells[5]));
    EXPECT_EQ(Number(cells[6]), pd.norm());
    inside += pd.norm() > 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, 20);
  EXPECT_NE(Content(Output("m.svg")).find("</svg>"), std::string::npos);

  ASSERT_EQ(Run("motion --robot ../cone.off --obstacle ../box.off --from -3 0 "
                "0 --to 3 0 0 --frames 2 --output one.csv")
                .code,
            0);
  EXPECT_NE(Content(Output("one.csv")).find("0,phong,ok,0,0,0,0\n"),
            std::string::npos);
  EXPECT_NE(Content(Output("one.csv")).find("0,sliding,outside,0,0,0,0\n"),
            std::string::npos);
}

TEST_F(Cli, EverySceneIsListedAndWritten) {
  const Outcome list = Run("scenes list");
  ASSERT_EQ(list.code, 0);
  for (const SceneFamily& family : SceneFamilies()) {
    const std::string& name = family.name;
    EXPECT_NE(list.out.find(name + ":"), std::string::npos);
    const Outcome write =
        Run("scenes write " + name + " --output s.json --meshes m");
    ASSERT_EQ(write.code, 0) << write.err;
    const auto scene = nlohmann::json::parse(Content(Output("s.json")));
    EXPECT_EQ(scene["name"], name);
    EXPECT_TRUE(scene["robot"].contains("shape"));
    for (const char* file : {"m/robot.off", "m/obstacle.off"}) {
      EXPECT_NO_THROW(MakeSolid(ReadMesh(Output(file)), file)) << name;
    }
  }
}

TEST_F(Cli, VersionNamesTheLibraries) {
  const Outcome outcome = Run("--version");
  EXPECT_EQ(outcome.code, 0);
  for (const char* name : {"PhongPD", "CGAL", "Eigen", "FCL", "TBB"}) {
    EXPECT_NE(outcome.out.find(name), std::string::npos);
  }
  EXPECT_EQ(Run("query --help").code, 0);
}

}  // namespace
}  // namespace phongpd
