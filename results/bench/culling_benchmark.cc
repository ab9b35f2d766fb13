// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what culling occupied facets before they are arranged buys and
// costs: the same builds without it, with it, and as the library decides, in
// turn in one process and one thread.  Writes culling.csv into a directory, of
// which lazy_report.py makes culling.md.
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "core/contact/build_switches.h"
#include "problems/shapes/shapes.h"
#include "results/bench/free_space_measure.h"
#include "results/bench/program.h"
#include "tests/support/hidden_pairs.h"

namespace phongpd::bench {
namespace {

using internal::Culling;
using internal::CullingReport;

struct Options {
  int repeats = 3;
};

constexpr std::array kWays = {Culling::kNever, Culling::kAlways,
                              Culling::kWhereItPays};

struct Row {
  std::string name;
  std::size_t robot = 0, obstacle = 0, triangles = 0;
  CullingReport culled;
  bool is_chosen = false;
  std::array<std::size_t, kWays.size()> faces{};
  std::array<double, kWays.size()> seconds{};  // median
  std::array<double, kWays.size()> predicted{};
  bool is_same = true;

  double Share(std::size_t way) const { return seconds[way] / seconds[0]; }
};

Row Measure(const HiddenPair& pair, int repeats) {
  Row row;
  row.name = pair.name;
  row.robot = pair.robot.triangles.size();
  row.obstacle = pair.obstacle.triangles.size();
  std::array<std::vector<double>, kWays.size()> seconds;
  TriangleMesh first;
  for (int i = 0; i < repeats; ++i) {
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      CullingReport report;
      const double start = CpuSeconds();
      const ContactSpace space = internal::BuildSwitched(
          pair.robot, pair.obstacle, {}, {kWays[way]}, &report);
      seconds[way].push_back(CpuSeconds() - start);
      row.predicted[way] = space.report().predicted.seconds;
      row.faces[way] = space.report().arrangement_faces;
      row.triangles = space.report().triangles;
      if (kWays[way] == Culling::kAlways) row.culled = report;
      if (kWays[way] == Culling::kWhereItPays) row.is_chosen = report.was_tried;
      if (first.triangles.empty()) first = space.mesh();
      row.is_same = row.is_same && space.mesh().vertices == first.vertices &&
                    space.mesh().triangles == first.triangles;
    }
  }
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    row.seconds[way] = Quantile(seconds[way], 0.5);
  }
  return row;
}

NamedTable TableOf(const std::vector<Row>& rows) {
  return {
      "culling.csv",
      MakeTable({"pair", "triangles of A", "triangles of B", "facets", "culled",
                 "faces arranged without", "with", "triangles of C_cont",
                 "CPU s without", "with", "by default", "predicted s without",
                 "predicted s with", "with / without", "by default / without",
                 "culls by default", "same surface"},
                rows, [](const Row& r, const auto& add) {
                  add(r.name, r.robot, r.obstacle, r.culled.facets,
                      r.culled.dropped, r.faces[0], r.faces[1], r.triangles,
                      r.seconds[0], r.seconds[1], r.seconds[2], r.predicted[0],
                      r.predicted[1], r.Share(1), r.Share(2),
                      std::string(r.is_chosen ? "yes" : "no"),
                      std::string(r.is_same ? "yes" : "NO"));
                })};
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("Builds with and without culling: a table.");
  Options options;
  app.add_option("--repeats", options.repeats)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  program->Parse();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                1);
  std::vector<HiddenPair> pairs = HiddenPairs(2);
  pairs.push_back({"star + knot of 1536", MakeStar(0.5, 1.2),
                   MakeKnot(0.5, 0.225, 96, 8), true});
  pairs.push_back({"turned tube + tube of 900",
                   Rotated(Scaled(MakeHilbertTube(61), 0.6), GenericRotation()),
                   MakeHilbertTube(112), true});
  std::vector<Row> rows;
  for (const HiddenPair& pair : pairs) {
    rows.push_back(Measure(pair, options.repeats));
    std::cout << ToText(TableOf({rows.back()}).table) << std::endl;
  }
  program->Write({TableOf(rows)});
  program->Finish(1, "culling_measured.txt");
  return 0;
}

}  // namespace phongpd::bench
