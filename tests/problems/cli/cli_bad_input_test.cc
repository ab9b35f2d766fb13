// SPDX-License-Identifier: GPL-3.0-or-later
// Bad input ends with exit code 2, one line that names the file, and nothing
// written.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "core/solid/mesh_check.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

TEST_F(Cli, RefusesMissingAndUnreadableMeshes) {
  ExpectMeshRefused("missing.off", {});
  WriteText("garbage.off", "this is no mesh\n");
  ExpectMeshRefused("garbage.off", {});
  WriteText("cut.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1");
  ExpectMeshRefused("cut.off", {});
  WriteText("mesh.xyz", "0 0 0\n");
  ExpectMeshRefused("mesh.xyz", {});
  WriteText("empty.off", "");
  ExpectMeshRefused("empty.off", {});
  WriteText("none.off", "OFF\n0 0 0\n");
  ExpectMeshRefused("none.off", {});
}

TEST_F(Cli, RefusesSavedContactSpacesThatAreNot) {
  WriteText("p.csv", "x,y,z\n0.3,0,0\n");
  ASSERT_EQ(Run("contact-space --robot ../cone.off --obstacle ../box.off "
                "--output ../c.pcs")
                .code,
            0);
  const std::string good = Content(File("c.pcs"));
  const std::string rest = " --points ../p.csv --output o.csv";
  WriteText("cut.pcs", good.substr(0, good.size() / 2));
  ExpectRefused("query --contact-space ../cut.pcs" + rest,
                {"cut.pcs", "cut off"});
  std::string bad = good;
  bad.back() = static_cast<char>(bad.back() ^ 1);
  WriteText("bad.pcs", bad);
  ExpectRefused("query --contact-space ../bad.pcs" + rest,
                {"bad.pcs", "damaged"});
  WriteText("mesh.pcs", Content(File("box.off")));
  ExpectRefused("query --contact-space ../mesh.pcs" + rest,
                {"mesh.pcs", "another beginning"});
  // A sum is no contact space.
  ExpectRefused("minkowski ../cone.off ../box.off --output s.pcs", {"s.pcs"});
}

TEST_F(Cli, RefusesCoordinatesThatAreNoNumbers) {
  for (const std::string value : {"nan", "inf", "-inf", "1e999"}) {
    WriteText("bad.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 " + value +
                             "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    ExpectMeshRefused("bad.off", {});
  }
}

TEST_F(Cli, RefusesOpenMeshesWithTheNumberOfEdges) {
  TriangleMesh mesh = MakeBox({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.pop_back();
  ASSERT_EQ(ExamineMesh(mesh).boundary_edges, 3U);
  WriteMesh(mesh, File("open.off"));
  ExpectMeshRefused("open.off", {"3", "edges"});
}

TEST_F(Cli, RefusesNonManifoldMeshesWithTheNumberOfEdges) {
  // Two boxes that share one edge: its two vertices are the same.
  WriteText("edge.off",
            "OFF\n6 8 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n"
            "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
            "3 0 4 1\n3 0 1 5\n3 0 5 4\n3 1 4 5\n");
  const TriangleMesh mesh = ReadMesh(File("edge.off"));
  const std::size_t edges = ExamineMesh(mesh).non_manifold_edges;
  ASSERT_EQ(edges, 1U);
  ExpectMeshRefused("edge.off", {"1", "edge"});
}

TEST_F(Cli, RefusesSelfIntersectingMeshesWithTheNumberOfPairs) {
  // A ball with one vertex pulled through the opposite side.
  TriangleMesh mesh = MakeIcoBall(1.0, 1);
  mesh.vertices[0] *= -2.0;
  const std::size_t pairs = ExamineMesh(mesh).self_intersections;
  ASSERT_GT(pairs, 0U);
  WriteMesh(mesh, File("crossing.off"));
  ExpectMeshRefused("crossing.off", {std::to_string(pairs)});
}

TEST_F(Cli, RefusesMeshesWithoutAnyArea) {
  WriteText("flat.off",
            "OFF\n4 4 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n"
            "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  ExpectMeshRefused("flat.off", {"4"});
}

TEST_F(Cli, TurnsMeshesThatAreInsideOutAndSaysSo) {
  TriangleMesh mesh = MakeCone(0.8, 1.6, 8);
  for (Triangle& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  WriteMesh(mesh, File("turned.off"));
  const std::string rest = " --obstacle ../box.off --report r.json --output ";
  const Outcome plain =
      Run("contact-space --robot ../cone.off" + rest + "c.off");
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_TRUE(plain.err.empty()) << plain.err;
  const auto volume =
      nlohmann::json::parse(Content(Output("r.json")))["volume"];
  const Outcome turned =
      Run("contact-space --robot ../turned.off" + rest + "d.off");
  EXPECT_EQ(turned.code, 0) << turned.err;
  EXPECT_NE(turned.err.find("turned.off"), std::string::npos) << turned.err;
  const auto report = nlohmann::json::parse(Content(Output("r.json")));
  EXPECT_EQ(report["volume"], volume);
  EXPECT_EQ(report["robot"]["inverted_components"], 1);
}

TEST_F(Cli, RefusesBadArgumentsInOneLine) {
  ExpectRefused("", {});
  ExpectRefused("fly", {"fly"});
  ExpectRefused("query", {"--contact-space"});
  ExpectRefused(
      "contact-space --robot ../box.off --obstacle ../box.off "
      "--output c.off --robot-hulls",
      {"--robot-hulls"});
  ExpectRefused(
      "contact-space --robot ../box.off --obstacle ../box.off "
      "--output c.xyz",
      {"c.xyz"});
  ExpectRefused(
      "contact-space --robot ../box.off --obstacle ../box.off "
      "--output nowhere/c.off",
      {"nowhere"});
  const std::string motion =
      "motion --robot ../box.off --obstacle ../box.off --output m.csv ";
  ExpectRefused(motion + "--from 0 0 nan --to 1 0 0 --frames 5", {"--from"});
  ExpectRefused(motion + "--from 0 0 0 --to 1 0 --frames 5", {"--to"});
  ExpectRefused(motion + "--from 0 0 0 --to 1 0 0 --frames 1", {"--frames"});
  ExpectRefused(motion +
                    "--from 0 0 0 --to 1 0 0 --frames 5 "
                    "--smoothing-length 2",
                {"smoothing", "2"});
  ExpectRefused(motion +
                    "--from 0 0 0 --to 1 0 0 --frames 5 "
                    "--smoothing-length 1km",
                {"--smoothing-length: expected a length >= 0", "'1km'"});
  ExpectRefused(motion +
                    "--from 0 0 0 --to 1 0 0 --frames 5 "
                    "--smoothing-length 1e6unit",
                {"--smoothing-length: expected at most", "found 1e+06unit"});
  ExpectRefused(
      "motion --robot ../box.off --from 0 0 0 --to 1 0 0 "
      "--frames 5 --output m.csv",
      {"--obstacle"});
  ExpectRefused("scenes write nothing --output s.json", {"nothing"});
  ExpectRefused("scenes write u_trap --set wall --output s.json", {"wall"});
  ExpectRefused("scenes write u_trap --set bar=1 --output s.json", {"bar"});
  ExpectRefused("scenes write u_trap --set wall=9 --output s.json", {"wall"});
}

TEST_F(Cli, RefusesPointFilesWithLineAndColumn) {
  const std::string query =
      "query --contact-space ../box.off --output o.csv --points ../";
  ExpectRefused(query + "missing.csv", {"missing.csv"});
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "empty"},
      {"x,y\n1,2\n", ":1"},
      {"x,y,z\n1,2,3\n1,2\n", ":3"},
      {"x,y,z\n1,2,3\n\n1,nan,3\n", ":4: column y"},
      {"x,y,z\n1,2,inf\n", ":2: column z"},
      {"x,y,z\n1e999,2,3\n", ":2: column x"},
      {"x,y,z\none,2,3\n", ":2: column x"},
      {"x,y,z\n1,2,3 4\n", ":2: column z"},
      {"x,y,z\n1,,3\n", ":2: column y"}};
  for (const auto& [text, word] : cases) {
    WriteText("bad.csv", text);
    ExpectRefused(query + "bad.csv", {"bad.csv", word});
  }
}

TEST_F(Cli, RefusesSlidingFlagsThatMakeNoSense) {
  WriteText("p.csv", "x,y,z\n0,0,0\n");
  const std::string query =
      "query --contact-space ../box.off --points ../p.csv --output o.csv ";
  ExpectRefused(query + "--metric sliding", {"--metric sliding", "--tracked"});
  ExpectRefused(query + "--slide-ratio 2", {"--slide-ratio", "phong"});
  ExpectRefused(query + "--metric euclidean --slide-speed 2",
                {"--slide-speed", "euclidean"});
  const std::string sliding = query + "--metric sliding --tracked ";
  ExpectRefused(sliding + "--slide-ratio 0.9", {"--slide-ratio", "0.9"});
  ExpectRefused(sliding + "--slide-speed 0", {"--slide-speed", "0"});
  ExpectRefused(sliding + "--slide-speed nan", {"--slide-speed", "found nan"});
}

TEST_F(Cli, RefusesContactSpacesThatAreNone) {
  WriteText("p.csv", "x,y,z\n0,0,0\n");
  TriangleMesh mesh = MakeBox({-1, -1, -1}, {1, 1, 1});
  for (Triangle& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  WriteMesh(mesh, File("turned.off"));
  mesh.triangles.pop_back();
  WriteMesh(mesh, File("open.off"));
  const std::string rest = " --points ../p.csv --output o.csv";
  ExpectRefused("query --contact-space ../turned.off" + rest, {"turned.off"});
  ExpectRefused("query --contact-space ../open.off" + rest, {"open.off", "3"});
  ExpectRefused("query --contact-space ../none.off" + rest, {"none.off"});
}

TEST_F(Cli, RefusesFilesThatClaimMoreThanTheyHold) {
  std::filesystem::copy(PHONGPD_TEST_DATA "/faults/list_count.ply",
                        File("list_count.ply"));
  ExpectMeshRefused("list_count.ply", {"declares 2000000000 values"});
}

TEST_F(Cli, RefusesSizesBeyondTheRangeByTheirValue) {
  WriteText("p.csv", "x,y,z\n0,0,0\n");
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  WriteMesh(Scaled(box, 2e80), File("far.off"));
  ExpectMeshRefused("far.off", {"at most 1e+80, found 2e+80"});
  ExpectRefused(
      "query --contact-space ../far.off --points ../p.csv --output o.csv",
      {"far.off", "at most 1e+80, found 2e+80"});
}

TEST_F(Cli, ReadsPipesAndRefusesThoseThatNobodyWritesTo) {
  ASSERT_EQ(mkfifo(File("pipe.csv").c_str(), 0600), 0);
  const std::string query = "query --contact-space ../box.off --output o.csv ";
  ExpectRefused(query + "--points ../pipe.csv",
                {"pipe.csv", "a pipe that nobody writes to"});
  ExpectRefused(query + "--points /dev/zero", {"/dev/zero", "a device"});
  WriteText("p.csv", "x,y,z\n0,0,0\n");
  std::thread writer(
      [&] { std::ofstream(File("pipe.csv")) << "x,y,z\n0,0,0\n"; });
  EXPECT_EQ(Run(query + "--points ../pipe.csv").code, 0);
  writer.join();
  EXPECT_EQ(Run(query + "--points /dev/stdin < ../p.csv").code, 0);
}

TEST_F(Cli, KeepsMeshFilesOfScenesBelowTheRoot) {
  std::filesystem::create_directory(folder_ / "scenes");
  WriteText("scenes/scene.json",
            R"({"robot": {"mesh": "../box.off"}, "obstacles": [{"mesh":
                "../box.off"}], "start": [9, 0, 0], "goal": [0, 9, 0]})");
  for (const std::string command :
       {"plan ../scenes/scene.json", "optimize ../scenes/scene.json",
        "compare ../scenes/scene.json"}) {
    ExpectRefused(command + " --output o --root ../scenes",
                  {"/robot/mesh", "below the root ../scenes"});
  }
  EXPECT_EQ(Run("plan ../scenes/scene.json --root .. --output o.jsonl").code,
            0);
}

TEST_F(Cli, AFailedWriteIsBadInputToo) {
  WriteText("p.csv", "x,y,z\n0,0,0\n");
  ExpectRefused(
      "query --contact-space ../box.off --points ../p.csv "
      "--output /dev/full",
      {"/dev/full"});
}

// Names that Linux allows: no UTF-8, two lines, a terminal's escape.
TEST_F(Cli, TakesAndRefusesFilesWhateverTheirNames) {
  for (const std::string odd : {"bad\xff", "two\nlines", "red\x1b[31m"}) {
    const std::string file = "../" + odd + ".off",
                      gone = "../no" + odd + ".off";
    std::filesystem::copy_file(File("box.off"), File(odd + ".off"));
    const auto quoted = [](const std::string& name) {
      return "'" + name + "'";
    };
    for (const std::string command :
         {"check NAME --json", "depth NAME ../cone.off --json",
          "minkowski NAME ../cone.off --json --output ../sum.off",
          "contact-space --robot NAME --obstacle ../cone.off --json --output "
          "../space.off",
          "view NAME --json --html ../page.html"}) {
      const auto with = [&](const std::string& name) {
        std::string text = command;
        return text.replace(text.find("NAME"), 4, quoted(name));
      };
      const Outcome outcome = Run(with(file));
      EXPECT_EQ(outcome.code, 0) << command << '\n' << outcome.err;
      EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << outcome.out;
      ExpectRefused(with(gone), {"expected"});
      EXPECT_EQ(Run(with(gone)).err.find('\x1b'), std::string::npos) << command;
    }
  }
}

}  // namespace
}  // namespace phongpd
