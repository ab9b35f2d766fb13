// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads what optimize --limits wrote, and checks its promises by other code.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/scenes/scene_source.h"
#include "tests/problems/cli/cli_scenes.h"
#include "tests/problems/cli/written_piece.h"

namespace phongpd {

inline std::size_t Occurrences(const std::string& text, const std::string& of) {
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

  static Eigen::Vector3d PointOf(const Json& p) {
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
                         const Eigen::Vector3d& start,
                         const Eigen::Vector3d& goal,
                         const std::array<Eigen::Vector3d, 3>& limits) {
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
    std::array<Eigen::Vector3d, 2> before = {Eigen::Vector3d::Zero(),
                                             Eigen::Vector3d::Zero()};
    Eigen::Vector3d end = start;
    const auto jump = [&](const Piece& piece, double s) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Eigen::Vector3d now = At(piece, static_cast<int>(k) + 1, s);
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
        const Eigen::Vector3d q = PointAt(piece.points, s);
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

  static std::array<Eigen::Vector3d, 3> Same(double v, double a, double j) {
    return {Eigen::Vector3d::Constant(v), Eigen::Vector3d::Constant(a),
            Eigen::Vector3d::Constant(j)};
  }

  // Ends of pieces come as close to the places, one after the other, and where
  // it is to dwell it stands still so long.
  static void ExpectPassed(const Json& row) {
    const std::vector<Piece> pieces = PiecesOf(row);
    std::size_t at = 0;
    for (const Json& via : row.at("via")) {
      const Eigen::Vector3d place = PointOf(via.at("point"));
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
        const bool stands = std::all_of(
            pieces[i].points.begin(), pieces[i].points.end(),
            [&](const Eigen::Vector3d& point) { return point == place; });
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

}  // namespace phongpd
