// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what aspect, scale, offset and size do to the rows of the optimiser
// with the default metric, and to its answers: error, refusals and time, of
// boxes in a general position, whose distance is a closed form.  Writes CSV
// into a directory, of which degradation_report.py makes a page.
#include <algorithm>
#include <cmath>
#include <random>

#include "constraints/signed_metric.h"
#include "core/mesh/mesh_error.h"
#include "planners/ompl/ompl_planning.h"
#include "planners/solve/optimize.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "results/bench/free_space_measure.h"
#include "results/bench/program.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 400;

struct Setting {
  std::string axis;  // what is varied
  double value = 0.0;
  double aspect = 1.0, scale = 1.0;
  double offset = 0.0;  // of the obstacle, in its lengths L
  int splits = 0;       // of each triangle into four, so often
};

struct Row {
  Setting setting;
  std::string subject;
  std::size_t triangles = 0;
  int cases = 0, answers = 0, refusals = 0, wrong = 0;
  double worst = 0.0;  // of answers that are not wrong in kind, in L
  double seconds = 0.0;
  std::string refusal;
};

TriangleMesh Split(const TriangleMesh& mesh) {
  TriangleMesh out;
  const auto add = [&](const Vector3d& a, const Vector3d& b,
                       const Vector3d& c) {
    const int n = static_cast<int>(out.vertices.size());
    out.vertices.insert(out.vertices.end(), {a, b, c});
    out.triangles.push_back({n, n + 1, n + 2});
  };
  for (const Triangle& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                   &c = mesh.vertices[t[2]];
    const Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    add(a, ab, ca);
    add(ab, b, bc);
    add(ca, bc, c);
    add(ab, bc, ca);
  }
  return out;
}

// The world, and in its frame (unturned, unmoved, of scale 1) the half sides of
// C_obj, a box.
struct Boxes {
  explicit Boxes(const Setting& setting) : s(setting) {
    const Vector3d robot(0.2, 0.2, 0.2 / s.aspect), wall(0.15, 0.7, 0.5);
    half = robot + wall;
    length = 2.0 * half.norm();
    const auto place = [&](const Vector3d& sides, const Vector3d& at) {
      TriangleMesh mesh = MakeBox(-sides, sides);
      for (int i = 0; i < s.splits; ++i) mesh = Split(mesh);
      mesh = Rotated(mesh, GenericRotation());
      for (Vector3d& v : mesh.vertices) v = s.scale * (v + at);
      return mesh;
    };
    moved = s.offset * length * Vector3d(1.0, -0.7, 0.3);
    workspace.robot = MakeSolid(place(robot, Vector3d::Zero()), "robot");
    workspace.obstacles = {MakeSolid(place(wall, moved), "wall")};
    for (const Solid& solid : {workspace.robot, workspace.obstacles[0]}) {
      triangles += solid.mesh().triangles.size();
    }
  }

  Vector3d ToWorld(const Vector3d& x) const {
    return s.scale * (GenericRotation() * x + moved);
  }
  // Signed distance from the box, its own lengths.
  double Distance(const Vector3d& x) const {
    const Vector3d beyond = x.cwiseAbs() - half;
    return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
  }

  Setting s;
  Vector3d half, moved;
  double length = 0.0;  // L, D of C_obj
  std::size_t triangles = 0;
  Workspace workspace;
};

// Outside the value is the distance; inside the depth is at least Euclid's.
// Wrong is a wrong side, or less depth than that.
void AskRows(const Boxes& boxes, Row* row) {
  const World world(boxes.workspace);
  const SignedMetric metric(world.Spaces(SpaceLayout::kMerged).spaces.at(0));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1.3, 1.3);
  for (int i = 0; i < kPoints; ++i) {
    const Vector3d x = boxes.half.cwiseProduct(
        Vector3d(share(random), share(random), share(random)));
    const double truth = boxes.Distance(x);
    const MetricRow found = metric.Query(boxes.ToWorld(x));
    const double value = found.value / boxes.s.scale;
    ++row->cases;
    ++row->answers;
    const double error =
        (truth > 0.0 ? std::abs(value - truth) : std::max(0.0, value - truth)) /
        boxes.length;
    const bool is_other_side =
        found.inside != (truth < 0.0) && std::abs(truth) > 1e-6 * boxes.length;
    row->wrong += is_other_side ? 1 : 0;
    if (!is_other_side) row->worst = std::max(row->worst, error);
  }
}

// The way around the wall, as by default; the error is that of the path's
// length beside `expected`, the one of the plain setting (0: none known).
double AskOptimizer(const Boxes& boxes, double expected, Row* row) {
  const World world(boxes.workspace);
  OptimizeRequest request;
  request.start = boxes.ToWorld({-2.0 * boxes.half[0], 0.1, 0.05});
  request.goal = boxes.ToWorld({2.0 * boxes.half[0], -0.1, 0.02});
  row->cases = 1;
  const PathAnswer found = Optimize(world, request);
  const bool is_refuted = found.status == PathStatus::kVerificationFailed;
  row->answers = found.is_free || is_refuted ? 1 : 0;
  row->wrong = is_refuted ? 1 : 0;
  if (!found.is_free) {
    row->refusals = is_refuted ? 0 : 1;
    row->refusal = ToString(found.status) + (": " + found.reason);
    return 0.0;
  }
  const double length = found.length / boxes.s.scale / boxes.length;
  if (expected > 0.0) row->worst = std::abs(length - expected);
  return length;
}

Row Measure(const Setting& setting, const std::string& subject,
            double* expected) {
  Row row;
  row.setting = setting;
  row.subject = subject;
  const double start = CpuSeconds();
  try {
    const Boxes boxes(setting);
    row.triangles = boxes.triangles;
    if (subject == "rows") {
      AskRows(boxes, &row);
    } else {
      const double length = AskOptimizer(boxes, *expected, &row);
      if (*expected == 0.0) *expected = length;
    }
  } catch (const InputError& error) {
    row.cases = row.refusals = 1;
    row.refusal = error.what();
  }
  row.seconds = CpuSeconds() - start;
  return row;
}

std::vector<Setting> Settings() {
  std::vector<Setting> all = {{"plain", 0.0}};
  for (const double a : {1e2, 1e4, 1e6, 1e9}) all.push_back({"aspect", a, a});
  for (const double s : {1e-100, 1e-9, 1e-3, 1e3, 1e9, 1e100, 1e160}) {
    all.push_back({"scale", s, 1.0, s});
  }
  for (const double o : {1e2, 1e4, 1e6, 1e8, 1e12}) {
    all.push_back({"offset", o, 1.0, 1.0, o});
  }
  for (const int k : {2, 4, 5}) {
    all.push_back({"size", 24.0 * std::pow(4.0, k), 1.0, 1.0, 0.0, k});
  }
  return all;
}

}  // namespace

int Run(Program* program) {
  program->WithOutput(
      "What extremes do to rows and answers of the optimiser: rows.");
  program->Parse();
  SilenceOmpl();
  std::vector<Row> rows;
  double expected = 0.0;  // of the plain setting, which comes first
  for (const Setting& setting : Settings()) {
    for (const char* subject : {"rows", "optimize"}) {
      // Of another aspect the shape is another, and so is its path.
      double own = 0.0;
      rows.push_back(Measure(setting, subject,
                             setting.axis == "aspect" ? &own : &expected));
    }
  }
  const Table table = MakeTable(
      {"axis", "value", "subject", "triangles", "cases", "answers", "refusals",
       "wrong", "worst error / L", "CPU s", "first refusal"},
      rows, [](const Row& r, const auto& add) {
        add(r.setting.axis, r.setting.value, r.subject, r.triangles, r.cases,
            r.answers, r.refusals, r.wrong, r.worst, r.seconds, r.refusal);
      });
  program->Write("degradation.csv", ToCsv(table));
  program->Finish(1, "degradation_measured.txt");
  return 0;
}

}  // namespace phongpd::bench
