// SPDX-License-Identifier: GPL-3.0-or-later
// Repair and approximation through the phongpd program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

class CliKnobs : public Cli {
 protected:
  // Runs contact-space, which must succeed, and returns its report.
  nlohmann::json Report(const std::string& robot, const std::string& obstacle,
                        const std::string& flags) {
    const Outcome outcome =
        Run("contact-space --robot ../" + robot + " --obstacle ../" + obstacle +
            " --output c.off --report r.json " + flags);
    EXPECT_EQ(outcome.code, 0) << flags << '\n' << outcome.err;
    err_ = outcome.err;
    const auto report = nlohmann::json::parse(Content(Output("r.json")));
    EXPECT_EQ(report["closed"], true);
    EXPECT_EQ(report["manifold"], true);
    EXPECT_GT(report["volume"], 0.0);
    return report;
  }

  std::string err_;
};

TEST_F(CliKnobs, EveryKnobSaysItsKindAndBound) {
  WriteMesh(MakeStar(0.3, 0.6), File("star.off"));
  WriteMesh(MakeVessel(4, 3, 0), File("vessel.off"));
  const auto exact = Report("star.off", "vessel.off", "");
  EXPECT_EQ(exact["approximation"]["kind"], "none");
  EXPECT_EQ(exact["approximation"]["bound"], 0.0);
  EXPECT_EQ(exact["cavities"], 1);
  EXPECT_TRUE(err_.empty()) << err_;

  const auto hull = Report("star.off", "vessel.off", "--robot-hull");
  EXPECT_EQ(hull["approximation"]["kind"], "robot-hull");
  EXPECT_GT(hull["approximation"]["bound"], 0.0);
  EXPECT_EQ(hull["approximation"]["conservative"], true);
  EXPECT_GT(hull["volume"], exact["volume"]);
  EXPECT_NE(err_.find("star.off: replaced by its convex hull"),
            std::string::npos);

  const auto coarse = Report("star.off", "box.off", "--target-faces 20");
  EXPECT_EQ(coarse["approximation"]["kind"], "decimation");
  EXPECT_EQ(coarse["approximation"]["conservative"], false);

  const auto wrap = Report("star.off", "vessel.off", "--wrap 0.2");
  EXPECT_EQ(wrap["approximation"]["kind"], "alpha-wrap");
  EXPECT_GE(wrap["approximation"]["bound"], 1.5);
  EXPECT_EQ(wrap["cavities"], 0);

  const auto shell = Report("star.off", "vessel.off", "--outer-shell-only");
  EXPECT_EQ(shell["approximation"]["kind"], "outer-shell");
  EXPECT_EQ(shell["approximation"]["bound"], 0.0);
  EXPECT_EQ(shell["approximation"]["steps"][0]["dropped_cavities"], 1);
}

TEST_F(CliKnobs, RepairsAreCountedAndSaid) {
  TriangleMesh doubled = Joined(MakeBox({-1, -1, -1}, {1, 1, 1}),
                                MakeBox({-1, -1, -1}, {1, 1, 1}));
  std::swap(doubled.triangles[5][0], doubled.triangles[5][1]);
  WriteMesh(doubled, File("doubled.off"));
  const auto report = Report("cone.off", "doubled.off", "--repair safe");
  EXPECT_EQ(report["obstacle"]["repair"]["duplicate_faces"], 12);
  EXPECT_EQ(report["approximation"]["kind"], "none");
  EXPECT_NE(err_.find("doubled.off: 12 duplicate faces removed"),
            std::string::npos);
  EXPECT_EQ(report["volume"], Report("cone.off", "box.off", "")["volume"]);
}

TEST_F(CliKnobs, WrapsWhatIsNoSolid) {
  WriteText("sheet.off",
            "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
            "3 0 1 2\n3 0 2 3\n");
  WriteText("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  TriangleMesh crossing = MakeIcoBall(1.0, 1);
  crossing.vertices[0] *= -2.0;
  WriteMesh(crossing, File("crossing.off"));
  for (const std::string bad : {"sheet.off", "one.off", "crossing.off"}) {
    for (const std::string repair : {"reject", "safe"}) {
      ExpectRefused("contact-space --robot ../" + bad +
                        " --obstacle ../box.off --output c.off --report r.json "
                        "--repair " +
                        repair,
                    {bad});
    }
    const auto report = Report(bad, "box.off", "--repair wrap --wrap 0.2");
    EXPECT_EQ(report["robot"]["repair"]["wrapped"], true);
    EXPECT_EQ(report["approximation"]["kind"], "alpha-wrap");
    EXPECT_EQ(report["approximation"]["steps"][0]["bound_of"], "surface");
    EXPECT_NE(err_.find(bad + ": wrapped"), std::string::npos) << err_;
    std::filesystem::remove(Output("c.off"));
    std::filesystem::remove(Output("r.json"));
  }
}

TEST_F(CliKnobs, OperandsAMillionTimesApartAreReported) {
  WriteMesh(Scaled(MakeIcoBall(1.0, 3), 1e-6), File("tiny.off"));
  const auto report = Report("tiny.off", "box.off", "");
  EXPECT_NE(err_.find("tiny.off: coordinates are rounded to"),
            std::string::npos);
  EXPECT_EQ(report["warnings"].size(), 1U);
}

TEST_F(CliKnobs, NonsenseIsRefusedInOneLine) {
  const std::string build =
      "contact-space --robot ../box.off --obstacle ../box.off --output c.off ";
  ExpectRefused(build + "--target-faces 3", {"--target-faces", "3"});
  ExpectRefused(build + "--target-faces 10.5", {"--target-faces", "10.5"});
  ExpectRefused(build + "--target-faces -4", {"--target-faces"});
  ExpectRefused(build + "--wrap 0.0001", {"wrap", "0.0001"});
  ExpectRefused(build + "--wrap 2", {"wrap", "2"});
  ExpectRefused(build + "--wrap -1", {"wrap", "-1"});
  ExpectRefused(build + "--wrap nan", {"--wrap"});
  ExpectRefused(build + "--repair magic", {"--repair", "magic"});
}

}  // namespace
}  // namespace phongpd
