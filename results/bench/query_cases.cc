// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/query_cases.h"

#include <random>
#include <utility>

#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"
#include "results/bench/paper_benchmarks.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPoints = 2048;
constexpr std::size_t kMotions = 40;
constexpr std::size_t kFrames = 100;

Vector3d AnyDirection(std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (;;) {
    const Vector3d d = RandomVector(&unit, random);
    if (d.norm() > 0.1 && d.norm() < 1.0) return d.normalized();
  }
}

std::vector<Vector3d> InteriorPoints(const ContactSpace& contact,
                                     std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const BoundingBox& box = contact.bounds();
  std::vector<Vector3d> points;
  while (points.size() < kPoints) {
    const Vector3d u = RandomVector(&unit, &random);
    const Vector3d q = box.min + u.cwiseProduct(box.max - box.min);
    if (contact.bvh().Locate(q) == Location::kInside) points.push_back(q);
  }
  return points;
}

}  // namespace

std::vector<QuerySpace> QuerySpaces(std::size_t most, std::uint64_t seed) {
  std::vector<QuerySpace> spaces;
  const auto add = [&](const std::string& name, ContactSpace contact) {
    if (contact.mesh().triangles.size() > most) return;
    std::vector<Vector3d> points = InteriorPoints(contact, seed);
    spaces.push_back({name, std::move(contact), std::move(points)});
  };
  for (const PaperBenchmark& paper : PaperBenchmarks()) {
    add(paper.title, BuildContactSpace(paper.robot, paper.obstacle));
  }
  const std::pair<int, int> rings[] = {
      {22, 10}, {32, 16}, {100, 50}, {320, 160}, {1000, 500}};
  for (const auto& [around, across] : rings) {
    if (2 * static_cast<std::size_t>(around * across) > most) continue;
    add("torus", TakeAsContactSpace(MakeTorus(1.0, 0.35, around, across)));
  }
  for (int level = 3; level <= 7; level += 2) {
    if ((std::size_t{20} << (2 * level)) > most) continue;
    add("organic body", TakeAsContactSpace(MakeBlob(1.5, level, 0.35, 1)));
  }
  return spaces;
}

std::vector<std::vector<Vector3d>> QueryMotions(const QuerySpace& space,
                                                double step,
                                                std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<Vector3d>> motions;
  for (std::size_t i = 0; i < kMotions; ++i) {
    const Vector3d move = step * space.contact.length() * AnyDirection(&random);
    std::vector<Vector3d> motion;
    Vector3d q = space.points[i];
    while (motion.size() < kFrames &&
           space.contact.bvh().Locate(q) == Location::kInside) {
      motion.push_back(q);
      q += move;
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

}  // namespace phongpd::bench
