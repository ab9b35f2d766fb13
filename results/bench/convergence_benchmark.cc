// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: from the rows of `phongpd compare`, the tables, figures and README
// of results/convergence; measures besides what smoothing costs in depth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "core/mesh/input_file.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "planners/world/world.h"
#include "problems/output/gnuplot.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/random_solids.h"
#include "results/bench/convergence_report.h"
#include "results/bench/csv_table.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

constexpr double kSmoothingLengths[] = {0.0, 0.02, 0.05, 0.1, 0.2, 0.3};
constexpr std::uintmax_t kMaxPage = std::uintmax_t{1} << 24;
constexpr double kDegrees = 57.29577951308232;

std::vector<Eigen::Vector3d> InteriorPoints(const TriangleMesh& mesh,
                                            const EuclideanMetric& metric,
                                            int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const BoundingBox box = ComputeBounds(mesh);
  std::vector<Eigen::Vector3d> points;
  // Thin solids fill little of their box.
  for (int i = 0; i < 1000 * count && static_cast<int>(points.size()) < count;
       ++i) {
    const Eigen::Vector3d q = RandomPoint(box, &random);
    if (metric.Query(q).inside) points.push_back(q);
  }
  return points;
}

DepthExcess Measure(const std::string& scene, const ContactSpace& space,
                    double ell, const std::vector<Eigen::Vector3d>& points,
                    const EuclideanMetric& euclid) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = ell;
  const PhongMetric phong(space, options);
  DepthExcess excess;
  excess.scene = scene;
  excess.smoothing_length = ell;
  excess.mean = 0.0;
  std::vector<double> angles;
  for (const Eigen::Vector3d& q : points) {
    const PenetrationResult p = phong.Query(q);
    const double ratio = p.signed_distance / euclid.Query(q).signed_distance;
    excess.mean += ratio / static_cast<double>(points.size());
    excess.worst = std::max(excess.worst, ratio);
    const double length = p.gradient.norm();
    if (!(length > 0.0)) continue;
    // The gradient of the signed value points outward, as the direction does.
    const double cosine = p.gradient.dot(p.direction) / length;
    angles.push_back(kDegrees * std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  excess.median_angle = Quantile(angles, 0.5);
  excess.worst_angle = Quantile(angles, 1.0);
  const PhongField& field = phong.field();
  excess.limited_share = static_cast<double>(field.report.limited_vertices) /
                         static_cast<double>(field.mesh.vertices.size());
  return excess;
}

std::vector<DepthExcess> MeasureAll(const std::vector<std::string>& scenes,
                                    int points, std::uint64_t seed) {
  std::vector<DepthExcess> all;
  for (const std::string& label : scenes) {
    std::cerr << label << '\n';
    const Scene scene = SceneSource(label).Load();
    const World world(scene.workspace, scene.name);
    const ContactSpace& space =
        world.Spaces(SpaceLayout::kMerged).spaces.front();
    const EuclideanMetric euclid(space);
    const std::vector<Eigen::Vector3d> inside =
        InteriorPoints(space.mesh(), euclid, points, seed);
    for (const double ell : kSmoothingLengths) {
      all.push_back(Measure(label, space, ell, inside, euclid));
    }
  }
  return all;
}

// What was published: rows and cells as far as their CSV tells of them.
ConvergenceResults ReadPublished(const std::string& directory) {
  ConvergenceResults results;
  const CsvTable rows = ReadCsvTable(directory + "/rows.csv");
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    nlohmann::ordered_json& row = results.rows.emplace_back();
    for (const char* key : {"scene", "protocol", "method"}) {
      row[key] = rows.Text(i, key);
    }
    for (const char* key : {"solved", "collision_free"}) {
      row[key] = rows.Text(i, key) == "true";
    }
    row["seed"] = static_cast<long>(rows.Number(i, "seed"));
    for (const char* key :
         {"iterations", "restoration_iterations", "objective"}) {
      row[key] = rows.Number(i, key);
    }
    row["queries"]["branch_ends"] = rows.Number(i, "branch_ends");
  }
  const CsvTable summary = ReadCsvTable(directory + "/summary.csv");
  for (std::size_t i = 0; i < summary.rows().size(); ++i) {
    ComparisonCell& cell = results.cells.emplace_back();
    cell.scene = summary.Text(i, "scene");
    cell.protocol = summary.Text(i, "protocol");
    cell.method = summary.Text(i, "method");
    cell.runs = static_cast<int>(summary.Number(i, "runs"));
    cell.solved = static_cast<int>(summary.Number(i, "solved"));
    cell.stalled = static_cast<int>(summary.Number(i, "stalled"));
    cell.free_only = static_cast<int>(summary.Number(i, "free_not_solved"));
    cell.median_iterations = summary.Number(i, "median_iterations");
  }
  const CsvTable excess = ReadCsvTable(directory + "/excess.csv");
  for (std::size_t i = 0; i < excess.rows().size(); ++i) {
    DepthExcess& row = results.excess.emplace_back();
    row.scene = excess.Text(i, "scene");
    row.smoothing_length = excess.Number(i, "ℓ");
    row.mean = excess.Number(i, "mean excess");
  }
  return results;
}

// Of the page: from `begin` up to what follows it, `end`, comes out as `text`.
void Replace(const std::string& begin, const std::string& end,
             const std::string& text, const std::string& name,
             std::string* page) {
  const std::size_t from = page->find(begin);
  const std::size_t to =
      from == std::string::npos ? from : page->find(end, from);
  if (to == std::string::npos) {
    throw InputError(name + ": expected \"" + begin + "\" and then \"" + end +
                     "\", found no such part; publish all with --rows");
  }
  page->replace(from, to - from, text);
}

constexpr char kIntroduction[] =
    R"(# Convergence of the trajectory optimiser: PhongPD beside Euclidean PD

Only the metric inside obstacles differs between the columns of a table: the
same contact spaces, the same rows outside (Euclidean distance), the same seeds,
the same Ipopt. "Solved" always means exactly free by the segment test on the
contact space, whatever the solver claims; it adds up what converged and what
ended in a stall stop (the s of the tables), which the lines below tell apart. A
round of Ipopt is stopped after 200 iterations, a run after 4 rounds. Seeds draw
start and goal such that the straight line collides. Code was written on other
seeds, but ℓ, the rows a sample and when to polish were chosen by what these
scenes and seeds showed.

All raw rows: [rows.csv](rows.csv); per scene and method: [summary.csv](summary.csv).
The pipeline with each metric, and its time before and after it was condensed:
[pipeline.md](pipeline.md).

)";

// Which protocols were not run on all scenes.
std::string Gaps(const std::vector<ComparisonCell>& cells) {
  std::set<std::string> all;
  std::map<std::string, std::set<std::string>> of_protocol;
  for (const ComparisonCell& c : cells) {
    all.insert(c.scene);
    of_protocol[c.protocol].insert(c.scene);
  }
  std::string text;
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    const std::size_t there = of_protocol[protocol.name].size();
    if (there == all.size()) continue;
    text += (text.empty() ? "Not run on all scenes: " : std::string(", ")) +
            protocol.name + " (" + std::to_string(there) + " of " +
            std::to_string(all.size()) + ")";
  }
  return text.empty() ? text : text + ".\n\n";
}

// All that rows.csv is enough for: not targets and profiles.
void Republish(const std::string& directory) {
  const ConvergenceResults results = ReadPublished(directory);
  OutputDirectory out(directory);
  for (const Figure& figure : TradeOffFigures(results)) {
    out.Write(figure.file, figure.svg);
  }
  const std::string readme = directory + "/README.md";
  const std::string tables = directory + "/tables.md";
  std::string said = ReadInputFile(readme, "published README", kMaxPage);
  Replace("# ", "## Targets", kIntroduction + Gaps(results.cells), readme,
          &said);
  Replace("## Won and lost", "Which part of", WonAndLost(results), readme,
          &said);
  std::string page = ReadInputFile(tables, "published tables", kMaxPage);
  for (const NamedTable& named :
       {NamedTable{"verdicts.csv", VerdictTable(results)},
        NamedTable{"what-helps.csv", WhatHelpsTable(results)},
        NamedTable{"losses.csv", LossTable(results)}}) {
    Replace("### " + named.table.title, "Rows: [" + named.file,
            ToMarkdown(named.table), tables, &page);
    out.Write(named.file, ToCsv(named.table));
  }
  out.Write("README.md", said);
  out.Write("tables.md", page);
  out.Commit();
}

int Run(int argc, char** argv) {
  CLI::App app("Tables and figures of results/convergence.");
  std::string directory, file, how;
  int points = 2000;
  std::uint64_t seed = 1;
  app.add_option(
      "--rows", file,
      "Rows of phongpd compare; without, paired tests, losses and trade-off "
      "are made anew from the rows.csv and summary.csv in the directory");
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--points", points)->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  app.add_option("--how", how, "The command that made the rows");
  CLI11_PARSE(app, argc, argv);
  RequireGnuplot();
  if (file.empty()) {
    Republish(directory);
    return 0;
  }
  ConvergenceResults results;
  results.rows = ReadComparison(file);
  results.cells = Summarize(results.rows);
  std::vector<std::string> scenes;
  for (const ComparisonCell& c : results.cells) {
    if (std::find(scenes.begin(), scenes.end(), c.scene) == scenes.end()) {
      scenes.push_back(c.scene);
    }
  }
  results.excess = MeasureAll(scenes, points, seed);
  OutputDirectory out(directory);
  out.Write("rows.csv", CompactCsv(results.rows));
  out.Write("summary.csv", ComparisonCsv(results.cells));
  const std::vector<NamedTable> tables = Tables(results);
  const std::vector<Figure> figures = Figures(results);
  WriteReport(
      tables, figures,
      kIntroduction + Gaps(results.cells) + Findings(results) + '\n' +
          ToMarkdown(tables, figures) + '\n' +
          Circumstances(how.empty() ? CommandLine("build/convergence_benchmark",
                                                  argc, argv)
                                    : how,
                        seed),
      &out);
  out.Commit();
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("convergence_benchmark",
                                    phongpd::bench::Run, argc, argv);
}
