// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: depth of two meshes from windows of the contact space, nothing
// precomputed, and motion checks from the convolution alone, beside building
// the whole and asking that, in one binary and one run.  Writes CSV into a
// directory, of which lazy_report.py makes the pages.
#include <cmath>
#include <iostream>
#include <random>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"
#include "core/projection/euclidean_metric.h"
#include "core/stopwatch.h"
#include "problems/shapes/random_solids.h"
#include "results/bench/free_space_measure.h"
#include "results/bench/guard_measure.h"
#include "results/bench/large_scene_measure.h"
#include "results/bench/lazy_cases.h"
#include "results/bench/program.h"
#include "results/bench/volume_measure.h"
#include "results/bench/window_phong_measure.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
struct Options {
  int queries = 200;
  int segments = 20000;
  double max_seconds = 60.0;
  double depth = 0.05;
  int guard_pairs = 200;
  std::uint64_t seed = 1;
};

struct CaseRow {
  std::string name;
  std::size_t robot = 0, obstacle = 0, full_faces = 0;
  double full_seconds = 0.0, full_wall = 0.0, handle_seconds = 0.0;
  std::vector<double> cpu_ms, wall_ms, faces, turned_ms;
  double worst_error = 0.0;  // share of the diagonal
  FreeSpaceRow free_space;
  std::vector<VolumeRow> volumes;
  WindowPhongRow phong;
  int uncertified = 0, wrong = 0;
};

CaseRow Measure(const LazyCase& c, const Options& options) {
  CaseRow row;
  row.name = c.name;
  const TriangleMesh robot = c.robot(), obstacle = c.obstacle();
  row.robot = robot.triangles.size();
  row.obstacle = obstacle.triangles.size();
  std::vector<double> walls;
  row.full_seconds = MedianCpuSeconds([&] {
    const Stopwatch stopwatch;
    static_cast<void>(BuildContactSpace(robot, obstacle));
    walls.push_back(stopwatch.Seconds());
  });
  row.full_wall = Quantile(walls, 0.5);
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  row.full_faces = space.report().arrangement_faces;
  row.free_space =
      MeasureFreeSpace(c.name, robot, obstacle, space, row.full_seconds,
                       options.segments, options.seed);
  row.volumes = MeasureVolumes(c.name, robot, obstacle, space, row.full_seconds,
                               options.seed);
  row.phong = MeasureWindowPhong(c.name, robot, obstacle, space,
                                 row.full_seconds, options.depth, options.seed);
  row.handle_seconds =
      MedianCpuSeconds([&] { DepthQuery asked(robot, obstacle); });
  const DepthQuery query(robot, obstacle);

  const EuclideanMetric metric(space);
  const double diagonal = space.length();
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> share(0.0, options.depth);
  while (static_cast<int>(row.cpu_ms.size()) < options.queries) {
    const SurfacePoint on = RandomSurfacePoint(space.mesh(), &random);
    RobotPose pose;
    pose.position = on.position - share(random) * diagonal * on.normal;
    const PenetrationResult truth = metric.Query(pose.position);
    if (!truth.inside || -truth.signed_distance > options.depth * diagonal) {
      continue;
    }
    double start = CpuSeconds();
    const DepthResult found = query.At(pose.position);
    row.cpu_ms.push_back(1e3 * (CpuSeconds() - start));
    row.wall_ms.push_back(1e3 * found.seconds);
    row.faces.push_back(static_cast<double>(found.arranged_faces));
    const double error = std::abs(found.depth + truth.signed_distance);
    row.worst_error = std::max(row.worst_error, error / diagonal);
    row.uncertified += found.certified ? 0 : 1;
    row.wrong += error > 1e-12 * diagonal ? 1 : 0;
    if (row.cpu_ms.size() % 20 == 0) {
      pose.orientation = Eigen::Quaterniond(RandomRotation(&random));
      start = CpuSeconds();
      static_cast<void>(query.At(pose));
      row.turned_ms.push_back(1e3 * (CpuSeconds() - start));
    }
  }
  return row;
}

NamedTable TableOf(const std::vector<CaseRow>& rows) {
  return {"depth.csv",
          MakeTable(
              {"pair", "triangles of A", "triangles of B", "full build, CPU s",
               "wall s", "its faces", "query made, CPU s", "answer, CPU ms",
               "95 %", "wall ms", "faces arranged, median", "turned, CPU ms",
               "worst error / diagonal", "not certified", "wrong"},
              rows, [](const CaseRow& r, const auto& add) {
                add(r.name, r.robot, r.obstacle, r.full_seconds, r.full_wall,
                    r.full_faces, r.handle_seconds, Quantile(r.cpu_ms, 0.5),
                    Quantile(r.cpu_ms, 0.95), Quantile(r.wall_ms, 0.5),
                    Quantile(r.faces, 0.5), Quantile(r.turned_ms, 0.5),
                    r.worst_error, r.uncertified, r.wrong);
              })};
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("Depth from windows of the contact space: rows.");
  Options options;
  app.add_option("--queries", options.queries)->capture_default_str();
  app.add_option("--segments", options.segments)->capture_default_str();
  app.add_option("--max-seconds", options.max_seconds,
                 "Of a full build that is to be refused")
      ->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--guard-pairs", options.guard_pairs,
                 "Pairs that predictions are held to")
      ->capture_default_str();
  program->Parse();
  // In processes of their own, before this one starts threads.
  const std::vector<GuardRow> guard =
      MeasureGuard(options.guard_pairs, options.seed);
  std::cout << ToText(GuardVerdict(guard).table) << std::endl;
  const NamedTable large = LargeSceneTable(options.max_seconds);
  const NamedTable size = LargeSceneSize();
  std::cout << ToText(large.table) << std::endl;
  std::vector<CaseRow> rows;
  for (const LazyCase& c : LazyCases()) {
    rows.push_back(Measure(c, options));
    std::cout << ToText(TableOf({rows.back()}).table) << std::endl;
  }
  std::vector<FreeSpaceRow> free_spaces;
  std::vector<VolumeRow> volumes;
  std::vector<WindowPhongRow> phong;
  for (const CaseRow& row : rows) {
    phong.push_back(row.phong);
    free_spaces.push_back(row.free_space);
    volumes.insert(volumes.end(), row.volumes.begin(), row.volumes.end());
  }
  program->Write({TableOf(rows), WindowPhongTable(phong),
                  FreeSpaceTable(free_spaces), large, size, GuardVerdict(guard),
                  BoxesVerdict(guard), VolumeTable(volumes),
                  GuardTable(guard)});
  program->Finish(options.seed);
  return 0;
}

}  // namespace phongpd::bench
