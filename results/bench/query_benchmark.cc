// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how long queries take, warm, cold, Euclidean, CGAL's and segment
// checks, on contact spaces of 440 to 10⁶ triangles, by Google Benchmark.
// Writes CSV into a directory, of which query_report.py makes the pages.
#include <benchmark/benchmark.h>

#include <iostream>
#include <map>
#include <memory>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "results/bench/competitor_aabb.h"
#include "results/bench/program.h"
#include "results/bench/query_cases.h"
#include "results/bench/query_extras.h"
#include "results/bench/query_rows.h"

namespace phongpd::bench {
namespace {

using benchmark::State;
using Eigen::Vector3d;

struct Options {
  std::string phongpd = "build/phongpd";
  std::size_t most = 1000000;
  double min_time = 0.01;
  int repetitions = 5;
  std::uint64_t seed = 1;
};

const double kSteps[] = {1e-4, 1e-3, 1e-2};  // shares of D
const double kSmoothing[] = {0.0, 0.2};

// Consecutive points, and where motions begin.
struct Sequence {
  std::string name;
  std::vector<Vector3d> points;
  std::vector<bool> begins;
};

Sequence Coherent(const QuerySpace& space, double step, std::uint64_t seed) {
  Sequence sequence{"step " + Rounded(step), {}, {}};
  for (const auto& motion : QueryMotions(space, step, seed)) {
    for (std::size_t i = 0; i < motion.size(); ++i) {
      sequence.points.push_back(motion[i]);
      sequence.begins.push_back(i == 0);
    }
  }
  return sequence;
}

// Everything one space is asked.  Lives until all has been run.
struct Subject {
  Subject(const QuerySpace& s, const Options& options)
      : space(s), euclidean(s.contact), cgal(s.contact.mesh()) {
    for (const double length : kSmoothing) {
      PhongMetricOptions phong_options;
      phong_options.field_options.smoothing_length = length;
      phong.push_back(std::make_unique<PhongMetric>(s.contact, phong_options));
    }
    sequences.push_back({"random", s.points, {}});
    for (const double step : kSteps) {
      sequences.push_back(Coherent(s, step, options.seed));
    }
  }

  const QuerySpace& space;
  EuclideanMetric euclidean;
  CgalClosestPoint cgal;
  std::vector<std::unique_ptr<PhongMetric>> phong;
  std::vector<Sequence> sequences;
};

// Asks `ask` for one point after the other, round and round.
template <typename Ask>
void EachPoint(const Sequence& sequence, State& state, const Ask& ask) {
  std::size_t i = 0;
  for ([[maybe_unused]] const auto& round : state) {
    benchmark::DoNotOptimize(ask(sequence.points[i]));
    i = i + 1 < sequence.points.size() ? i + 1 : 0;
  }
}

// Every motion begins with the branch of a cold query, which is not timed.
void EachFrame(const PhongMetric& metric, const Sequence& sequence,
               State& state) {
  std::vector<Branch> first(sequence.points.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (sequence.begins[i]) first[i] = metric.Query(sequence.points[i]).branch;
  }
  Branch branch;
  std::size_t i = 0;
  for ([[maybe_unused]] const auto& round : state) {
    if (sequence.begins[i]) branch = first[i];
    const PenetrationResult result = metric.Query(sequence.points[i], branch);
    branch = result.branch;
    benchmark::DoNotOptimize(branch);
    i = i + 1 < sequence.points.size() ? i + 1 : 0;
  }
}

void EachSegment(const TriangleBvh& bvh, const Sequence& sequence,
                 State& state) {
  std::size_t i = 0;
  for ([[maybe_unused]] const auto& round : state) {
    const std::size_t next = i + 1 < sequence.points.size() ? i + 1 : 0;
    const bool begins = !sequence.begins.empty() && sequence.begins[next];
    benchmark::DoNotOptimize(
        bvh.Meets(sequence.points[i], sequence.points[begins ? i : next]));
    i = next;
  }
}

// Registers what is to be run; row i is the benchmark named i.
class Registry {
 public:
  explicit Registry(const Options& options) : options_(options) {}

  template <typename Run>
  void Add(const Subject& subject, const Sequence& sequence,
           const std::string& query, const Run& run) {
    benchmark::RegisterBenchmark(std::to_string(rows_.size()).c_str(), run)
        ->Unit(benchmark::kMicrosecond)
        ->MinTime(options_.min_time)
        ->Repetitions(options_.repetitions);
    rows_.push_back({subject.space.name,
                     subject.space.contact.mesh().triangles.size(),
                     sequence.name, query, 0.0});
  }
  std::vector<QueryRow>& rows() { return rows_; }

 private:
  const Options& options_;
  std::vector<QueryRow> rows_;
};

void Register(const Subject& subject, Registry* registry) {
  for (const Sequence& sequence : subject.sequences) {
    const auto each_point = [&](const std::string& query, const auto& ask) {
      registry->Add(subject, sequence, query, [&sequence, ask](State& state) {
        EachPoint(sequence, state, ask);
      });
    };
    each_point("euclidean", [&subject](const Vector3d& q) {
      return subject.euclidean.Query(q).signed_distance;
    });
    each_point("CGAL", [&subject](const Vector3d& q) {
      return subject.cgal.Distance(q);
    });
    for (std::size_t i = 0; i < subject.phong.size(); ++i) {
      const PhongMetric* phong = subject.phong[i].get();
      const std::string at = "@" + Rounded(kSmoothing[i]);
      each_point("cold" + at, [phong](const Vector3d& q) {
        return phong->Query(q).signed_distance;
      });
      if (sequence.begins.empty()) continue;
      registry->Add(subject, sequence, "warm" + at,
                    [phong, &sequence](State& state) {
                      EachFrame(*phong, sequence, state);
                    });
    }
    registry->Add(subject, sequence, "segment",
                  [&subject, &sequence](State& state) {
                    EachSegment(subject.space.contact.bvh(), sequence, state);
                  });
  }
}

// Collects the times of all repetitions.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      times[std::stoul(run.run_name.function_name)].push_back(
          run.GetAdjustedCPUTime());
    }
  }
  std::map<std::size_t, std::vector<double>> times;
};

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("Queries: rows.");
  Options options;
  app.add_option("--phongpd", options.phongpd, "The program")
      ->capture_default_str();
  app.add_option("--most-triangles", options.most)->capture_default_str();
  app.add_option("--min-time", options.min_time, "Seconds of a repetition")
      ->capture_default_str();
  app.add_option("--repetitions", options.repetitions)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();
  const std::vector<QuerySpace> spaces =
      QuerySpaces(options.most, options.seed);
  const QueryExtras extras = MeasureExtras(spaces, options.phongpd);
  Registry registry(options);
  std::vector<std::unique_ptr<Subject>> subjects;
  for (const QuerySpace& space : spaces) {
    subjects.push_back(std::make_unique<Subject>(space, options));
    Register(*subjects.back(), &registry);
    std::cout << space.name << ", " << space.contact.mesh().triangles.size()
              << " triangles: ready" << std::endl;
  }
  // Neighbours in time are compared with each other only by chance.
  std::string name = "query_benchmark",
              flag = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {name.data(), flag.data(), nullptr};
  int count = 2;
  benchmark::Initialize(&count, arguments);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  for (std::size_t i = 0; i < registry.rows().size(); ++i) {
    registry.rows()[i].micros = Quantile(collector.times[i], 0.5);
  }
  const std::vector<NamedTable> tables = {QueryTable(registry.rows()),
                                          ExtrasTable(extras)};
  program->Write(tables);
  for (const NamedTable& named : tables) {
    std::cout << ToText(named.table) << std::endl;
  }
  program->Finish(options.seed, "measured.txt", "scripts/bench.sh queries");
  return 0;
}

}  // namespace phongpd::bench
