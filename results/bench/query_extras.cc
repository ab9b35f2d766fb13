// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/query_extras.h"

#include <malloc.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/contact/contact_space_file.h"
#include "core/projection/phong_metric.h"
#include "core/projection/query_batch.h"
#include "core/stopwatch.h"
#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 7;

std::string NameOf(const QuerySpace& space) {
  return space.name + ", " + Shown(space.contact.mesh().triangles.size()) +
         " triangles";
}

double SecondsOfBatch(const PhongMetric& metric,
                      const std::vector<Vector3d>& points,
                      std::size_t threads) {
  const tbb::global_control control(
      tbb::global_control::max_allowed_parallelism, threads);
  const Stopwatch stopwatch;
  QueryBatch(metric, points);
  return stopwatch.Seconds();
}

// Both take turns; the median of the ratios.
double BatchSpeedup(const QuerySpace& space) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.0;
  const PhongMetric metric(space.contact, options);
  std::vector<Vector3d> points;
  for (int i = 0; i < 20; ++i) {
    points.insert(points.end(), space.points.begin(), space.points.end());
  }
  std::vector<double> ratios;
  for (int round = 0; round < kRounds; ++round) {
    const double one = SecondsOfBatch(metric, points, 1);
    ratios.push_back(one / SecondsOfBatch(metric, points, 2));
  }
  return Quantile(ratios, 0.5);
}

double ProcessSeconds(const QuerySpace& space, const std::string& phongpd) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "phongpd-query-benchmark";
  std::filesystem::create_directories(folder);
  const std::string contact = (folder / "contact.pcs").string();
  const std::string points = (folder / "points.csv").string();
  WriteContactSpace(space.contact, contact);
  {
    std::ofstream file(points);
    file << "x,y,z\n";
    for (std::size_t i = 0; i < 10000; ++i) {
      file << FormatPoint(space.points[i % space.points.size()]) << '\n';
    }
  }
  const std::string command =
      "'" + phongpd + "' query --contact-space '" + contact + "' --points '" +
      points + "' --output '" + (folder / "out.csv").string() + "' > /dev/null";
  std::vector<double> seconds;
  for (int round = 0; round < kRounds; ++round) {
    const Stopwatch stopwatch;
    if (std::system(command.c_str()) != 0) {
      throw InputError(phongpd +
                       ": expected the program, it failed at: " + command);
    }
    seconds.push_back(stopwatch.Seconds());
  }
  std::filesystem::remove_all(folder);
  return Quantile(seconds, 0.5);
}

std::size_t Allocated() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

double BytesOf(const TriangleMesh& mesh) {
  const std::size_t before = Allocated();
  const ContactSpace contact = TakeAsContactSpace(mesh);
  contact.bvh();
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.0;
  const PhongMetric metric(contact, options);
  return static_cast<double>(Allocated() - before) /
         static_cast<double>(mesh.triangles.size());
}

}  // namespace

QueryExtras MeasureExtras(const std::vector<QuerySpace>& spaces,
                          const std::string& phongpd) {
  QueryExtras extras;
  const QuerySpace* middle = &spaces.front();
  const auto off = [](const QuerySpace& space) {
    return std::abs(std::log(
        static_cast<double>(space.contact.mesh().triangles.size()) / 1e4));
  };
  for (const QuerySpace& space : spaces) {
    if (off(space) < off(*middle)) middle = &space;
    if (space.contact.mesh().triangles.size() > 200000) continue;
    const double bytes = BytesOf(space.contact.mesh());
    if (bytes > extras.most_bytes) {
      extras.most_bytes = bytes;
      extras.most_bytes_space = NameOf(space);
    }
  }
  extras.batch_space = extras.process_space = NameOf(*middle);
  extras.batch_speedup = BatchSpeedup(*middle);
  extras.process_seconds = ProcessSeconds(*middle, phongpd);
  return extras;
}

}  // namespace phongpd::bench
