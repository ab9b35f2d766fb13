// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what smoothing costs in depth on the scenes of the convergence
// study; its runs are those of `phongpd compare`, its report is
// convergence_report.py.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "planners/world/world.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/random_solids.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

constexpr double kSmoothingLengths[] = {0.0, 0.02, 0.05, 0.1, 0.2, 0.3};
constexpr double kDegrees = 57.29577951308232;

// PhongPD over Euclidean PD at interior points.
struct DepthExcess {
  std::string scene;
  double smoothing_length = 0.0;  // fraction of D
  double mean = 1.0;
  double worst = 1.0;
  double limited_share = 0.0;  // vertices the limiter turned
  // Angle between the Jacobian `direction` and the exact gradient, degrees.
  double median_angle = 0.0;
  double worst_angle = 0.0;
};

std::vector<Eigen::Vector3d> InteriorPoints(const TriangleMesh& mesh,
                                            const EuclideanMetric& metric,
                                            int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const BoundingBox box = ComputeBounds(mesh);
  std::vector<Eigen::Vector3d> points;
  // Thin solids fill little of their box.
  for (int i = 0; i < 1000 * count && static_cast<int>(points.size()) < count;
       ++i) {
    const Eigen::Vector3d q = RandomPoint(box, &random);
    if (metric.Query(q).inside) points.push_back(q);
  }
  return points;
}

DepthExcess Measure(const std::string& scene, const ContactSpace& space,
                    double ell, const std::vector<Eigen::Vector3d>& points,
                    const EuclideanMetric& euclid) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = ell;
  const PhongMetric phong(space, options);
  DepthExcess excess;
  excess.scene = scene;
  excess.smoothing_length = ell;
  excess.mean = 0.0;
  std::vector<double> angles;
  for (const Eigen::Vector3d& q : points) {
    const PenetrationResult p = phong.Query(q);
    const double ratio = p.signed_distance / euclid.Query(q).signed_distance;
    excess.mean += ratio / static_cast<double>(points.size());
    excess.worst = std::max(excess.worst, ratio);
    const double length = p.gradient.norm();
    if (!(length > 0.0)) continue;
    // The gradient of the signed value points outward, as the direction does.
    const double cosine = p.gradient.dot(p.direction) / length;
    angles.push_back(kDegrees * std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  excess.median_angle = Quantile(angles, 0.5);
  excess.worst_angle = Quantile(angles, 1.0);
  const PhongField& field = phong.field();
  excess.limited_share = static_cast<double>(field.report.limited_vertices) /
                         static_cast<double>(field.mesh.vertices.size());
  return excess;
}

std::vector<DepthExcess> MeasureAll(const std::vector<std::string>& scenes,
                                    int points, std::uint64_t seed) {
  std::vector<DepthExcess> all;
  for (const std::string& label : scenes) {
    std::cerr << label << '\n';
    const Scene scene = SceneSource(label).Load();
    const World world(scene.workspace, scene.name);
    const ContactSpace& space =
        world.Spaces(SpaceLayout::kMerged).spaces.front();
    const EuclideanMetric euclid(space);
    const std::vector<Eigen::Vector3d> inside =
        InteriorPoints(space.mesh(), euclid, points, seed);
    for (const double ell : kSmoothingLengths) {
      all.push_back(Measure(label, space, ell, inside, euclid));
    }
  }
  return all;
}

Table ExcessTable(const std::vector<DepthExcess>& excess) {
  return MakeTable({"scene", "ℓ", "mean excess", "worst", "limited vertices",
                    "median angle", "worst angle"},
                   excess, [](const DepthExcess& e, const auto& add) {
                     add(e.scene, e.smoothing_length, Rounded(e.mean, 4),
                         e.worst, Rounded(100.0 * e.limited_share, 2) + " %",
                         Rounded(e.median_angle) + "°",
                         Rounded(e.worst_angle) + "°");
                   });
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("What smoothing costs in depth: excess.csv.");
  std::string how;
  std::vector<std::string> scenes;
  int points = 2000;
  std::uint64_t seed = 1;
  app.add_option("--scenes", scenes, "As phongpd compare takes them")
      ->required();
  app.add_option("--points", points)->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  app.add_option("--how", how, "The command that runs this");
  program->Parse();
  const std::vector<DepthExcess> excess = MeasureAll(scenes, points, seed);
  program->Write("excess.csv", ToCsv(ExcessTable(excess)));
  program->Finish(seed, "measured.txt", how);
  return 0;
}

}  // namespace phongpd::bench
