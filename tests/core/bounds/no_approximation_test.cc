// SPDX-License-Identifier: GPL-3.0-or-later
// What a build of the core alone says where approximations are asked for.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/bounds/mesh_approximation.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

std::string Refusal(const std::function<void()>& ask) {
  try {
    ask();
  } catch (const InputError& error) {
    return error.what();
  }
  return "answered";
}

TEST(NoApproximation, RefusesEachByNameAndSaysHowToBuildIt) {
  const TriangleMesh mesh;
  const std::string rest =
      ": expected a build with approximations, found one without; configure "
      "with -D PHONGPD_BUILD=\"core;approximations\"";
  EXPECT_EQ(Refusal([&] { ConvexHull(mesh); }), "convex hull" + rest);
  EXPECT_EQ(Refusal([&] { Decimate(mesh, 100); }), "decimation" + rest);
  EXPECT_EQ(Refusal([&] { WrapSolid(mesh, 0.02); }), "alpha wrap" + rest);
  EXPECT_EQ(Refusal([&] { WrapTriangles(mesh, 0.02); }), "alpha wrap" + rest);
}

}  // namespace
}  // namespace phongpd
