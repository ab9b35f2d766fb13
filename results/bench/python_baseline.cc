// SPDX-License-Identifier: GPL-3.0-or-later
// python_baseline SPACE.off POINTS MOTION: the C++ half of python_benchmark.py,
// which starts it and asks in turns, so that both halves see the same machine.
// POINTS, MOTION: doubles, three a point, as they lie in memory.  A line "KIND
// METRIC COUNT" on the standard input, METRIC phong or euclidean, is answered
// by a line, the seconds of KIND:
//   batch   one QueryBatch of the first COUNT points
//   single  a Query, cold, of each of them, one after the other
//   motion  a Query of each of the first COUNT steps of the motion, on the
//           branch of the one before
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_io.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "core/projection/query_batch.h"
#include "results/bench/program.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> ReadPoints(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)),
                          std::istreambuf_iterator<char>());
  if (bytes.empty() || bytes.size() % sizeof(Vector3d) != 0) {
    throw InputError(path + ": expected doubles, three a point, found " +
                     std::to_string(bytes.size()) + " bytes");
  }
  std::vector<Vector3d> points(bytes.size() / sizeof(Vector3d));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(points.data()));
  return points;
}

void Ask(const std::string& kind, const PenetrationMetric& metric,
         const std::vector<Vector3d>& points,
         std::vector<PenetrationResult>* results) {
  if (kind == "batch") {
    QueryBatch(metric, points.data(), results->size(), results->data());
    return;
  }
  Branch branch;
  for (std::size_t i = 0; i < results->size(); ++i) {
    PenetrationResult& result = (*results)[i];
    result = metric.Query(points[i], branch);
    if (kind == "motion") branch = result.branch;
  }
}

}  // namespace

int Run(Program* program) {
  const std::vector<std::string> given = program->arguments();
  if (given.size() != 3) {
    throw InputError("arguments: expected SPACE.off POINTS MOTION, found " +
                     std::to_string(given.size()) + " of them");
  }
  const ContactSpace space = TakeAsContactSpace(ReadMesh(given[0]), given[0]);
  const std::vector<Vector3d> points = ReadPoints(given[1]);
  const std::vector<Vector3d> motion = ReadPoints(given[2]);
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.2;
  const PhongMetric phong(space, options);
  const EuclideanMetric euclidean(space);
  std::vector<PenetrationResult> results;
  std::cout << Machine() << std::endl;
  std::string kind, name;
  std::size_t count = 0;
  while (std::cin >> kind >> name >> count) {
    const std::vector<Vector3d>& asked = kind == "motion" ? motion : points;
    results.resize(std::min(count, asked.size()));  // not on the clock
    const PenetrationMetric* metric = &euclidean;
    if (name == "phong") metric = &phong;
    const auto begin = std::chrono::steady_clock::now();
    Ask(kind, *metric, asked, &results);
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - begin;
    std::cout << seconds.count() << std::endl;
  }
  return 0;
}

}  // namespace phongpd::bench
