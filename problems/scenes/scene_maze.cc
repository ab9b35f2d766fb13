// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_maze.h"

#include <array>
#include <random>

namespace phongpd {

Eigen::Vector3d Maze::Place(int node) const {
  const auto at = [this](int i) { return -0.75 + 1.5 * i / (n - 1); };
  return {at(node % n), at(node / n % n), at(node / (n * n))};
}

Maze RandomMaze(int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Maze maze = {n, std::vector<int>(static_cast<std::size_t>(n * n * n), -1)};
  const std::array<int, 3> steps = {1, n, n * n};
  std::vector<int> stack = {0};
  maze.parent[0] = 0;
  while (!stack.empty()) {
    const int node = stack.back();
    std::vector<int> fresh;
    for (const int step : steps) {
      const int i = node / step % n;
      if (i > 0 && maze.parent[node - step] < 0) fresh.push_back(node - step);
      if (i < n - 1 && maze.parent[node + step] < 0) {
        fresh.push_back(node + step);
      }
    }
    if (fresh.empty()) {
      stack.pop_back();
      continue;
    }
    const int next = fresh[random() % fresh.size()];
    maze.parent[next] = node;
    stack.push_back(next);
  }
  return maze;
}

}  // namespace phongpd
