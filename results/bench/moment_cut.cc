// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/moment_cut.h"

#include <array>
#include <utility>
#include <vector>

namespace phongpd::bench {
namespace {

using Segment = std::array<Eigen::Vector3d, 2>;
constexpr int kDigits = 8;

std::vector<Segment> CutAt(const TriangleMesh& mesh, double x) {
  std::vector<Segment> segments;
  for (const Triangle& triangle : mesh.triangles) {
    std::vector<Eigen::Vector3d> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t corner) {
        return mesh.vertices[static_cast<std::size_t>(triangle[corner % 3])];
      };
      const Eigen::Vector3d a = at(k);
      const Eigen::Vector3d b = at(k + 1);
      if ((a.x() < x) == (b.x() < x)) continue;
      ends.emplace_back(a + (x - a.x()) / (b.x() - a.x()) * (b - a));
    }
    if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
  }
  return segments;
}

}  // namespace

Table MomentCut(const PaperBenchmark& benchmark, const TriangleMesh& contact,
                const StraightMotion& motion) {
  const double x = motion.from.x();
  const std::pair<const char*, std::vector<Segment>> parts[] = {
      {"obstacle", CutAt(benchmark.obstacle, x)},
      {"contact", CutAt(contact, x)},
      {"first", CutAt(Translated(benchmark.robot, motion.from), x)},
      {"last", CutAt(Translated(benchmark.robot, motion.to), x)},
      {"way", {{motion.from, motion.to}}}};
  return MakeTable({"part", "x", "y1", "z1", "y2", "z2"}, parts,
                   [&](const auto& part, const auto& add) {
                     for (const auto& [a, b] : part.second) {
                       add(std::string(part.first), Rounded(x, kDigits),
                           Rounded(a.y(), kDigits), Rounded(a.z(), kDigits),
                           Rounded(b.y(), kDigits), Rounded(b.z(), kDigits));
                     }
                   });
}

}  // namespace phongpd::bench
