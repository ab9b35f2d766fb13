// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_recipes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "problems/output/text.h"
#include "problems/shapes/random_solids.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

double DistanceToSegment(const Vector3d& p, const Vector3d& a,
                         const Vector3d& b) {
  const Vector3d along = b - a;
  const double t = (p - a).dot(along) / along.squaredNorm();
  return (p - a - std::clamp(t, 0.0, 1.0) * along).norm();
}

double DistanceToPolyline(const Vector3d& p,
                          const std::vector<Vector3d>& polyline) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    if (polyline[i] == polyline[i - 1]) continue;
    least = std::min(least, DistanceToSegment(p, polyline[i - 1], polyline[i]));
  }
  return least;
}

}  // namespace

const std::vector<SceneRecipe>& SceneRecipes() {
  static const std::vector<SceneRecipe> recipes = [] {
    std::vector<SceneRecipe> all = PaperRecipes();
    for (const auto& part : {TrajectoryRecipes(), PlanningRecipes()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return recipes;
}

nlohmann::ordered_json CountJson(double value) {
  const auto whole = static_cast<long long>(std::clamp(value, -1e9, 1e9));
  if (static_cast<double>(whole) == value) return whole;
  return value;
}

SceneLayout OneObstacle(nlohmann::ordered_json robot,
                        nlohmann::ordered_json shape, const Vector3d& position,
                        double reach, const Vector3d& start,
                        const Vector3d& goal) {
  SceneLayout layout;
  layout.robot = std::move(robot);
  layout.obstacles = {{"obstacle", std::move(shape), position, std::nullopt}};
  layout.bounds = {Vector3d::Constant(-reach), Vector3d::Constant(reach)};
  layout.start = start;
  layout.goal = goal;
  return layout;
}

double WholeKnob(const KnobValues& knobs, const char* key, double least,
                 double most) {
  const double value = knobs.at(key);
  if (value >= least && value <= most && value == std::floor(value)) {
    return value;
  }
  throw InputError(std::string(key) + ": expected a whole number in [" +
                   FormatDouble(least) + ", " + FormatDouble(most) +
                   "], found " + FormatDouble(value));
}

std::vector<PlacedShape> RandomBoxes(int count, double least, double most,
                                     double reach, double distance,
                                     const std::vector<Vector3d>& polyline,
                                     std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> half(least, most);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  const auto draw = [&random](auto& distribution) {
    const double x = distribution(random), y = distribution(random);
    return Vector3d(x, y, distribution(random));
  };
  std::vector<PlacedShape> boxes;
  while (static_cast<int>(boxes.size()) < count) {
    const Vector3d size = 2.0 * draw(half), center = draw(coordinate);
    const Eigen::Matrix3d rotation = RandomRotation(&random);
    if (DistanceToPolyline(center, polyline) < 0.5 * size.norm() + distance) {
      continue;
    }
    boxes.push_back(
        {"box" + std::to_string(boxes.size()),
         {{"type", "box"}, {"size", {size.x(), size.y(), size.z()}}},
         center,
         rotation});
  }
  return boxes;
}

}  // namespace phongpd
