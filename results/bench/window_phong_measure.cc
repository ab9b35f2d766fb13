// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/window_phong_measure.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/projection/window_phong.h"
#include "problems/shapes/random_solids.h"
#include "results/bench/free_space_measure.h"

namespace phongpd::bench {
namespace {

// A query may build everything.
constexpr std::size_t kPhongQueries = 20;

}  // namespace

WindowPhongRow MeasureWindowPhong(const std::string& name,
                                  const TriangleMesh& robot,
                                  const TriangleMesh& obstacle,
                                  const ContactSpace& space,
                                  double full_seconds, double depth,
                                  std::uint64_t seed) {
  WindowPhongRow row;
  row.name = name;
  row.full_faces = space.report().arrangement_faces;
  PhongMetricOptions phong;
  phong.field_options = PhongFieldOptions::Unsmoothed();
  double start = CpuSeconds();
  const PhongMetric whole(space, phong);
  row.whole_seconds = full_seconds + CpuSeconds() - start;
  const double diagonal = space.length();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, depth);
  while (row.seconds.size() < kPhongQueries) {
    const SurfacePoint on = RandomSurfacePoint(space.mesh(), &random);
    const Eigen::Vector3d q =
        on.position - share(random) * diagonal * on.normal;
    const PenetrationResult truth = whole.Query(q);
    if (!truth.inside || -truth.signed_distance > depth * diagonal) continue;
    start = CpuSeconds();
    WindowPhong windows(ConvolutionModel(robot, obstacle), phong);
    const WindowResult found = windows.At(q);
    row.seconds.push_back(CpuSeconds() - start);
    row.faces.push_back(static_cast<double>(found.arranged_faces));
    row.from_windows += found.level == DepthLevel::kWindow ? 1 : 0;
    const double error =
        std::abs(found.answer.signed_distance - truth.signed_distance) /
        diagonal;
    row.worst_error = std::max(row.worst_error, error);
    row.wrong += error > 1e-11 || found.answer.status != truth.status ? 1 : 0;
  }
  return row;
}

NamedTable WindowPhongTable(const std::vector<WindowPhongRow>& rows) {
  return {
      "phong.csv",
      MakeTable({"pair", "whole, CPU s", "its faces", "answer, CPU s, median",
                 "most", "median / whole", "faces arranged, median", "answers",
                 "from windows", "worst error / diagonal", "wrong"},
                rows, [](const WindowPhongRow& r, const auto& add) {
                  const double median = Quantile(r.seconds, 0.5);
                  add(r.name, r.whole_seconds, r.full_faces, median,
                      *std::max_element(r.seconds.begin(), r.seconds.end()),
                      median / r.whole_seconds, Quantile(r.faces, 0.5),
                      r.seconds.size(), r.from_windows, r.worst_error, r.wrong);
                })};
}

}  // namespace phongpd::bench
