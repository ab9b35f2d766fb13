// SPDX-License-Identifier: GPL-3.0-or-later
// `phongpd depth` and `phongpd minkowski` as a user calls them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/solid/mesh_check.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Json = nlohmann::json;

TEST_F(Cli, DepthTellsHowDeepAndWhichWayOut) {
  const Outcome outcome =
      Run("depth ../box.off ../box.off --at 1.5 0.25 0 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  EXPECT_EQ(answer["status"], "penetrating");
  EXPECT_EQ(answer["depth"], 0.5);
  EXPECT_EQ(answer["clearance"], 0.0);
  EXPECT_EQ(answer["direction"], Json({1.0, 0.0, 0.0}));
  EXPECT_EQ(answer["contact"], Json({2.0, 0.25, 0.0}));
  EXPECT_EQ(answer["certified"], true);
  const double a = answer["on_a"]["point"][0], b = answer["on_b"]["point"][0];
  EXPECT_EQ(a, 0.5);
  EXPECT_EQ(b, 1.0);
  // Faces overlap: any pair of points in them will do.
  EXPECT_FALSE(answer["on_a"]["vertices"].empty());
  EXPECT_FALSE(answer["on_b"]["vertices"].empty());
  const Outcome text = Run("depth ../box.off ../box.off --at 1.5 0.25 0");
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(text.out.rfind("penetrating: depth 0.5, out along 1,0,0\n", 0), 0U)
      << text.out;
}

TEST_F(Cli, DepthTellsTouchingAndSeparate) {
  Json answer =
      Json::parse(Run("depth ../box.off ../box.off --at 2 0 0 --json").out);
  EXPECT_EQ(answer["status"], "touching");
  answer =
      Json::parse(Run("depth ../box.off ../box.off --at 5 0 0 --json").out);
  EXPECT_EQ(answer["status"], "separate");
  EXPECT_EQ(answer["clearance"], 3.0);
}

TEST_F(Cli, DepthAnswersARowForEveryPose) {
  // A quarter turn about z leaves the box as it is.
  WriteText("poses.csv",
            "x,y,z,qw,qx,qy,qz\n1.5,0,0,1,0,0,0\n"
            "1.5,0,0,0.70710678118654757,0,0,0.70710678118654757\n"
            "7,0,0,1,0,0,0\n");
  const Outcome outcome =
      Run("depth ../box.off ../box.off --pose ../poses.csv --output d.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = Split(Content(Output("d.csv")), '\n');
  ASSERT_EQ(lines.size(), 4U);
  const std::vector<std::string> header = Split(lines[0], ',');
  const auto cell = [&](std::size_t row, const std::string& name) {
    const std::vector<std::string> cells = Split(lines[row], ',');
    EXPECT_EQ(cells.size(), header.size());
    for (std::size_t c = 0; c < header.size(); ++c) {
      if (header[c] == name) return cells[c];
    }
    return std::string("no column");
  };
  EXPECT_EQ(cell(1, "status"), "penetrating");
  EXPECT_NEAR(Number(cell(1, "depth")), 0.5, 1e-15);
  EXPECT_NEAR(Number(cell(2, "depth")), 0.5, 1e-10);
  EXPECT_EQ(cell(3, "status"), "separate");
  EXPECT_NEAR(Number(cell(3, "clearance")), 5.0, 1e-14);
  EXPECT_EQ(cell(2, "certified"), "1");
}

TEST_F(Cli, DepthTellsPhongPDWhereASmoothingLengthAsksForIt) {
  const std::string command = "depth ../ball.off ../box.off --at 0.3 0.1 0.7";
  WriteMesh(MakeIcoBall(0.3, 1), File("ball.off"));
  ASSERT_EQ(Run("contact-space --robot ../ball.off --obstacle ../box.off "
                "--output ../c.pcs")
                .code,
            0);
  WriteText("q.csv", "x,y,z\n0.3,0.1,0.7\n");
  for (const std::string length : {"0", "0.1", "0.3unit"}) {
    const std::string flag = " --smoothing-length " + length;
    const Json answer = Json::parse(Run(command + flag + " --json").out);
    const Json& phong = answer["phong"];
    EXPECT_EQ(phong["status"], "ok");
    EXPECT_EQ(phong["level"],
              length == "0" ? answer["phong"]["level"] : "full");
    EXPECT_GE(phong["depth"], answer["depth"]);
    const Json whole = Json::parse(
        Run("query --contact-space ../c.pcs --points ../q.csv --json" + flag)
            .out);
    EXPECT_NEAR(phong["depth"].get<double>(),
                -whole["signed_distance"].get<double>(), 1e-12);
    const Outcome text = Run(command + flag);
    EXPECT_NE(text.out.find("PhongPD, ℓ = " + length + ": depth "),
              std::string::npos)
        << text.out;
  }
  WriteText("poses.csv",
            "x,y,z,qw,qx,qy,qz\n0.3,0.1,0.7,1,0,0,0\n"
            "0.3,0.1,0.7,0.70710678118654757,0,0,0.70710678118654757\n"
            "7,0,0,1,0,0,0\n");
  ASSERT_EQ(Run("depth ../box.off ../box.off --pose ../poses.csv "
                "--smoothing-length 0 --output ../d.csv")
                .code,
            0);
  const std::vector<std::string> lines = Split(Content(File("d.csv")), '\n');
  ASSERT_EQ(lines.size(), 4U);
  const std::vector<std::string> header = Split(lines[0], ',');
  EXPECT_EQ(header.back(), "phong_level");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(Split(lines[i], ',').size(), header.size());
  }
  EXPECT_EQ(Split(lines[3], ',').back(), "none");
  ExpectRefused(command + " --smoothing-length -1", {"--smoothing-length"});
  ExpectRefused(command + " --smoothing-length 9unit", {"--smoothing-length"});
}

TEST_F(Cli, DepthTellsTheSmoothedDirectionOfTheWholeContactSpace) {
  const std::string command = "depth ../ball.off ../box.off --at 0.3 0.1 0.7";
  WriteMesh(MakeIcoBall(0.3, 1), File("ball.off"));
  ASSERT_EQ(Run("contact-space --robot ../ball.off --obstacle ../box.off "
                "--output ../c.pcs")
                .code,
            0);
  WriteText("q.csv", "x,y,z\n0.3,0.1,0.7\n");
  for (const std::string metric : {"smoothed", "smoothed-foot"}) {
    const std::string flags =
        " --metric " + metric + " --smoothing-length 0.1 ";
    const Json answer = Json::parse(Run(command + flags + "--json").out);
    const Json& found = answer["smoothed"];
    EXPECT_EQ(found["metric"], metric);
    EXPECT_EQ(found["status"], "ok");
    EXPECT_NEAR(found["depth"].get<double>(), answer["depth"].get<double>(),
                1e-12);
    const Json whole = Json::parse(
        Run("query --contact-space ../c.pcs --points ../q.csv --json" + flags)
            .out);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(found["direction"][k].get<double>(),
                  whole["direction"][k].get<double>(), 1e-9);
    }
    const Outcome text = Run(command + flags);
    EXPECT_NE(text.out.find(metric + ", ℓ = 0.1: depth "), std::string::npos)
        << text.out;
  }
  ExpectRefused(command + " --metric smoothed --smoothing-length 0",
                {"--smoothing-length", "> 0"});
  ExpectRefused(command + " --metric euclidean --smoothing-length 0.1",
                {"--smoothing-length", "none with metric euclidean"});
}

TEST_F(Cli, DepthRefusesPosesThatAreNoneWithFileAndRow) {
  const std::string command = "depth ../box.off ../box.off --pose ../p.csv";
  const std::string header = "x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n";
  WriteText("p.csv", header + "0,0,0,1,0,0,1e-4\n");
  ExpectRefused(command, {"p.csv:3", "unit quaternion"});
  WriteText("p.csv", header + "0,0,0,0,0,0,0\n");
  ExpectRefused(command, {"p.csv:3", "unit quaternion"});
  WriteText("p.csv", header + "nan,0,0,1,0,0,0\n");
  ExpectRefused(command, {"p.csv:3", "column x", "finite"});
  WriteText("p.csv", header + "0,0,0,1,0,inf,0\n");
  ExpectRefused(command, {"p.csv:3", "column qy", "finite"});
  WriteText("p.csv", header + "0,0,0,1\n");
  ExpectRefused(command, {"p.csv:3", "7 cells"});
  WriteText("p.csv", "x,y,z\n0,0,0\n");
  ExpectRefused(command, {"p.csv:1", "qw"});
  WriteText("p.csv", "");
  ExpectRefused(command, {"p.csv", "empty"});
  ExpectRefused("depth ../box.off ../box.off --pose ../none.csv", {"none.csv"});
}

TEST_F(Cli, DepthRefusesOperandsAndFlags) {
  TriangleMesh open = MakeBox({-1, -1, -1}, {1, 1, 1});
  open.triangles.pop_back();
  WriteMesh(open, File("open.off"));
  ExpectRefused("depth ../open.off ../box.off", {"open.off", "3"});
  ExpectRefused("depth ../box.off ../missing.off", {"missing.off"});
  ExpectRefused("depth ../box.off", {});
  ExpectRefused("depth ../box.off ../box.off --at nan 0 0", {"--at"});
  ExpectRefused("depth ../box.off ../box.off --at 1e300 0 0", {"box.off"});
  ExpectRefused("depth ../box.off ../box.off --max-radius 0", {"--max-radius"});
}

TEST_F(Cli, DepthSaysWhatItCouldNotCertify) {
  const Outcome outcome =
      Run("depth ../box.off ../box.off --max-radius 0.5 --json");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  EXPECT_EQ(answer["certified"], false);
  EXPECT_GE(answer["depth"], 2.0);
  EXPECT_GE(answer["explored_radius"], 0.5);
}

TEST_F(Cli, MinkowskiAddsAndSubtracts) {
  WriteMesh(MakeBox({0, 0, 0}, {1, 2, 3}), File("a.off"));
  WriteMesh(MakeBox({5, 5, 5}, {6, 6, 6}), File("b.off"));
  ASSERT_EQ(
      Run("minkowski ../a.off ../b.off --output s.off --report s.json").code,
      0);
  BoundingBox box = ComputeBounds(ReadMesh(Output("s.off")));
  EXPECT_EQ(box.min, Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(box.max, Eigen::Vector3d(7, 8, 9));
  const Json report = Json::parse(Content(Output("s.json")));
  EXPECT_EQ(report["volume"], 24.0);
  EXPECT_EQ(report["closed"], true);
  EXPECT_EQ(report["sum"], "A + B");
  EXPECT_EQ(report["a"]["triangles"], 12);
  ASSERT_EQ(Run("minkowski ../a.off ../b.off --difference --output d.off").code,
            0);
  box = ComputeBounds(ReadMesh(Output("d.off")));
  EXPECT_EQ(box.min, Eigen::Vector3d(4, 3, 2));
  EXPECT_EQ(box.max, Eigen::Vector3d(6, 6, 6));
}

TEST_F(Cli, MinkowskiOfAConvexSolidAndItselfIsTwiceAsLarge) {
  // |A + A| = 8 |A| for convex A, and A + A is 2 A.
  ASSERT_EQ(
      Run("minkowski ../cone.off ../cone.off --output s.off --report s.json")
          .code,
      0);
  const double volume = SignedVolume(ReadMesh(File("cone.off")));
  const Json report = Json::parse(Content(Output("s.json")));
  // The cone is on no lattice: 2^-38 of it is rounded off.
  EXPECT_NEAR(report["volume"].get<double>(), 8.0 * volume, 1e-10 * volume);
}

TEST_F(Cli, MinkowskiRefusesBadInput) {
  ExpectRefused("minkowski ../missing.off ../box.off --output s.off",
                {"missing.off"});
  ExpectRefused("minkowski ../box.off ../box.off --output s.what", {"s.what"});
  ExpectRefused("minkowski ../box.off",
                {"expected B, found none (see phongpd minkowski --help)"});
}

}  // namespace
}  // namespace phongpd
