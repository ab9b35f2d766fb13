// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/guard_measure.h"

#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "core/contact/build_switches.h"
#include "core/contact/contact_space.h"
#include "core/minkowski/build_stop.h"
#include "core/stopwatch.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "results/bench/child_process.h"
#include "results/bench/free_space_measure.h"

namespace phongpd::bench {
namespace {

using Json = nlohmann::json;

// A build that takes longer, wall time on a busy machine, is not measured.
constexpr double kGuardLimit = 120.0;
// What is cheaper is no matter for a guard, nor can it be measured.
constexpr double kLeastSeconds = 0.05;
constexpr double kLeastMib = 16.0;

struct Shape {
  const char* name;
  std::function<TriangleMesh()> make;
};

const std::vector<Shape>& Shapes() {
  static const std::vector<Shape> shapes = {
      {"box",
       [] {
         return MakeBox({-1, -1, -1}, {1, 1, 1});
       }},
      {"ball 220", [] { return MakeUvBall(1.0, 12, 11); }},
      {"ball 1280", [] { return MakeIcoBall(1.0, 3); }},
      {"cone", [] { return MakeCone(0.8, 1.6, 40); }},
      {"axes", [] { return MakeAxes(1.0, 0.15); }},
      {"wrench 192", [] { return MakeWrench(1.0, 12, 12, 8, 8); }},
      {"wrench 772", [] { return MakeWrench(); }},
      {"torus 576", [] { return MakeTorus(1.0, 0.35, 24, 12); }},
      {"torus 2400", [] { return MakeTorus(1.0, 0.35, 60, 20); }},
      {"L", [] { return MakeL(1, 0.3, 0.5); }},
      {"U", [] { return MakeU(2, 0.5, 1); }},
      {"plate", [] { return MakePlateWithRoundHole(2, 0.4, 0.6, 32); }},
      {"prism", [] { return MakePrism(0.5, 2.0, 24); }},
      {"vessel", [] { return MakeVessel(2, 1.6, 0.5); }},
      {"star", [] { return MakeStar(0.5, 1.2); }},
      {"blob 320", [] { return MakeBlob(1, 2, 0.35, 5); }},
      {"blob 1280", [] { return MakeBlob(1, 3, 0.35, 1); }},
      {"blob 5120", [] { return MakeBlob(1, 4, 0.35, 2); }},
      {"knot 768", [] { return MakeKnot(0.4, 0.16, 48, 8); }},
      {"knot 1536", [] { return MakeKnot(0.4, 0.18, 96, 8); }},
      {"scanned torus",
       [] { return MakeScan(MakeTorus(1, 0.35, 40, 20), 0.1, 0.002, 3); }},
      {"scanned L", [] { return MakeScan(MakeL(1, 0.3, 0.5), 0.1, 0.002, 3); }},
  };
  return shapes;
}

struct Pair {
  const Shape *robot, *obstacle;
  double scale;  // of the robot
  bool is_turned;
  std::uint64_t seed;

  TriangleMesh Robot() const {
    std::mt19937_64 random(seed);
    TriangleMesh mesh = Scaled(robot->make(), scale);
    return is_turned ? Rotated(mesh, RandomRotation(&random)) : mesh;
  }
};

std::vector<Pair> Pairs(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::size_t> any(0, Shapes().size() - 1);
  std::uniform_real_distribution<double> scale(0.15, 1.0);
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const Shape& robot = Shapes()[any(random)];
    const Shape& obstacle = Shapes()[any(random)];
    pairs.push_back({&robot, &obstacle, scale(random), i % 4 != 0, random()});
  }
  return pairs;
}

double ResidentMib() {
  std::ifstream in("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  in >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 0x1p20;
}

double PeakMib() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// "... stopped after 1 s in its cells (predicted: ...": cells.
std::string StageOf(const std::string& refusal) {
  const std::string mark = " in its ";
  const std::size_t at = refusal.find(mark);
  if (at == std::string::npos) return "prediction";
  const std::size_t begin = at + mark.size();
  return refusal.substr(begin, refusal.find_first_of(" ;", begin) - begin);
}

// In a child: builds with the limits and says what it took.
Json Build(const Pair& pair, double max_seconds, double max_mib,
           internal::Boxes boxes) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                1);
  const TriangleMesh robot = pair.Robot(), obstacle = pair.obstacle->make();
  ContactSpaceOptions options;
  options.max_seconds = max_seconds;
  options.max_mib = max_mib;
  Json out = {{"a", robot.triangles.size()}, {"b", obstacle.triangles.size()}};
  const double before = ResidentMib(), start = CpuSeconds();
  const Stopwatch stopwatch;
  try {
    internal::CullingReport culled;
    internal::BuildSwitches switches;
    switches.boxes = boxes;
    const ContactSpace space =
        internal::BuildSwitched(robot, obstacle, options, switches, &culled);
    const ContactSpaceReport& report = space.report();
    out["refused"] = false;
    out["facets"] = report.convolution_triangles;
    out["culled"] = culled.was_tried;
    out["faces"] = report.arrangement_faces;
    out["triangles"] = report.triangles;
    out["predicted"] = {report.predicted.meetings,
                        report.predicted.arrangement_faces,
                        report.predicted.seconds, report.predicted.mib};
  } catch (const BuildRefusal& refusal) {
    out["refused"] = true;
    out["stage"] = StageOf(refusal.what());
  }
  out["wall"] = stopwatch.Seconds();
  out["seconds"] = CpuSeconds() - start;
  out["mib"] = PeakMib() - before;
  return out;
}

// Null where the child did not come to an end.
Json BuildInChild(const Pair& pair, double max_seconds, double max_mib,
                  internal::Boxes boxes = internal::Boxes::kWhereMemoryEnds) {
  const ChildOutcome outcome = RunInChild(
      [&] { return Build(pair, max_seconds, max_mib, boxes).dump(); },
      kGuardLimit);
  if (outcome.status != ChildStatus::kDone) {
    std::cout << pair.robot->name << " + " << pair.obstacle->name << ": "
              << (outcome.status == ChildStatus::kStopped ? "stopped"
                                                          : outcome.output)
              << std::endl;
    return nullptr;
  }
  return Json::parse(outcome.output);
}

double Factor(double predicted, double found, double least) {
  const double a = std::max(predicted, least), b = std::max(found, least);
  return std::max(a / b, b / a);
}

}  // namespace

std::vector<GuardRow> MeasureGuard(int pairs, std::uint64_t seed) {
  std::vector<GuardRow> rows;
  for (const Pair& pair : Pairs(pairs, seed)) {
    const Json whole = BuildInChild(pair, 0.0, 0.0);
    if (whole.is_null()) continue;
    GuardRow row;
    row.robot = pair.robot->name;
    row.obstacle = pair.obstacle->name;
    row.robot_triangles = whole["a"];
    row.obstacle_triangles = whole["b"];
    row.facets = whole["facets"];
    row.is_culled = whole["culled"];
    row.faces = whole["faces"];
    row.triangles = whole["triangles"];
    row.seconds = whole["seconds"];
    row.mib = whole["mib"];
    row.predicted_meetings = whole["predicted"][0];
    row.predicted_faces = whole["predicted"][1];
    row.predicted_seconds = whole["predicted"][2];
    row.predicted_mib = whole["predicted"][3];
    if (row.seconds > 2.0 * kLeastSeconds) {
      const double limit = 0.5 * row.seconds;
      const Json stopped = BuildInChild(pair, limit, 0.0);
      if (!stopped.is_null()) {
        row.time_passed = stopped["wall"].get<double>() / limit;
        row.time_stage = stopped.value("stage", "none");
      }
    }
    if (row.mib > 2.0 * kLeastMib) {
      const double limit = 0.5 * row.mib;
      const Json stopped = BuildInChild(pair, 0.0, limit);
      if (!stopped.is_null()) {
        row.memory_passed = stopped["mib"].get<double>() / limit;
        row.memory_stage = stopped.value("stage", "none");
      }
      const Json boxes = BuildInChild(pair, 0.0, 0.0, internal::Boxes::kAlways);
      if (!boxes.is_null() && !boxes["refused"]) {
        row.boxes_seconds = boxes["seconds"];
        row.boxes_mib = boxes["mib"];
        row.predicted_boxes_mib = boxes["predicted"][3];
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

NamedTable GuardTable(const std::vector<GuardRow>& rows) {
  return {"guard.csv",
          MakeTable({"robot",
                     "obstacle",
                     "triangles of A",
                     "triangles of B",
                     "facets",
                     "culled",
                     "faces",
                     "triangles",
                     "meetings predicted",
                     "faces predicted",
                     "CPU s",
                     "predicted s",
                     "MiB",
                     "predicted MiB",
                     "time over limit",
                     "in its",
                     "memory over limit",
                     "in its stage",
                     "by boxes, CPU s",
                     "by boxes, MiB",
                     "predicted"},
                    rows, [](const GuardRow& r, const auto& add) {
                      add(r.robot, r.obstacle, r.robot_triangles,
                          r.obstacle_triangles, r.facets,
                          std::string(r.is_culled ? "yes" : "no"), r.faces,
                          r.triangles, r.predicted_meetings, r.predicted_faces,
                          r.seconds, r.predicted_seconds, r.mib,
                          r.predicted_mib, r.time_passed, r.time_stage,
                          r.memory_passed, r.memory_stage, r.boxes_seconds,
                          r.boxes_mib, r.predicted_boxes_mib);
                    })};
}

NamedTable GuardVerdict(const std::vector<GuardRow>& rows) {
  struct Line {
    std::string what;
    std::size_t pairs;
    double within_2, within_4, worst;
    std::size_t passed;
    double worst_passed;
  };
  const auto verdict = [&](const char* what, double GuardRow::*predicted,
                           double GuardRow::*found, double GuardRow::*over,
                           double least) {
    Line line{what, rows.size(), 0.0, 0.0, 0.0, 0, 0.0};
    for (const GuardRow& r : rows) {
      const double factor = Factor(r.*predicted, r.*found, least);
      line.within_2 += factor <= 2.0 ? 1.0 : 0.0;
      line.within_4 += factor <= 4.0 ? 1.0 : 0.0;
      line.worst = std::max(line.worst, factor);
      line.passed += r.*over > 1.5 ? 1 : 0;
      line.worst_passed = std::max(line.worst_passed, r.*over);
    }
    const double count =
        std::max<double>(1.0, static_cast<double>(rows.size()));
    line.within_2 /= count;
    line.within_4 /= count;
    return line;
  };
  const std::vector<Line> lines = {
      verdict("time", &GuardRow::predicted_seconds, &GuardRow::seconds,
              &GuardRow::time_passed, kLeastSeconds),
      verdict("memory", &GuardRow::predicted_mib, &GuardRow::mib,
              &GuardRow::memory_passed, kLeastMib)};
  return {"guard_verdict.csv",
          MakeTable({"of", "pairs", "within a factor of 2", "of 4",
                     "worst factor", "beyond 1.5 limits", "farthest"},
                    lines, [](const Line& l, const auto& add) {
                      add(l.what, l.pairs, l.within_2, l.within_4, l.worst,
                          l.passed, l.worst_passed);
                    })};
}

NamedTable BoxesVerdict(const std::vector<GuardRow>& rows) {
  struct Line {
    std::string of;
    std::vector<double> seconds, mib, prediction;
  };
  std::vector<Line> lines = {{"below 64 MiB in one", {}, {}, {}},
                             {"64 to 256 MiB", {}, {}, {}},
                             {"from 256 MiB", {}, {}, {}}};
  for (const GuardRow& r : rows) {
    if (r.boxes_mib <= 0.0) continue;
    Line& line = lines[r.mib < 64.0 ? 0 : r.mib < 256.0 ? 1 : 2];
    line.seconds.push_back(r.boxes_seconds / r.seconds);
    line.mib.push_back(r.boxes_mib / r.mib);
    line.prediction.push_back(
        Factor(r.predicted_boxes_mib, r.boxes_mib, kLeastMib));
  }
  return {"guard_boxes.csv",
          MakeTable({"of", "pairs", "time", "largest time", "memory",
                     "largest memory", "prediction off by"},
                    lines, [](const Line& l, const auto& add) {
                      add(l.of, l.mib.size(), Quantile(l.seconds, 0.5),
                          Quantile(l.seconds, 1.0), Quantile(l.mib, 0.5),
                          Quantile(l.mib, 1.0), Quantile(l.prediction, 1.0));
                    })};
}

}  // namespace phongpd::bench
