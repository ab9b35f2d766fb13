// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "core/solid/solid.h"

// Pairs of solids and motions that turn, for wrench_benchmark.
namespace phongpd::bench {

struct WrenchPair {
  std::string name;
  Solid robot, obstacle;
  std::uint64_t seed = 0;  // of its motions
};

// Twenty, of 10 to 120 triangles a solid; pair i has the seed `first_seed` + i.
// 32001 to 32020 are those of the published rows, and used for nothing else.
inline constexpr std::uint64_t kWrenchSeed = 32001;
std::vector<WrenchPair> WrenchPairs(std::uint64_t first_seed = kWrenchSeed);

enum class WrenchMotion {
  kTurn,         // about a point of the robot that rests in the obstacle
  kTurnAndMove,  // ... that goes straight between two points of the obstacle
};
const char* ToString(WrenchMotion motion);  // "turn", "turn and move"

// steps + 1 poses over 60 degrees about a random axis, from a random
// orientation; inner points of the solids are drawn in their boxes.  Every
// second pose of 2·steps is one of these, to the bit.
std::vector<RobotPose> WrenchPoses(const WrenchPair& pair, WrenchMotion motion,
                                   int steps);

}  // namespace phongpd::bench
