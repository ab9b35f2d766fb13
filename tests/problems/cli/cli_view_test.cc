// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

class CliView : public CliScenes {
 protected:
  // The data block of a page in run/, which goes.
  Json TakeData(const std::string& name) const {
    const std::string page = Content(Output(name));
    std::filesystem::remove(Output(name));
    const std::string open = "id=\"view-data\">";
    const std::size_t begin = page.find(open) + open.size();
    if (begin < open.size()) {
      ADD_FAILURE() << "no data in " << name;
      return Json::object();
    }
    return Json::parse(
        page.substr(begin, page.find("</script>", begin) - begin));
  }

  // Of `phongpd view THINGS`.
  Json Data(const std::string& things) const {
    const Outcome outcome = Run("view " + things + " --html v.html");
    EXPECT_EQ(outcome.code, 0) << things << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    return TakeData("v.html");
  }

  // Runs a command whose output comes to lie beside run/.
  void Prepare(const std::string& command, const std::string& name) const {
    const Outcome outcome = Run(command + " --output ../" + name);
    ASSERT_LE(outcome.code, 1) << command << outcome.err;
  }

  static std::vector<std::string> Names(const Json& list) {
    std::vector<std::string> names;
    for (const Json& item : list) names.push_back(item.at("name"));
    return names;
  }
};

using Strings = std::vector<std::string>;

TEST_F(CliView, TakesMeshesAndTellsContactSpacesApart) {
  Prepare("contact-space --robot ../cone.off --obstacle ../box.off", "c.off");
  const Json data = Data("../box.off ../cone.off ../c.off --unit mm");
  EXPECT_EQ(Names(data["meshes"]), Strings({"box.off", "cone.off", "c.off"}));
  EXPECT_EQ(data["meshes"][0]["role"], "mesh");
  EXPECT_EQ(data["meshes"][2]["role"], "contact");
  EXPECT_EQ(data["meshes"][0]["triangles"], 12);
  EXPECT_EQ(data["unit"], "mm");
  for (const char* const format : {"obj", "ply", "stl"}) {
    const std::string name = std::string("b.") + format;
    WriteMesh(MakeBox({-1, -1, -1}, {1, 1, 1}), File(name));
    EXPECT_EQ(Names(Data("../" + name)["meshes"]), Strings({name}));
  }
}

TEST_F(CliView, TakesScenesAndBuildsTheirContactSpaceOnRequest) {
  const std::string scene = Scene(TwoObstacles());
  Json data = Data(scene);
  EXPECT_EQ(data["title"], "two");
  EXPECT_EQ(Names(data["meshes"]), Strings({"wall", "post"}));
  EXPECT_EQ(data["robot"]["triangles"], 12);
  EXPECT_EQ(data["start"], Json({-1.5, 0.0, 0.0}));
  data = Data(scene + " --build");
  ASSERT_EQ(data["meshes"].size(), 3U);
  EXPECT_EQ(data["meshes"][2]["role"], "contact");
  EXPECT_EQ(Data("u_axis")["meshes"][0]["triangles"], 28);
}

TEST_F(CliView, PutsRunsAndPlansOfOneSceneBesideEachOther) {
  const std::string scene = Scene(TwoObstacles());
  Prepare("plan " + scene, "plan.jsonl");
  Prepare("optimize " + scene + " --start straight --polish never --runs 2",
          "runs.jsonl");
  const Json data = Data("../plan.jsonl ../runs.jsonl " + scene);
  ASSERT_EQ(data["paths"].size(), 3U);
  EXPECT_EQ(data["paths"][0]["name"], "contact-surface · seed 1 · solved");
  EXPECT_EQ(data["paths"][0]["free"], true);
  std::size_t row = 0;
  for (const std::string& line : Split(Content(File("runs.jsonl")), '\n')) {
    const Json run = Json::parse(line);
    const Json& path = data["paths"][++row];
    EXPECT_EQ(path["points"], run["path"]);
    EXPECT_EQ(path["free"], run["collision_free"]);
    const std::string name = path["name"];
    EXPECT_EQ(name.find("PhongPD, ℓ = 0.2 · seed "), 0U);
    EXPECT_NE(name.find(" · straight start · "), std::string::npos) << name;
  }
  EXPECT_EQ(data["meshes"].size(), 2U);
  // Alone, rows of a file's scene have a path and say what is missing.
  const Json alone = Data("../plan.jsonl");
  EXPECT_TRUE(alone["meshes"].empty());
  EXPECT_EQ(alone["notes"].size(), 2U);
  ExpectRefused("view ../plan.jsonl u_axis --html v.html",
                {"plan.jsonl:1", "u_axis", "two"});
}

// Of a scene, of its rows alone, and of the pages that commands write.
TEST_F(CliView, CallsAUnitOfLengthAsTheSceneDoes) {
  for (const std::string unit : {"", "mm", "in"}) {
    Json json = TwoObstacles();
    if (!unit.empty()) json["unit"] = unit;
    const std::string scene = Scene(json);
    const std::string expected = unit.empty() ? "units" : unit;
    Prepare("plan " + scene + " --html ../p.html", "p.jsonl");
    Prepare("optimize " + scene + " --html ../o.html", "o.jsonl");
    for (const char* page : {"p.html", "o.html"}) {
      std::filesystem::rename(File(page), Output(page));
      EXPECT_EQ(TakeData(page)["unit"], expected) << page;
    }
    for (const std::string& things :
         {scene, std::string("../p.jsonl"), std::string("../o.jsonl"),
          "../p.jsonl " + scene, scene + " --build"}) {
      EXPECT_EQ(Data(things)["unit"], expected) << things;
      EXPECT_EQ(Data(things + " --unit inch")["unit"], "inch") << things;
    }
  }
}

TEST_F(CliView, BringsTheSceneOfAFamilyAlong) {
  Prepare("plan u_axis", "u.jsonl");
  const Json data = Data("../u.jsonl");
  EXPECT_EQ(data["title"], "u_axis");
  EXPECT_EQ(data["meshes"][0]["triangles"], 28);
  EXPECT_EQ(data["start"], data["paths"][0]["points"][0]);
}

// Of one robot that translates, whatever was looked at of it.
TEST_F(CliView, SaysWhatServesASceneThatCanBeSolved) {
  const std::string scene = Scene(TwoObstacles());
  const auto command = [](const Json& data) {
    return data["task"].is_null() ? std::string()
                                  : data["task"].value("command", "");
  };
  EXPECT_EQ(command(Data("u_axis")), "phongpd view u_axis --serve");
  EXPECT_EQ(Data("u_axis")["task"]["served"], false);
  EXPECT_EQ(command(Data("u_axis:ball_radius=0.12 --repair safe")),
            "phongpd view u_axis:ball_radius=0.12 --repair safe --serve");
  std::filesystem::copy_file(File("scene.json"), File("it's a scene.json"));
  EXPECT_EQ(command(Data("\"../it's a scene.json\"")),
            "phongpd view '../it'\\''s a scene.json' --serve");
  for (const std::string name : {"plan", "optimize"}) {
    Prepare(name + " " + scene + " --html ../p.html", "p.jsonl");
    std::filesystem::rename(File("p.html"), Output("p.html"));
    EXPECT_EQ(command(TakeData("p.html")),
              "phongpd view " + scene + " --serve");
  }
  EXPECT_EQ(command(Data("../box.off")), "");
  EXPECT_EQ(command(Data("../p.jsonl")), "") << "rows without their scene";
}

// Rows say that free space alone was modelled; with --build it is shown.
TEST_F(CliView, ShowsWhatPlansInFreeSpaceAloneHadBuilt) {
  const std::string scene = Scene(TwoObstacles());
  const std::pair<const char*, const char*> planners[] = {
      {" --planner rrt-connect", "facets of free space's model"},
      {"", "contact space that was explored"}};
  for (const auto& [planner, name] : planners) {
    const std::string plan = "plan " + scene + " --model window" + planner;
    Prepare(plan, "w.jsonl");
    const Json plain = Data(scene + " ../w.jsonl");
    EXPECT_TRUE(plain["regions"].empty());
    EXPECT_NE(plain["notes"].dump().find("--build shows"), std::string::npos);
    const Json built = Data(scene + " ../w.jsonl --build");
    ASSERT_EQ(built["regions"].size(), 1U);
    EXPECT_EQ(built["meshes"].back()["name"], name);
    EXPECT_EQ(built["notes"].dump().find("--build shows"), std::string::npos);
    // The path lies in the region that was searched.
    for (const Json& q : built["paths"][0]["points"]) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(q[k], built["regions"][0]["min"][k]);
        EXPECT_LE(q[k], built["regions"][0]["max"][k]);
      }
    }
    // The command's own page shows the same.
    ASSERT_EQ(Run(plan + " --html p.html").code, 0);
    const Json page = TakeData("p.html");
    EXPECT_EQ(page["regions"], built["regions"]);
    EXPECT_EQ(page["meshes"].back(), built["meshes"].back());
  }
}

TEST_F(CliView, KeepsTheIterationsOfOneRunForItsPage) {
  const std::string scene = Scene(TwoObstacles());
  Prepare("optimize " + scene, "o.jsonl");
  const Json row = Json::parse(Content(folder_ / "o.jsonl"));
  ASSERT_EQ(Run("optimize " + scene + " --html p.html --output o.jsonl").code,
            0);
  // Nobody sees in the row that there was a page.
  EXPECT_EQ(WithoutSeconds(Json::parse(Content(Output("o.jsonl")))),
            WithoutSeconds(row));
  const Json page = TakeData("p.html");
  ASSERT_EQ(page["iterates"].size(), 1U);
  const Json& iterates = page["iterates"][0];
  EXPECT_EQ(iterates["points"], row["path"].size());
  // A start for each solve, and its iterations.
  EXPECT_GT(iterates["count"], row["iterations"]);
  EXPECT_EQ(iterates["kept"].size(), iterates["count"]);
  ASSERT_EQ(Run("optimize " + scene + " --runs 2 --html p.html").code, 0);
  const Json both = TakeData("p.html");
  EXPECT_TRUE(both["iterates"].empty());
  EXPECT_NE(both["notes"].dump().find("of a single run"), std::string::npos);
}

TEST_F(CliView, DepthShowsItsAnswersWithBothMeshes) {
  WriteText("poses.csv", "x,y,z,qw,qx,qy,qz\n0.5,0,0,1,0,0,0\n7,0,0,1,0,0,0\n");
  Prepare(
      "depth ../cone.off ../box.off --pose ../poses.csv --json --html d.html",
      "d.jsonl");
  const Json page = TakeData("d.html");
  EXPECT_EQ(Names(page["meshes"]), Strings({"../box.off"}));
  EXPECT_EQ(page["meshes"][0]["role"], "obstacle");
  EXPECT_EQ(page["robot"]["triangles"], 14);
  ASSERT_EQ(page["answers"].size(), 2U);
  // The same that view makes of the answers.
  const Json data = Data("../d.jsonl ../box.off --robot ../cone.off");
  EXPECT_EQ(data["answers"], page["answers"]);
  EXPECT_EQ(data["robot"], page["robot"]);
  ExpectRefused("depth ../cone.off ../box.off --html d.png",
                {"--html", ".html", "d.png"});
}

TEST_F(CliView, TakesMotionsWithWhatTheTableDoesNotHold) {
  Prepare(
      "motion --robot ../cone.off --obstacle ../box.off --from -3 0 0.1 "
      "--to 3 0 0 --frames 21 --no-verify --html m.html",
      "m.csv");
  const Json page = TakeData("m.html");
  EXPECT_EQ(page["motion"]["positions"].size(), 21U);
  EXPECT_EQ(page["robot"]["triangles"], 14);
  Json data = Data(
      "../m.csv --robot ../cone.off ../box.off --from -3 0 0.1 "
      "--to 3 0 0");
  EXPECT_EQ(data["motion"]["positions"], page["motion"]["positions"]);
  ASSERT_EQ(Names(data["motion"]["traces"]),
            Strings({"Euclidean PD", "PhongPD", "sliding contact"}));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(data["motion"]["traces"][k]["pd"],
              page["motion"]["traces"][k]["pd"]);
    // The page has the words of the table; sliding has words of its own.
    EXPECT_EQ(data["motion"]["traces"][k]["status"],
              page["motion"]["traces"][k]["status"]);
    EXPECT_EQ(page["motion"]["traces"][k]["status"].size(), 21U);
  }
  EXPECT_TRUE(data["notes"].empty());
  data = Data("../m.csv");
  EXPECT_EQ(data["motion"]["positions"][20], Json({0.0, 0.0, 0.0}));
  EXPECT_EQ(data["notes"].size(), 3U);
  ExpectRefused("view ../m.csv --from 0 0 0 --html v.html", {"--from", "--to"});
}

TEST_F(CliView, TakesDepthsAsTablesAndAsJson) {
  WriteText("p.csv", "x,y,z,qw,qx,qy,qz\n1.5,0,0,1,0,0,0\n9,0,0,0,1,0,0\n");
  const std::string depth = "depth ../cone.off ../box.off --pose ../p.csv";
  Prepare(depth, "d.csv");
  Prepare(depth + " --json", "d.json");
  const std::string rest = " ../box.off --robot ../cone.off";
  const Json table = Data("../d.csv" + rest)["answers"];
  EXPECT_EQ(table, Data("../d.json" + rest)["answers"]);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0]["status"], "penetrating");
  EXPECT_EQ(table[1]["status"], "separate");
  EXPECT_EQ(table[1]["orientation"], Json({0.0, 1.0, 0.0, 0.0}));
  // on_b − on_a is the way out.
  double length = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    length += std::pow(
        table[0]["on_b"][k].get<double>() - table[0]["on_a"][k].get<double>(),
        2);
  }
  EXPECT_NEAR(std::sqrt(length), table[0]["depth"].get<double>(), 1e-9);
}

TEST_F(CliView, TakesAnswersOfQueries) {
  Prepare("contact-space --robot ../cone.off --obstacle ../box.off", "c.off");
  WriteText("p.csv", "x,y,z\n0.1,0,0\n5,0,0\n");
  Prepare("query --contact-space ../c.off --points ../p.csv", "q.csv");
  const Json answers = Data("../q.csv ../c.off")["answers"];
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_GT(answers[0]["depth"], 0.0);
  EXPECT_GT(answers[1]["clearance"], 0.0);
  EXPECT_EQ(answers[1]["on_a"], Json({5.0, 0.0, 0.0}));
}

TEST_F(CliView, WritesGltf) {
  const Outcome outcome = Run("view u_axis --glb u.glb");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(Content(Output("u.glb")).substr(0, 4), "glTF");
}

// No display: nothing is opened.
TEST_F(CliView, WithoutAnOutputTellsWhereThePageIs) {
  std::filesystem::create_directory(File("tmp"));
  const Outcome outcome =
      Run("view ../box.off",
          "env -u DISPLAY -u WAYLAND_DISPLAY TMPDIR='" + File("tmp") + "'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string path = outcome.out.substr(0, outcome.out.find('\n'));
  EXPECT_EQ(path.find(File("tmp")), 0U) << path;
  EXPECT_EQ(path.substr(path.size() - 5), ".html");
  EXPECT_NE(Content(path).find("view-data"), std::string::npos);
}

// Before any work: the thing is not even there.
TEST_F(CliView, SaysWhatAPictureNeeds) {
  const Outcome outcome = Run("view none.off --png p.png", "env PATH=/nowhere");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("install the Debian package chromium"),
            std::string::npos)
      << outcome.err;
}

TEST_F(CliView, RefusesWhatIsNothingToLookAt) {
  const auto refused = [&](const std::string& content, const std::string& name,
                           const std::vector<std::string>& words) {
    WriteText(name, content);
    ExpectRefused("view ../" + name + " --html v.html", words);
  };
  const std::string kinds = "expected a mesh or contact space";
  refused("", "empty.csv", {"empty.csv", kinds, "an empty file"});
  refused("hello\n", "a.txt", {"a.txt", kinds, "a file .txt"});
  refused("a,b\n1,2\n", "t.csv", {"t.csv", kinds});
  refused("{\"triangles\": 3}", "report.json", {"report.json", kinds});
  refused("{\"scene\":\"s\",\"path\":[]}\n", "r.jsonl", {"r.jsonl:1", "row"});
  refused("{\"scene\":\"s\",\"path\":[]}\nx\n", "s.jsonl", {"s.jsonl"});
  refused("frame,metric,status,pd_x,pd_y,pd_z,magnitude\n", "n.csv",
          {"n.csv", "no frame"});
  refused("frame,metric,status,pd_x,pd_y,pd_z,magnitude\n0,a,ok,1,nan,0,1\n",
          "f.csv", {"f.csv:2", "pd_y", "nan"});
  refused(
      "frame,metric,status,pd_x,pd_y,pd_z,magnitude\n0,a,ok,1,0,0,1\n"
      "0,b,ok,1,0,0,1\n1,b,ok,1,0,0,1\n",
      "g.csv", {"g.csv", "1 of a and 2 of b"});
  ExpectRefused("view", {"THING"});
  ExpectRefused("view none.off --html v.html", {"none.off"});
  ExpectRefused("view none --html v.html", {"none"});
  ExpectRefused("view u_axis u_axis --html v.html", {"one scene"});
  ExpectRefused("view u_axis --robot ../cone.off --html v.html", {"--robot"});
  ExpectRefused("view u_axis --html v.png", {"--html", ".html", "v.png"});
  ExpectRefused("view u_axis --glb v.gltf", {"--glb", ".glb"});
  ExpectRefused("view u_axis --png v.svg", {"--png", ".png"});
  ExpectRefused("view none.off --moment 0.5", {"--moment", "--png"});
  ExpectRefused("view u_axis --port 1", {"--port", "--serve"});
  ExpectRefused("view u_axis --time 1", {"--time", "--serve"});
  ExpectRefused("view none.off --png p.png --moment 1.5", {"--moment", "1.5"});
  ExpectRefused("view none.off --png p.png --moment nan", {"--moment", "nan"});
}

}  // namespace
}  // namespace phongpd
