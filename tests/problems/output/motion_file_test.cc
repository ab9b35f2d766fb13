// SPDX-License-Identifier: GPL-3.0-or-later
// Motions as machines read them, read back.  Truth: the curve itself, and the
// exact judge of the lines as they are written.
#include "problems/output/motion_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// From (-2, 0, 0) over a cube of half 1 to (2, 0, 0), with a rest on the way.
Trajectory OverTheCube() {
  const Vector3d top(0, 0, 1.5);
  return Trajectory(
      {CurvePiece({{-2, 0, 0}, {-2, 0, 0}, {-2, 0, 2}, {-1, 0, 2}, top, top},
                  1.5),
       CurvePiece(top, top, 0.4),
       CurvePiece({top, top, {1, 0, 2}, {2, 0, 2}, {2, 0, 0}, {2, 0, 0}},
                  2.25)});
}

FreeSpace AroundTheCube() {
  return FreeSpace({TakeAsContactSpace(MakeBox({-1, -1, -1}, {1, 1, 1}))});
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The numbers in a text.
std::vector<double> Numbers(const std::string& text) {
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
  std::vector<double> found;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end;
       ++i) {
    found.push_back(ParseDouble(i->str(), "a number"));
  }
  return found;
}

TEST(RosTrajectory, HasTheSamplesInMetres) {
  const Trajectory curve = OverTheCube();
  for (const std::string unit : {"mm", "m", "in"}) {
    const double metres = unit == "mm" ? 1e-3 : unit == "m" ? 1.0 : 0.0254;
    const auto lines = Lines(RosTrajectory(curve, 3.0, unit));
    const auto samples = curve.Samples(3.0);
    EXPECT_EQ(lines.at(1), "joint_names: [x, y, z]");
    EXPECT_EQ(lines.at(2), "points:");
    ASSERT_EQ(lines.size(), 3 + 4 * samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::string* const at = &lines[3 + 4 * i];
      const auto expect = [&](const std::string& line, const std::string& name,
                              const Vector3d& value) {
        EXPECT_EQ(line.find(name + ": ["), 2U) << line;
        const std::vector<double> told = Numbers(line);
        ASSERT_EQ(told.size(), 3U) << line;
        for (int k = 0; k < 3; ++k) {
          EXPECT_DOUBLE_EQ(told[static_cast<std::size_t>(k)],
                           metres * value[k]);
        }
      };
      EXPECT_EQ(at[0][0], '-');
      expect(at[0], "positions", samples[i].position);
      expect(at[1], "velocities", samples[i].velocity);
      expect(at[2], "accelerations", samples[i].acceleration);
      const std::vector<double> time = Numbers(at[3]);
      ASSERT_EQ(time.size(), 2U) << at[3];
      EXPECT_LT(time[1], 1e9);
      EXPECT_NEAR(time[0] + 1e-9 * time[1], samples[i].time, 1e-9);
    }
  }
  EXPECT_EQ(Lines(RosTrajectory({}, 100.0, "mm")).back(), "points: []");
}

TEST(MotionGcode, StaysBesideTheCurveFreeAndInTime) {
  const Trajectory curve = OverTheCube();
  const FreeSpace space = AroundTheCube();
  for (const auto& [unit, mm] :
       {std::pair("mm", 1.0), {"m", 1e3}, {"um", 1e-3}}) {
    const auto lines = Lines(MotionGcode(space, curve, unit));
    Vector3d at(-2 * mm, 0, 0);
    std::vector<Vector3d> path = {at / mm};
    double seconds = 0.0, rest = 0.0, farthest = 0.0;
    for (const std::string& line : lines) {
      const std::string code = line.substr(0, 2);
      const std::vector<double> n = Numbers(line);
      if (code == "G4") rest += n.at(1);
      if (code != "G1") continue;
      const Vector3d next(n.at(1), n.at(2), n.at(3));
      seconds += 60.0 * (next - at).norm() / n.at(4);
      at = next;
      path.push_back(at / mm);
      // At that time the curve is there.
      farthest = std::max(
          farthest, mm * (curve.At(seconds + rest).position - at / mm).norm());
    }
    // Less than 10 nm at its ends is a rest as well.
    EXPECT_GE(rest, 0.4 - 1e-12) << unit;
    EXPECT_LE(rest, mm < 1.0 ? 0.45 : 0.4 + 1e-12) << unit;
    EXPECT_NEAR(seconds + rest, curve.duration(), 1e-3) << unit;
    EXPECT_EQ(path.back(), Vector3d(2, 0, 0));
    EXPECT_TRUE(CheckPath(space, path).free) << unit;
    // The times of feeds of five digits.
    EXPECT_LT(farthest, 0.01 + 0.01 * mm) << unit;
    // The way: every point of the curve is close to a line.
    double gap = 0.0;
    for (const Trajectory::Sample& sample : curve.Samples(500.0)) {
      double least = 1e300;
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const Vector3d way = path[i + 1] - path[i];
        const double s = std::clamp(
            (sample.position - path[i]).dot(way) / way.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (path[i] + s * way - sample.position).norm());
      }
      gap = std::max(gap, least);
    }
    EXPECT_LT(mm * gap, 0.01 + 1e-5) << unit;
  }
}

// Around an edge, 0.3 um from it: lines within the usual tolerance cut it.
TEST(MotionGcode, IsAsFineAsFreeLinesTake) {
  const FreeSpace space = AroundTheCube();
  // There at s = 1/3, no end of halves.
  const double near = 9.0 * (1.0 + 2e-4);
  const Trajectory curve({CurvePiece(
      {{0, 0, 1.5}, {0.25 * (near - 1.5), 0, 0.25 * (near - 6)}, {1.5, 0, 0}},
      0.2)});
  ASSERT_NEAR(space.Clearance(curve.At(0.2 / 3.0).position),
              2e-4 * std::sqrt(2.0), 1e-9);
  const auto lines = Lines(MotionGcode(space, curve, "mm"));
  const std::vector<double> told = Numbers(lines.at(0));
  EXPECT_LT(told.at(2), 0.01) << lines.at(0);
  std::vector<Vector3d> path = {{0, 0, 1.5}};
  for (const std::string& line : lines) {
    const std::vector<double> n = Numbers(line);
    if (line.rfind("G1", 0) == 0) path.emplace_back(n[1], n[2], n[3]);
  }
  EXPECT_TRUE(CheckPath(space, path).free);
}

TEST(MotionGcode, RefusesWhatHasNoMillimetres) {
  const FreeSpace space = AroundTheCube();
  testing::ExpectRefused([&] { MotionGcode(space, OverTheCube(), ""); },
                         "G-code: expected a scene with a \"unit\"");
  testing::ExpectRefused([&] { RosTrajectory(OverTheCube(), 100.0, ""); },
                         "ROS: expected a scene with a \"unit\"");
  // On the cube: no line beside it is free.
  const Trajectory touching(
      {CurvePiece(Vector3d(-2, 0, 1), Vector3d(2, 0, 1), 1.0)});
  testing::ExpectRefused([&] { MotionGcode(space, touching, "mm"); },
                         "closer to contact");
  EXPECT_EQ(MotionGcode(space, {}, "mm"), "; no motion\n");
  // So far away that a hundredth of a millimetre is nothing.
  const Vector3d far(1e20, 3e20, 7e20);
  const Trajectory away(
      {CurvePiece({far, 1.1 * far, {2e20, 0, 0}, {0, 2e20, 1e20}}, 1.0)});
  testing::ExpectRefused([&] { MotionGcode(space, away, "mm"); },
                         "tell 0.01 mm apart");
}

}  // namespace
}  // namespace phongpd
