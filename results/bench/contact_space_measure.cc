// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/contact_space_measure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/contact/contact_space.h"
#include "core/stopwatch.h"
#include "results/bench/competitors.h"
#include "results/bench/report.h"
#include "tests/support/contact_space_check.h"

namespace phongpd {

// What child processes send.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckResult, failures, triangles, seconds,
                                   rounded_contacts, crevices, undecided,
                                   oracle_errors)

namespace bench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BuildMeasurement, seconds, robot_triangles,
                                   obstacle_triangles, triangles, components,
                                   genus, cavities, sound, self_intersections,
                                   volume, convolution_triangles,
                                   arrangement_faces, builds, slowest, stages,
                                   hash)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CompetitorMeasurement, seconds, triangles,
                                   volume)

namespace {

using Json = nlohmann::json;

// FNV-1a over all coordinates and indices.
std::uint64_t Hash(const TriangleMesh& mesh) {
  std::uint64_t hash = 14695981039346656037U;
  const auto add = [&hash](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) {
      hash = (hash ^ bytes[i]) * 1099511628211U;
    }
  };
  for (const Eigen::Vector3d& v : mesh.vertices) add(v.data(), 24);
  for (const Triangle& t : mesh.triangles) add(t.data(), sizeof t);
  return hash;
}

BuildMeasurement Build(const BuildCase& build, int builds, int threads,
                       double limit) {
  std::optional<tbb::global_control> control;
  if (threads > 0) {
    control.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(threads));
  }
  const TriangleMesh robot = build.robot(), obstacle = build.obstacle();
  std::vector<double> seconds;
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  ContactSpaceReport report;
  BuildMeasurement m;
  double spent = 0.0;
  while (static_cast<int>(seconds.size()) < builds && spent < 0.25 * limit) {
    const Stopwatch stopwatch;
    const ContactSpace space = BuildContactSpace(robot, obstacle);
    seconds.push_back(stopwatch.Seconds());
    spent += seconds.back();
    report = space.report();
    m.hash = Hash(space.mesh());
    for (std::size_t i = 0; i < report.seconds.size(); ++i) {
      if (i == stages.size()) stages.push_back({report.seconds[i].first, {}});
      stages[i].second.push_back(report.seconds[i].second);
    }
  }
  for (const auto& [stage, times] : stages) {
    m.stages.emplace_back(stage, Quantile(times, 0.5));
  }
  m.robot_triangles = static_cast<int>(robot.triangles.size());
  m.obstacle_triangles = static_cast<int>(obstacle.triangles.size());
  m.triangles = static_cast<int>(report.triangles);
  m.components = report.components;
  m.genus = report.genus;
  m.cavities = report.cavities;
  m.sound = report.closed && report.manifold;
  m.self_intersections = static_cast<int>(report.self_intersections);
  m.volume = report.volume;
  m.convolution_triangles = static_cast<int>(report.convolution_triangles);
  m.arrangement_faces = static_cast<int>(report.arrangement_faces);
  m.builds = static_cast<int>(seconds.size());
  m.seconds = Quantile(seconds, 0.5);
  m.slowest = Quantile(seconds, 1.0);
  return m;
}

// What `work` measures in a process of its own; if it did not finish, how long
// that took.
template <typename M>
M RunMeasured(const std::function<M()>& work, double limit) {
  const ChildOutcome outcome =
      RunInChild([&] { return Json(work()).dump(); }, limit);
  M m;
  if (outcome.status == ChildStatus::kDone) {
    Json::parse(outcome.output).get_to(m);
  } else {
    m.seconds = outcome.seconds;
  }
  m.status = outcome.status;
  m.peak_mib = outcome.peak_mib;
  return m;
}

#ifdef PHONGPD_COMPETITORS
CompetitorMeasurement Compete(const BuildCase& build, double limit,
                              CompetitorResult (*run)(const TriangleMesh&,
                                                      const TriangleMesh&)) {
  return RunMeasured<CompetitorMeasurement>(
      [&] {
        const TriangleMesh robot = build.robot(), obstacle = build.obstacle();
        const Stopwatch stopwatch;
        const CompetitorResult result = run(robot, obstacle);
        CompetitorMeasurement m;
        m.seconds = stopwatch.Seconds();
        m.triangles = static_cast<int>(result.triangles);
        m.volume = result.volume;
        return m;
      },
      limit);
}
#endif

std::string Check(PairKind kind, std::uint64_t seed) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                1);
  CheckOptions options;
  options.seed = seed;
  return Json(CheckContactSpace(MakeRandomPair(kind, seed), options)).dump();
}

void Count(std::uint64_t seed, const ChildOutcome& outcome, FuzzCount* count) {
  ++count->pairs;
  const auto fail = [&](const std::string& why) {
    count->failures.push_back(Name(count->kind) + ", seed " +
                              std::to_string(seed) + ": " + why);
  };
  if (outcome.status != ChildStatus::kDone) {
    ++count->failed;
    count->stopped += outcome.status == ChildStatus::kStopped;
    fail(outcome.status == ChildStatus::kStopped   ? "time limit"
         : outcome.status == ChildStatus::kCrashed ? "crash"
                                                   : outcome.output);
    return;
  }
  const auto found = Json::parse(outcome.output).get<CheckResult>();
  count->failed += !found.failures.empty();
  for (const std::string& why : found.failures) fail(why);
  count->points += 5 * CheckOptions().points;
  count->crevices += found.crevices;
  count->undecided += found.undecided;
  count->oracle_errors += found.oracle_errors;
  count->rounded_pairs += found.rounded_contacts > 0;
  count->largest = std::max(count->largest, static_cast<int>(found.triangles));
  if (found.seconds > count->slowest) {
    count->slowest = found.seconds;
    count->slowest_seed = static_cast<int>(seed);
  }
}

}  // namespace

BuildMeasurement MeasureBuild(const BuildCase& build, int builds, int threads,
                              double limit) {
  return RunMeasured<BuildMeasurement>(
      [&] { return Build(build, builds, threads, limit); }, limit);
}

#ifdef PHONGPD_COMPETITORS
bool HasCompetitors() { return true; }
CompetitorMeasurement MeasureNef(const BuildCase& build, double limit) {
  return Compete(build, limit, NefSum);
}
CompetitorMeasurement MeasureHulls(const BuildCase& build, double limit) {
  return Compete(build, limit, HullUnion);
}
#else
bool HasCompetitors() { return false; }
CompetitorMeasurement MeasureNef(const BuildCase&, double) { return {}; }
CompetitorMeasurement MeasureHulls(const BuildCase&, double) { return {}; }
#endif

FuzzCount CheckPairs(PairKind kind, std::uint64_t first, int pairs,
                     double limit) {
  FuzzCount count;
  count.kind = kind;
  std::pair<std::uint64_t, std::unique_ptr<ChildProcess>> waiting;
  const auto finish = [&] {
    if (!waiting.second) return;
    Count(waiting.first, waiting.second->Wait(limit), &count);
    waiting.second.reset();
  };
  for (int i = 0; i < pairs; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    auto next =
        std::make_unique<ChildProcess>([=] { return Check(kind, seed); });
    finish();
    waiting = {seed, std::move(next)};
  }
  finish();
  return count;
}

}  // namespace bench
}  // namespace phongpd
