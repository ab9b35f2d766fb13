// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <cmath>
#include <random>
#include <sstream>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "problems/shapes/shape_parameters.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::UnitRandom;

constexpr int kWaves = 12;

struct Wave {
  Vector3d number;  // radians a radius
  double phase;
};

std::vector<Wave> RandomWaves(std::mt19937_64* random) {
  std::vector<Wave> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double z = 2 * UnitRandom(random) - 1,
                 turn = 2 * kPi * UnitRandom(random);
    const double flat = std::sqrt(1 - z * z);
    const Vector3d direction(flat * std::cos(turn), flat * std::sin(turn), z);
    const double number = 2 + 4 * UnitRandom(random);
    waves.push_back({number * direction, 2 * kPi * UnitRandom(random)});
  }
  return waves;
}

}  // namespace

TriangleMesh MakeBlob(double radius, int levels, double roughness,
                      std::uint64_t seed) {
  internal::RequireLength("MakeBlob", "radius", radius);
  internal::RequireCount("MakeBlob", "levels", levels, 0, 9);
  // Both false for NaN.
  if (!(std::isgreaterequal(roughness, 0.0) && std::isless(roughness, 1.0))) {
    std::ostringstream message;
    message << "MakeBlob: roughness must be in [0, 1), found " << roughness;
    throw InputError(message.str());
  }
  TriangleMesh mesh = MakeIcoBall(radius, levels);
  std::mt19937_64 random(seed);
  const std::vector<Wave> waves = RandomWaves(&random);
  for (Vector3d& v : mesh.vertices) {
    double sum = 0.0;
    for (const Wave& wave : waves) {
      sum += std::cos(wave.number.dot(v / radius) + wave.phase);
    }
    // Waves in step are rare: half of them lift by the whole roughness.
    v *= 1.0 + roughness * std::tanh(sum * 2 / kWaves);
  }
  return mesh;
}

}  // namespace phongpd
