// SPDX-License-Identifier: GPL-3.0-or-later
// Every procedural scene keeps what its file says: start, goal and witness
// are free, the straight line is not, twins have no path.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/contact/contact_space.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/random_solids.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using Knobs = std::map<std::string, double>;
using Path = std::vector<Vector3d>;

const std::vector<std::string> kPlanning = {"gap",     "hole",         "tunnel",
                                            "keyhole", "comb",         "snake",
                                            "bugtrap", "clutter_hole", "maze"};

Scene Made(const std::string& name, const Knobs& knobs) {
  return ParseScene(MakeScene(name, knobs), "scene " + name);
}

std::string Text(const Knobs& knobs) { return Json(knobs).dump(); }

bool InBounds(const Scene& scene, const Vector3d& q) {
  return scene.workspace.bounds.IsEmpty() ||
         ((q.array() >= scene.workspace.bounds.min.array()).all() &&
          (q.array() <= scene.workspace.bounds.max.array()).all());
}

// The number of samples of a polyline that collide or leave the bounds.
int BlockedSamples(const Scene& scene, const CollisionOracle& oracle,
                   const Path& path) {
  constexpr int kSamples = 24;  // a segment
  int blocked = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const Vector3d q = (1.0 - t) * path[i - 1] + t * path[i];
      blocked += !InBounds(scene, q) || oracle.Collides(q);
    }
  }
  return blocked;
}

// 16 pieces of the straight line, so that thin obstacles are met.
Path StraightLine(const Scene& scene) {
  Path line;
  for (int i = 0; i <= 16; ++i) {
    line.push_back(scene.start + i / 16.0 * (scene.goal - scene.start));
  }
  return line;
}

void ExpectSound(const std::string& name, const Knobs& knobs) {
  SCOPED_TRACE(name + " " + Text(knobs));
  const Scene scene = Made(name, knobs);
  EXPECT_TRUE(scene.warnings.empty());
  const CollisionOracle oracle(scene.workspace.robot,
                               JoinedObstacle(scene.workspace));
  EXPECT_GT(BlockedSamples(scene, oracle, StraightLine(scene)), 0);
  ASSERT_EQ(scene.feasible, true);
  ASSERT_GE(scene.witness.size(), 2U);
  EXPECT_EQ(BlockedSamples(scene, oracle, scene.witness), 0);
}

TEST(SceneFamilies, WitnessIsFreeAndStraightLineIsNot) {
  for (const SceneFamily& family : SceneFamilies()) {
    ExpectSound(family.name, {});
  }
}

TEST(SceneFamilies, SeedsKeepScenesSound) {
  for (const SceneFamily& family : SceneFamilies()) {
    for (const double seed : {1, 2}) {
      ExpectSound(family.name, {{"seed", seed}});
      EXPECT_EQ(MakeScene(family.name, {{"seed", seed}}),
                MakeScene(family.name, {{"seed", seed}}));
    }
    EXPECT_NE(MakeScene(family.name, {{"seed", 1}})["start"],
              MakeScene(family.name, {{"seed", 2}})["start"]);
  }
}

TEST(SceneFamilies, PlacementKeepsScenesSound) {
  const std::vector<Knobs> variants = {
      {{"rotation_seed", 1}},
      {{"offset", 1000}},
      {{"scale", 0.001}},
      {{"scale", 1000}},
      {{"seed", 3}, {"rotation_seed", 2}, {"offset", -7}, {"scale", 3}}};
  for (const SceneFamily& family : SceneFamilies()) {
    for (const Knobs& knobs : variants) ExpectSound(family.name, knobs);
  }
}

// Bounds that cannot be turned become an obstacle.
TEST(SceneFamilies, PlacementKeepsTheProblem) {
  constexpr int kSeed = 5;
  constexpr double kScale = 2.0, kOffset = 10.0;
  for (const std::string name : {"hole", "clutter_hole", "comb"}) {
    const Scene plain = Made(name, {});
    const Scene placed = Made(
        name,
        {{"rotation_seed", kSeed}, {"scale", kScale}, {"offset", kOffset}});
    EXPECT_TRUE(placed.workspace.bounds.IsEmpty());
    EXPECT_EQ(placed.workspace.obstacles.back().name(), "bounds_shell");
    const CollisionOracle before(plain.workspace.robot,
                                 JoinedObstacle(plain.workspace));
    const CollisionOracle after(placed.workspace.robot,
                                JoinedObstacle(placed.workspace));
    std::mt19937_64 random(kSeed);
    const Eigen::Matrix3d rotation = RandomRotation(&random);
    int blocked = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d q = RandomPoint(plain.workspace.bounds, &random);
      const bool expected = !InBounds(plain, q) || before.Collides(q);
      const Vector3d moved = (kScale * (rotation * q)).array() + kOffset;
      EXPECT_EQ(after.Collides(moved), expected) << name << ' ' << q;
      blocked += expected;
    }
    EXPECT_GT(blocked, 200);
    EXPECT_LT(blocked, 1800);
  }
}

TEST(SceneFamilies, TwinsBlockTheWayOfTheirSiblings) {
  for (const std::string& name : kPlanning) {
    for (const double rotation_seed : {0, 4}) {
      const Knobs common = {{"rotation_seed", rotation_seed}};
      const Scene sibling = Made(name, common);
      for (const auto& [key, value] : Knobs{{"twin", 1}, {"delta", -1e-3}}) {
        Knobs knobs = common;
        knobs[key] = value;
        const Scene twin = Made(name, knobs);
        EXPECT_EQ(twin.feasible, false) << name;
        EXPECT_TRUE(twin.witness.empty());
        EXPECT_EQ(twin.start, sibling.start);
        const CollisionOracle oracle(twin.workspace.robot,
                                     JoinedObstacle(twin.workspace));
        EXPECT_GT(BlockedSamples(twin, oracle, sibling.witness), 0) << name;
        EXPECT_FALSE(oracle.Collides(twin.start)) << name;
        // Only a maze's goal may lie in the corridor that is too narrow.
        EXPECT_FALSE(oracle.Collides(twin.goal)) << name;
      }
    }
  }
}

// A point in a channel and a direction across it.
struct CrossSection {
  std::string name;
  Knobs knobs;
  Vector3d point;
  Vector3d across;
};

TEST(SceneFamilies, ChannelsAreAsWideAsDelta) {
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::vector<CrossSection> sections = {
      {"gap", {}, {0, 0, 0.25}, z},
      {"hole", {}, {0, 0.25, -0.125}, y},
      {"hole", {}, {0, 0.25, -0.125}, z},
      {"keyhole", {}, {0, 0.5, 0}, y},
      {"keyhole", {}, {0, -0.5, 0}, z},
      {"tunnel", {{"bends", 1}}, {0, -0.75, 0}, z},
      {"tunnel", {{"bends", 3}}, {-0.125, -0.75, -0.25}, x},
      {"tunnel", {{"bends", 5}}, {-0.25, -0.25, -0.5}, x},
      {"tunnel", {{"bends", 5}}, {0.5, -0.5, 0}, z},
      {"comb", {}, {-0.25, 0, 0}, x},
      {"comb", {}, {0.25, 0.5, 0}, x},
      {"snake", {}, {-0.25, 0, 0}, x},
      {"snake", {}, {-0.25, 0, 0}, z},
      {"snake", {}, {0, 0.5, 0.25}, y},
      {"snake", {}, {-0.125, 0.5, 0}, z},
      {"bugtrap", {}, {0.25, 0, 0}, y},
      {"clutter_hole", {}, {0, 0.5, 0.25}, z}};
  for (CrossSection section : sections) {
    for (const double delta : {1e-2, 1e-3, 2e-5}) {
      section.knobs["delta"] = delta;
      const Scene scene = Made(section.name, section.knobs);
      const CollisionOracle oracle(scene.workspace.robot,
                                   JoinedObstacle(scene.workspace));
      for (const double side : {-0.5, 0.5}) {
        const Vector3d edge = side * delta * section.across;
        EXPECT_FALSE(oracle.Collides(section.point + 0.999 * edge))
            << section.name << ' ' << delta;
        EXPECT_TRUE(oracle.Collides(section.point + 1.001 * edge))
            << section.name << ' ' << delta;
      }
    }
  }
}

// The boxes of a `cells` shape.
std::vector<BoundingBox> BoxesOf(const Json& shape) {
  if (shape["type"] != "cells") return {};
  std::vector<BoundingBox> boxes;
  const auto x = shape["x"].get<std::vector<double>>();
  const auto y = shape["y"].get<std::vector<double>>();
  const auto z = shape["z"].get<std::vector<double>>();
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const auto row = shape["layers"][k][j].get<std::string>();
      for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        if (row[i] != '#') continue;
        boxes.push_back({{x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}});
      }
    }
  }
  return boxes;
}

// Whether start and goal are joined in [−1, 1]³ less the sums of all pairs of
// boxes: flood fill of the grid through all their faces.
class BoxWorld {
 public:
  BoxWorld(const std::vector<BoundingBox>& robot,
           const std::vector<BoundingBox>& obstacle) {
    for (const BoundingBox& o : obstacle) {
      for (const BoundingBox& r : robot) {
        sums_.push_back({o.min - r.max, o.max - r.min});
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double>& cuts = cuts_[axis];
      cuts = {-1.0, 1.0};
      for (const BoundingBox& sum : sums_) {
        for (const double cut : {sum.min[axis], sum.max[axis]}) {
          if (cut > -1.0 && cut < 1.0) cuts.push_back(cut);
        }
      }
      std::sort(cuts.begin(), cuts.end());
      cuts.erase(std::unique(cuts.begin(), cuts.end(),
                             [](double a, double b) { return b - a < 1e-12; }),
                 cuts.end());
      size_[axis] = static_cast<int>(cuts.size()) - 1;
    }
    blocked_.assign(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]),
                    0);
    for (const BoundingBox& sum : sums_) Block(sum);
  }

  bool Connects(const Vector3d& start, const Vector3d& goal) {
    const auto cell_of = [&](const Vector3d& q) {
      return At(Index(0, q.x()), Index(1, q.y()), Index(2, q.z()));
    };
    std::vector<char> seen = blocked_;
    std::vector<int> front = {cell_of(start)};
    const int target = cell_of(goal);
    EXPECT_FALSE(blocked_[front[0]]);
    EXPECT_FALSE(blocked_[target]);
    while (!front.empty()) {
      const int cell = front.back();
      front.pop_back();
      if (seen[cell]) continue;
      seen[cell] = 1;
      const int i = cell % size_[0], j = cell / size_[0] % size_[1];
      const int k = cell / (size_[0] * size_[1]);
      if (i > 0) front.push_back(At(i - 1, j, k));
      if (i + 1 < size_[0]) front.push_back(At(i + 1, j, k));
      if (j > 0) front.push_back(At(i, j - 1, k));
      if (j + 1 < size_[1]) front.push_back(At(i, j + 1, k));
      if (k > 0) front.push_back(At(i, j, k - 1));
      if (k + 1 < size_[2]) front.push_back(At(i, j, k + 1));
    }
    return seen[target];
  }

 private:
  int At(int i, int j, int k) const {
    return i + size_[0] * (j + size_[1] * k);
  }

  // The cell that holds x.
  int Index(int axis, double x) const {
    const std::vector<double>& cuts = cuts_[axis];
    const auto above = std::upper_bound(cuts.begin(), cuts.end(), x);
    const int index = static_cast<int>(above - cuts.begin()) - 1;
    return std::clamp(index, 0, size_[axis] - 1);
  }

  void Block(const BoundingBox& sum) {
    std::array<int, 3> low, high;
    for (int axis = 0; axis < 3; ++axis) {
      if (sum.max[axis] <= -1.0 || sum.min[axis] >= 1.0) return;
      low[axis] = Index(axis, sum.min[axis] + 1e-11);
      high[axis] = Index(axis, sum.max[axis] - 1e-11);
    }
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) blocked_[At(i, j, k)] = 1;
      }
    }
  }

  std::vector<BoundingBox> sums_;
  std::array<std::vector<double>, 3> cuts_;
  std::array<int, 3> size_;
  std::vector<char> blocked_;
};

TEST(SceneFamilies, TwinsHaveNoPathByFloodFill) {
  for (const std::string& name : kPlanning) {
    for (const Knobs& knobs :
         {Knobs{}, Knobs{{"delta", 2e-5}}, Knobs{{"twin", 1}},
          Knobs{{"delta", -1e-2}}, Knobs{{"twin", 1}, {"delta", 1e-4}}}) {
      const Json json = MakeScene(name, knobs);
      const Scene scene = ParseScene(json, name);
      BoxWorld world(BoxesOf(json["robot"]["shape"]),
                     BoxesOf(json["obstacles"][0]["shape"]));
      EXPECT_EQ(world.Connects(scene.start, scene.goal), scene.feasible)
          << name << ' ' << Text(knobs);
    }
  }
  for (const double bends : {1, 3, 5}) {
    for (const double twin : {0, 1}) {
      const Json json = MakeScene("tunnel", {{"bends", bends}, {"twin", twin}});
      const Scene scene = ParseScene(json, "tunnel");
      BoxWorld world(BoxesOf(json["robot"]["shape"]),
                     BoxesOf(json["obstacles"][0]["shape"]));
      EXPECT_EQ(world.Connects(scene.start, scene.goal), twin == 0) << bends;
    }
  }
}

// The exact contact space of a turned scene, bounds included: one bounded
// free cell, and more in the twin.
TEST(SceneFamilies, TurnedTwinsCutTheFreeSpace) {
  for (const std::string& name : kPlanning) {
    const auto cells = [&](double twin) {
      const Scene scene = Made(name, {{"rotation_seed", 3}, {"twin", twin}});
      return BuildContactSpace(scene.workspace.robot,
                               JoinedObstacle(scene.workspace))
          .report()
          .cavities;
    };
    EXPECT_EQ(cells(0), 1) << name;
    EXPECT_GE(cells(1), 2) << name;
  }
}

TEST(SceneFamilies, MazesOfAllSizesAreSound) {
  for (const double n : {2, 4, 6}) {
    for (const double layout : {2, 3}) {
      const Knobs knobs = {{"n", n}, {"layout", layout}, {"delta", 1e-3}};
      ExpectSound("maze", knobs);
      Knobs twin = knobs;
      twin["twin"] = 1;
      const Json json = MakeScene("maze", twin);
      const Scene scene = ParseScene(json, "maze");
      BoxWorld world(BoxesOf(json["robot"]["shape"]),
                     BoxesOf(json["obstacles"][0]["shape"]));
      EXPECT_FALSE(world.Connects(scene.start, scene.goal)) << n;
    }
  }
}

std::string ErrorOf(const std::string& name, const Knobs& knobs) {
  return testing::ErrorOf([&] { MakeScene(name, knobs); }, "no error");
}

TEST(SceneFamilies, KnobsOutOfRangeAreRefused) {
  EXPECT_EQ(ErrorOf("tunnel", {{"bends", 2}}),
            "scene tunnel: bends: expected 1, 3 or 5, found 2");
  EXPECT_EQ(ErrorOf("maze", {{"n", 1}}),
            "scene maze: n: expected a whole number in [2, 12], found 1");
  EXPECT_EQ(ErrorOf("hole", {{"delta", 1}}),
            "scene hole: delta: expected a number in [-0.05, 0.1], found 1");
  EXPECT_EQ(ErrorOf("hole", {{"seed", 0.5}}),
            "scene hole: seed: expected a whole number >= 0, found 0.5");
  EXPECT_EQ(ErrorOf("hole", {{"scale", 0}}),
            "scene hole: scale: expected a number > 0, found 0");
  EXPECT_EQ(ErrorOf("u_trap", {{"wall", 9}}),
            "scene u_trap: /obstacles/0/shape: MakeU: wall must be less than "
            "size / 2 = 1, found 9");
}

}  // namespace
}  // namespace phongpd
