// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/contact_space_measure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/contact_space/contact_space.h"
#include "problems/contact_space_check.h"
#include "results/bench/competitors.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

using Json = nlohmann::json;

double Now() {
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

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

std::string Build(const BuildCase& build, int builds, int threads,
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
  std::uint64_t hash = 0;
  double spent = 0.0;
  while (static_cast<int>(seconds.size()) < builds && spent < 0.25 * limit) {
    const double start = Now();
    const ContactSpace space = BuildContactSpace(robot, obstacle);
    seconds.push_back(Now() - start);
    spent += seconds.back();
    report = space.report;
    hash = Hash(space.mesh);
    for (std::size_t i = 0; i < report.seconds.size(); ++i) {
      if (i == stages.size()) stages.push_back({report.seconds[i].first, {}});
      stages[i].second.push_back(report.seconds[i].second);
    }
  }
  Json medians = Json::array();
  for (const auto& [stage, times] : stages) {
    medians.push_back({stage, Quantile(times, 0.5)});
  }
  return Json{{"robot", robot.triangles.size()},
              {"obstacle", obstacle.triangles.size()},
              {"triangles", report.triangles},
              {"components", report.components},
              {"genus", report.genus},
              {"cavities", report.cavities},
              {"sound", report.closed && report.manifold},
              {"self_intersections", report.self_intersections},
              {"volume", report.volume},
              {"convolution", report.convolution_triangles},
              {"arrangement", report.arrangement_faces},
              {"builds", seconds.size()},
              {"seconds", Quantile(seconds, 0.5)},
              {"slowest", Quantile(seconds, 1.0)},
              {"stages", medians},
              {"hash", hash}}
      .dump();
}

// Runs `work`, which returns JSON with "seconds", and fills in what every
// measurement has; nothing when the work did not finish.
std::optional<Json> RunMeasured(const std::function<std::string()>& work,
                                double limit, Measurement* m) {
  const ChildOutcome outcome = RunInChild(work, limit);
  m->status = outcome.status;
  m->message = outcome.output;
  m->seconds = outcome.seconds;
  m->peak_mib = outcome.peak_mib;
  if (m->status != ChildStatus::kDone) return std::nullopt;
  Json json = Json::parse(outcome.output);
  m->seconds = json["seconds"];
  return json;
}

#ifdef PHONGPD_COMPETITORS
CompetitorMeasurement Compete(const BuildCase& build, double limit,
                              CompetitorResult (*run)(const TriangleMesh&,
                                                      const TriangleMesh&)) {
  CompetitorMeasurement m;
  const auto json = RunMeasured(
      [&] {
        const TriangleMesh robot = build.robot(), obstacle = build.obstacle();
        const double start = Now();
        const CompetitorResult result = run(robot, obstacle);
        return Json{{"seconds", Now() - start},
                    {"triangles", result.triangles},
                    {"volume", result.volume}}
            .dump();
      },
      limit, &m);
  if (!json) return m;
  m.triangles = json->at("triangles");
  m.volume = json->at("volume");
  return m;
}
#endif

std::string Check(PairKind kind, std::uint64_t seed) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                1);
  CheckOptions options;
  options.seed = seed;
  const CheckResult r = CheckContactSpace(MakeRandomPair(kind, seed), options);
  return Json{
      {"failures", r.failures},       {"seconds", r.seconds},
      {"triangles", r.triangles},     {"rounded", r.rounded_contacts},
      {"points", 5 * options.points}, {"crevices", r.crevices},
      {"undecided", r.undecided},     {"oracle_errors", r.oracle_errors}}
      .dump();
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
  const Json json = Json::parse(outcome.output);
  count->failed += !json["failures"].empty();
  for (const std::string why : json["failures"]) fail(why);
  count->points += json["points"].get<int>();
  count->crevices += json["crevices"].get<int>();
  count->undecided += json["undecided"].get<int>();
  count->oracle_errors += json["oracle_errors"].get<int>();
  count->rounded_pairs += json["rounded"].get<int>() > 0;
  count->largest = std::max(count->largest, json["triangles"].get<int>());
  if (json["seconds"] > count->slowest) {
    count->slowest = json["seconds"];
    count->slowest_seed = static_cast<int>(seed);
  }
}

}  // namespace

BuildMeasurement MeasureBuild(const BuildCase& build, int builds, int threads,
                              double limit) {
  BuildMeasurement m;
  const auto found = RunMeasured(
      [&] { return Build(build, builds, threads, limit); }, limit, &m);
  if (!found) return m;
  const Json& json = *found;
  m.robot_triangles = json["robot"];
  m.obstacle_triangles = json["obstacle"];
  m.triangles = json["triangles"];
  m.components = json["components"];
  m.genus = json["genus"];
  m.cavities = json["cavities"];
  m.sound = json["sound"];
  m.self_intersections = json["self_intersections"];
  m.volume = json["volume"];
  m.convolution_triangles = json["convolution"];
  m.arrangement_faces = json["arrangement"];
  m.builds = json["builds"];
  m.slowest = json["slowest"];
  for (const Json& stage : json["stages"]) {
    m.stages.emplace_back(stage[0], stage[1]);
  }
  m.hash = json["hash"];
  return m;
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

}  // namespace phongpd::bench
