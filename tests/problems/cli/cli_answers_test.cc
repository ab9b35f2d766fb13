// SPDX-License-Identifier: GPL-3.0-or-later
// Every command answers on standard output, as JSON when asked, with words
// apart from data.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/scenes/scene_library.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Json = nlohmann::json;

class CliAnswers : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    WriteText("p.csv", "x,y,z\n0.3,0,0\n0,0,9\n");
  }
  // Data that is all there is on standard output, and no file.
  std::vector<Json> Rows(const std::string& arguments, int code = 0) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.code, code) << arguments << '\n' << outcome.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "run")) << arguments;
    err_ = outcome.err;
    std::vector<Json> rows;
    for (const std::string& line : Split(outcome.out, '\n')) {
      rows.push_back(Json::parse(line, nullptr, false));
      EXPECT_FALSE(rows.back().is_discarded()) << line;
    }
    return rows;
  }
  Json Document(const std::string& arguments) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << '\n' << outcome.err;
    const Json json = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << outcome.out;
    return json;
  }

  std::string err_;
};

TEST_F(CliAnswers, QueryAndMotionAnswerAsTheyWriteFiles) {
  const std::string query =
      "query --contact-space ../box.off --points ../p.csv";
  ASSERT_EQ(Run(query + " --output ../q.csv").code, 0);
  for (const std::string end : {"", " --output -", " --output /dev/stdout"}) {
    const Outcome outcome = Run(query + end);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out, Content(File("q.csv"))) << end;
    EXPECT_NE(outcome.err.find("2 points, 1 inside, 0 with another status"),
              std::string::npos)
        << outcome.err;
  }
  const std::vector<Json> rows = Rows(query + " --json");
  ASSERT_EQ(rows.size(), 2U);
  const std::vector<std::string> cells =
      Split(Split(Content(File("q.csv")), '\n')[1], ',');
  EXPECT_EQ(rows[0]["status"], cells[3]);
  EXPECT_EQ(rows[0]["inside"], true);
  EXPECT_EQ(rows[0]["signed_distance"].get<double>(), Number(cells[5]));
  EXPECT_EQ(rows[0]["contact"][0].get<double>(), Number(cells[6]));
  EXPECT_EQ(rows[0]["gradient"][0].get<double>(), Number(cells[12]));
  EXPECT_EQ(std::to_string(rows[0]["triangle"].get<int>()), cells[15]);
  EXPECT_EQ(rows[1]["inside"], false);

  const std::string motion =
      "motion --robot ../cone.off --obstacle ../box.off --from -3 0 0.1 --to 3 "
      "0 0.1 --frames 5";
  ASSERT_EQ(Run(motion + " --output ../m.csv").code, 0);
  const Outcome outcome = Run(motion);
  EXPECT_EQ(outcome.out, Content(File("m.csv")));
  EXPECT_NE(outcome.err.find("euclidean: "), std::string::npos);
  const std::vector<Json> frames = Rows(motion + " --json");
  ASSERT_EQ(frames.size(), 15U);
  EXPECT_EQ(frames[7]["frame"], 2);
  EXPECT_EQ(frames[7]["metric"], "phong");
  EXPECT_EQ(frames[7]["position"], Json({0.0, 0.0, 0.1}));
  const std::vector<std::string> frame =
      Split(Split(Content(File("m.csv")), '\n')[8], ',');
  EXPECT_EQ(frames[7]["status"], frame[2]);
  EXPECT_EQ(frames[7]["magnitude"].get<double>(), Number(frame[6]));
}

// Whatever is asked for, and whether --json is there or not.
TEST_F(CliAnswers, FilesHoldWhatTheirNamesSay) {
  WriteText("poses.csv", "x,y,z,qw,qx,qy,qz\n0.3,0,0,1,0,0,0\n9,0,0,1,0,0,0\n");
  const std::string depth = "depth ../cone.off ../box.off";
  for (const std::string& command :
       {depth, depth + " --at 0.3 0 0", depth + " --smoothing-length 0",
        depth + " --pose ../poses.csv",
        std::string("query --contact-space ../box.off --points ../p.csv"),
        std::string("motion --robot ../cone.off --obstacle ../box.off --from "
                    "-3 0 0.1 --to 3 0 0.1 --frames 5")}) {
    const std::vector<Json> rows = Rows(command + " --json");
    for (const std::string name : {"t.csv", "t.CSV"}) {
      ASSERT_EQ(Run(command + " --output " + name).code, 0) << command;
      const std::vector<std::string> lines = Split(Content(Output(name)), '\n');
      ASSERT_EQ(lines.size(), rows.size() + 1) << command << name;
      const std::vector<std::string> header = Split(lines[0], ',');
      const auto status = std::find(header.begin(), header.end(), "status");
      ASSERT_NE(status, header.end()) << lines[0];
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::vector<std::string> cells = Split(lines[i + 1], ',');
        ASSERT_EQ(cells.size(), header.size()) << command;
        EXPECT_EQ(rows[i]["status"],
                  cells[static_cast<std::size_t>(status - header.begin())]);
      }
      std::filesystem::remove(Output(name));
    }
    for (const std::string name : {"t.json", "t.jsonl", "t.JSON"}) {
      for (const char* flag : {"", " --json"}) {
        ASSERT_EQ(Run(command + " --output " + name + flag).code, 0);
        std::vector<Json> found;
        for (const std::string& line : Split(Content(Output(name)), '\n')) {
          found.push_back(Json::parse(line, nullptr, false));
          ASSERT_FALSE(found.back().is_discarded()) << command << name;
        }
        ASSERT_EQ(found.size(), rows.size()) << command << name;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          EXPECT_EQ(found[i]["status"], rows[i]["status"]);
          EXPECT_EQ(found[i].size(), rows[i].size());
        }
        std::filesystem::remove(Output(name));
      }
    }
    ExpectRefused(command + " --json --output t.csv",
                  {"--json", "FILE.json", "t.csv"});
  }
  // Another name says nothing.
  ASSERT_EQ(Run(depth + " --output t.txt").code, 0);
  EXPECT_EQ(Content(Output("t.txt")).rfind("penetrating: depth ", 0), 0U);
}

TEST_F(CliAnswers, ContactSpacesAreToldWithoutAFileAndMeshesGoToPipes) {
  for (const std::string command :
       {"contact-space --robot ../cone.off --obstacle ../box.off",
        "minkowski --difference ../cone.off ../box.off"}) {
    const Outcome told = Run(command);
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_NE(told.out.find(" triangles, "), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("1 component, genus 0, 0 cavities"),
              std::string::npos)
        << told.out;
    const Json report = Document(command + " --json");
    EXPECT_EQ(report["genus"], 0);
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "run"));
    const Outcome piped = Run(command + " --output -");
    WriteText("piped.off", piped.out);
    EXPECT_EQ(ReadMesh(File("piped.off")).triangles.size(),
              report["triangles"].get<std::size_t>());
    EXPECT_NE(piped.err.find(" triangles, "), std::string::npos);
    ExpectRefused(command + " --json --output -",
                  {"--json", "standard output"});
    ExpectRefused(command + " --report r.txt", {"--report", ".json", "r.txt"});
  }
}

TEST_F(CliAnswers, RunsAreRowsOnStandardOutputWithJson) {
  for (const std::string command :
       {"plan tunnel:delta=0.1", "optimize u_axis --start straight"}) {
    const Outcome told = Run(command);
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_EQ(told.out.rfind("scene, ", 0), 0U) << told.out;
    const std::vector<Json> rows = Rows(command + " --runs 2 --json");
    ASSERT_EQ(rows.size(), 2U) << command;
    EXPECT_EQ(rows[0]["collision_free"], true);
    EXPECT_EQ(rows[1]["seed"].get<int>(), rows[0]["seed"].get<int>() + 1);
    EXPECT_EQ(err_.rfind("scene, ", 0), 0U) << err_;
  }
  ExpectRefused("plan tunnel:delta=0.1 --svg p.png",
                {"--svg", "ends in .svg", "p.png"});
  ExpectRefused("optimize u_axis --html p.svg", {"--html", "p.svg"});
  const std::vector<Json> compared = Rows(
      "compare u_axis --runs 1 --protocols pipeline --metrics euclidean "
      "--json");
  ASSERT_EQ(compared.size(), 1U);
  EXPECT_EQ(compared[0]["protocol"], "pipeline");
  EXPECT_NE(err_.find("solved of runs"), std::string::npos) << err_;
  ExpectRefused("compare u_axis --shard 0/2", {"--shard", "--output DIR"});
}

TEST_F(CliAnswers, ScenesAreJsonOnStandardOutput) {
  const Json list = Document("scenes list --json");
  ASSERT_EQ(list["families"].size(), SceneFamilies().size());
  EXPECT_EQ(list["families"][0]["name"], SceneFamilies()[0].name);
  EXPECT_FALSE(list["common_knobs"].empty());
  EXPECT_EQ(Document("scenes write u_trap")["name"], "u_trap");
  const Json told = Document("scenes write u_trap --meshes m --json");
  EXPECT_EQ(told["robot_triangles"].get<std::size_t>(),
            ReadMesh(Output("m/robot.off")).triangles.size());
}

TEST_F(CliAnswers, ViewsAndReproductionsTellWhatTheyHold) {
  const Json view = Document("view ../box.off --html v.html --json");
  EXPECT_EQ(view["page"], "v.html");
  EXPECT_EQ(view["meshes"][0]["triangles"], 12);
  ASSERT_EQ(Run("query --contact-space ../box.off --points ../p.csv --json "
                "--output ../q.jsonl")
                .code,
            0);
  EXPECT_EQ(Document("view ../q.jsonl --html v.html --json")["answers"], 2);
  const Outcome packed = Run("reproduce -- depth ../box.off ../cone.off");
  ASSERT_EQ(packed.code, 0) << packed.err;
  WriteText("report.json", packed.out);
  EXPECT_EQ(Json::parse(packed.out)["files"].size(), 2U);
  const Json replayed = Document("reproduce --replay ../report.json --json");
  EXPECT_EQ(replayed["same"], true);
  EXPECT_EQ(replayed["now"]["exit_code"], 0);
}

TEST_F(CliAnswers, RangesAreToldInWords) {
  const std::string depth = "depth ../box.off ../cone.off ";
  ExpectRefused(depth + "--max-seconds -1",
                {"--max-seconds: expected a number >= 0 of seconds"});
  ExpectRefused("plan u_axis --max-mib nan", {"--max-mib", "found nan"});
  ExpectRefused("plan u_axis --seed -2", {"--seed: expected a number >= 0"});
  ExpectRefused(
      "query --contact-space ../box.off --points ../p.csv --metric "
      "sliding --tracked --slide-ratio 1e9",
      {"expected a number from 1 to 1e+06, found 1e9"});
}

// It is a matter of the length and of the file.
TEST_F(CliAnswers, ContactSpacesThatAFieldCannotBeSplitForAreNamed) {
  ExpectRefused(
      "query --contact-space ../box.off --points ../p.csv --smoothing-length "
      "1e-6",
      {"box.off: Phong field: smoothing_length: expected at least"});
}

TEST_F(CliAnswers, SizesOfDifferentUnitsAreSuspected) {
  WriteMesh(Scaled(MakeBox({-1, -1, -1}, {1, 1, 1}), 1000.0), File("mm.off"));
  const std::string words = "is one in metres and the other in millimetres?";
  WriteText("scene.json",
            R"({"robot": {"mesh": "box.off"}, "obstacles": [{"id": "wall",
                "mesh": "mm.off"}], "start": [9000, 0, 0],
                "goal": [0, 9000, 0]})");
  for (const std::string command :
       {"depth ../box.off ../mm.off", "minkowski ../mm.off ../box.off",
        "contact-space --robot ../box.off --obstacle ../mm.off",
        "motion --robot ../box.off --obstacle ../mm.off --from 0 0 0 --to 1 0 "
        "0 --frames 2",
        "plan ../scene.json"}) {
    const Outcome outcome = Run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(Run("depth ../box.off ../cone.off").err.find(words),
            std::string::npos);
}

}  // namespace
}  // namespace phongpd
