// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/path_problems.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <stdexcept>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;

Vector3d Uniform(const Vector3d& low, const Vector3d& high,
                 std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Vector3d x;
  for (int k = 0; k < 3; ++k) {
    x[k] = low[k] + unit(*random) * (high[k] - low[k]);
  }
  return x;
}

TriangleMesh Centered(const TriangleMesh& mesh) {
  return Translated(mesh, -ComputeBounds(mesh).Center());
}

TriangleMesh Contact(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  return Centered(BuildContactSpace(robot, obstacle).mesh());
}

TriangleMesh Plate(double thickness, double width) {
  const Vector3d half(1.0, width, 0.5 * thickness);
  return MakeBox(-half, half);
}

TriangleMesh Clutter(std::uint64_t layout) {
  std::mt19937_64 random(100 + layout);
  TriangleMesh boxes;
  for (int i = 0; i < 20; ++i) {
    const Vector3d half =
        Uniform(Vector3d::Constant(0.08), Vector3d::Constant(0.25), &random);
    const Vector3d at =
        Uniform(Vector3d::Constant(-0.8), Vector3d::Constant(0.8), &random);
    const TriangleMesh box =
        Translated(Rotated(MakeBox(-half, half), RandomRotation(&random)), at);
    boxes = i == 0 ? box : Joined(boxes, box);
  }
  return Contact(MakeIcoBall(0.05, 0), boxes);
}

// The number a name ends with.
double Size(const std::string& family, const std::string& prefix) {
  return std::atof(family.substr(prefix.size()).c_str());
}

bool Begins(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

TriangleMesh MakeContact(const std::string& family, std::uint64_t seed) {
  const TriangleMesh ball = MakeIcoBall(0.1, 2);
  if (family == "Uaxis" || family == "U") {
    return Contact(ball, MakeU(2.0, 0.3, 1.0));
  }
  if (family == "L") return Contact(ball, MakeL(2.0, 0.5, 0.6));
  if (Begins(family, "plate")) return Plate(Size(family, "plate"), 1.0);
  if (family == "longplate") return Plate(0.1, 0.4);
  if (family == "hole") return MakePlateWithHole(2.0, 0.2, 0.4);
  if (family == "torus") return MakeTorus(1.0, 0.35, 32, 16);
  if (family == "cone_axes") {
    return Contact(MakeCone(0.3, 0.6, 24), MakeAxes(1.0, 0.2));
  }
  if (family == "ball_wrench") {
    return Contact(MakeUvBall(0.3, 16, 12), MakeWrench(0.4));
  }
  if (family == "clutter") return Clutter(seed % 6);
  if (Begins(family, "channel")) {
    return MakePlateWithHole(2.0, 1.0, Size(family, "channel"));
  }
  throw std::invalid_argument("no family " + family);
}

// Ends before the rotation; a family's own, or opposite points of a sphere.
void DrawEnds(const std::string& family, std::mt19937_64* random,
              PathProblem* problem) {
  const BoundingBox box = ComputeBounds(problem->contact);
  Vector3d& a = problem->start;
  Vector3d& b = problem->goal;
  if (family == "Uaxis") {
    a = Uniform({-0.5, -1.5, -0.3}, {0.9, -1.4, 0.3}, random);
    b = Vector3d(a.x(), -a.y(), a.z()) +
        Uniform(Vector3d::Constant(-0.1), Vector3d::Constant(0.1), random);
    return;
  }
  if (family == "longplate") {
    a = Uniform({-1.3, -0.2, -0.2}, {-1.15, 0.2, 0.05}, random);
    b = Uniform({1.15, -0.2, -0.05}, {1.3, 0.2, 0.2}, random);
    return;
  }
  if (family == "hole" || Begins(family, "channel")) {
    const double high = box.max.z();
    a = Uniform({-0.5, -0.5, high + 0.15}, {0.5, 0.5, high + 0.5}, random);
    b = Uniform({-0.5, -0.5, -high - 0.5}, {0.5, 0.5, -high - 0.15}, random);
    return;
  }
  // A line through the box in any direction, its ends outside.
  const Vector3d through = Uniform(0.6 * box.min, 0.6 * box.max, random);
  std::normal_distribution<double> normal;
  const double x = normal(*random), y = normal(*random);
  const Vector3d direction = Vector3d(x, y, normal(*random)).normalized();
  a = through - 0.6 * box.Diagonal() * direction;
  b = through + 0.6 * box.Diagonal() * direction;
}

}  // namespace

std::vector<std::string> PathFamilies() {
  return {"Uaxis",      "U",           "L",           "plate0.1",
          "plate0.02",  "plate0.005",  "longplate",   "hole",
          "torus",      "cone_axes",   "ball_wrench", "clutter",
          "channel0.1", "channel0.01", "channel0.001"};
}

PathProblem MakePathProblem(const std::string& family, std::uint64_t seed) {
  static std::map<std::string, TriangleMesh> built;
  const std::string key =
      family == "clutter" ? family + std::to_string(seed % 6) : family;
  const auto found = built.find(key);
  const TriangleMesh& mesh =
      found != built.end()
          ? found->second
          : built.emplace(key, MakeContact(family, seed)).first->second;
  PathProblem problem;
  problem.contact = mesh;
  const FreeSpace space({TakeAsContactSpace(mesh)});
  const double distance = 0.02 * ComputeBounds(mesh).Diagonal();
  std::mt19937_64 random(seed);
  const auto is_good = [&](const Vector3d& q) {
    return space.IsFree(q) && space.Clearance(q) > distance;
  };
  do {
    DrawEnds(family, &random, &problem);
  } while (!is_good(problem.start) || !is_good(problem.goal) ||
           space.IsFree(problem.start, problem.goal));
  const Eigen::Matrix3d rotation = GenericRotation();
  problem.contact = Rotated(mesh, rotation);
  problem.start = rotation * problem.start;
  problem.goal = rotation * problem.goal;
  return problem;
}

TriangleMesh VesselSpace() {
  return BuildContactSpace(Cube(2.0), MakeVessel(10.0, 6.0, 0.0)).mesh();
}

}  // namespace phongpd::testing
