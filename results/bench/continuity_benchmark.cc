// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: continuity against what is possible.  Every jump of every metric on
// held motions, of which kind it is, and the least number of jumps that any
// rule could have on the same motions.  Writes CSV, SVG and continuity.md.
#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "problems/output/gnuplot.h"
#include "problems/output/metric_color.h"
#include "results/bench/continuity_measure.h"
#include "results/bench/model_spaces.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

using Row = ContinuityRow;

constexpr char kProcedural[] = "procedural";
constexpr char kModels[] = "models";

Table RowTable(const std::vector<Row>& rows) {
  return MakeTable(
      "Jumps and what they are",
      "A jump: PD changes by more than 5 % of D between two frames. Fold "
      "inside: the answer is not continuous there (a branch ends and says so; "
      "the nearest point flips). Exit elsewhere: the robot leaves far from its "
      "contact. Steep: no jump where the step is divided by 32768. Ratio: "
      "depth over Euclidean depth; of `any rule` it is the bound c that holds "
      "at every frame.",
      {"contact space", "motions", "rule", "frames inside", "jumps",
       "fold inside", "exit elsewhere", "steep", "bug", "mean ratio", "99 %"},
      rows, [](const Row& r, const auto& add) {
        const std::string none = "–";
        const auto count = [&](int k) {
          return r.is_bound ? none
                            : Shown(r.classes[static_cast<std::size_t>(k)]);
        };
        add(r.space, r.motions, r.rule, r.frames, r.jumps, count(0), count(1),
            count(2), count(3),
            r.is_bound ? "≤ " + Rounded(r.ratio) : Rounded(r.Mean()),
            r.is_bound ? none : Rounded(Quantile(r.ratios, 0.99)));
      });
}

// Of the metric that a rule is of, as gnuplot's "rgb variable" has it.
unsigned long ColorOf(const std::string& rule) {
  const std::string color = rule == "euclidean" ? kEuclideanColor
                            : rule == "tracker" ? kSlidingColor
                                                : kPhongColor;
  return std::stoul(color.substr(1), nullptr, 16);
}

// Jumps in 1000 frames against the ratio: bounds as a line, metrics as points
// at their mean with a bar to the 99 % quantile.
std::string Draw(const std::vector<Row>& totals) {
  std::ostringstream bound, metrics;
  for (const Row& r : totals) {
    const double often = 1e3 * r.jumps / std::max(1, r.frames);
    if (r.is_bound) {
      bound << r.ratio << ' ' << often << '\n';
    } else {
      metrics << r.Mean() << ' ' << often << ' ' << Quantile(r.ratios, 0.99)
              << " \"" << r.rule << "\" " << ColorOf(r.rule) << '\n';
    }
  }
  return RenderSvg(
      "$b << EOD\n" + bound.str() + "EOD\n$m << EOD\n" + metrics.str() +
          "EOD\nset termoption noenhanced\nset grid lc rgb '#DDDDDD'\n"
          "set logscale x\nset xrange [0.97:12]\nset yrange [-0.1:*]\n"
          "set xtics (1, 1.1, 1.33, 1.5, 2, 3, 5, 10)\n"
          "set xlabel 'depth / Euclidean depth: bound of any rule; mean of a "
          "metric, bar to 99 %'\nset ylabel 'jumps in 1000 frames'\n"
          "plot $b using 1:2 with linespoints lw 2 pt 7 lc rgb '#808080' title "
          "'least of any rule', $m using 1:2:1:3:5 with xerrorbars pt 7 ps 1.2 "
          "lc rgb variable notitle, $m using 1:2:4 with labels left offset "
          "0.5,0.7 notitle\n",
      900, 520);
}

std::string Findings(const std::vector<Row>& totals) {
  std::string text;
  int bugs = 0;
  for (const Row& r : totals) bugs += r.classes[3];
  for (const Row& r : totals) {
    text += "- " + r.rule + ": " + std::to_string(r.jumps) + " jumps in " +
            std::to_string(r.frames) + " frames";
    text += r.is_bound ? " at least.\n"
                       : " at " + Rounded(r.Mean()) +
                             " times the Euclidean depth on the average.\n";
  }
  return text +
         "- Jumps that none of the kinds explains: " + std::to_string(bugs) +
         ".\n";
}

std::string NamesOf(const std::vector<MotionSpace>& spaces) {
  std::string names;
  for (const MotionSpace& space : spaces) {
    names += (names.empty() ? "" : ", ") + space.name + " (" +
             std::to_string(space.contact.mesh().triangles.size()) + ")";
  }
  return names;
}

// What was measured, and what was not there.
std::string Contents(const std::vector<MotionSpace>& procedural,
                     const std::vector<MotionSpace>& models,
                     const std::vector<std::string>& missing) {
  std::string text =
      "Contact spaces (triangles), procedural: " + NamesOf(procedural) +
      ". Models that others made: " +
      (models.empty() ? "none" : NamesOf(models)) + ".";
  if (!missing.empty()) {
    text += " Not there:";
    for (const std::string& file : missing) text += " " + file;
    text += ".";
  }
  return text +
         " Motions: straight and curved ways between interior points, and "
         "random walks.\n\n";
}

// The hollow box counted with the others.
std::string OnAllSpaces(const std::vector<Row>& rows) {
  std::vector<std::string> rules;
  std::set<std::string> spaces;
  std::map<std::string, std::pair<int, int>> sums;  // jumps, frames
  for (const Row& row : rows) {
    spaces.insert(row.space);
    if (sums.count(row.rule) == 0) rules.push_back(row.rule);
    sums[row.rule].first += row.jumps;
    sums[row.rule].second += row.frames;
  }
  std::string text;
  for (const std::string& rule : rules) {
    text += (text.empty() ? "- All of this is without the hollow box. On all " +
                                Shown(spaces.size()) + " spaces, jumps in " +
                                Shown(sums[rule].second) + " frames: "
                          : std::string("; ")) +
            rule + " " + Shown(sums[rule].first);
  }
  return text + ".\n";
}

constexpr char kIntroduction[] =
    R"(# Continuity against what is possible

Every jump of every metric on the same motions, of which kind it is, and beside
them the least number of jumps that *any* rule could have whose depth is at most
c times the Euclidean one at every frame, with hindsight even. That is a lower
bound: pieces of the surface in reach, carried from frame to frame
(`results/bench/yardstick.h`). A metric may be below the bound of a c where its
own depth is, at some frames, more than c times the Euclidean one.

)";

// The totals, then those of procedural spaces and of models, by kind of motion.
std::vector<Row> Grouped(const std::vector<Row>& totals,
                         const std::vector<Row>& rows,
                         std::size_t first_of_models) {
  const std::vector<Row> of_models(
      rows.begin() + static_cast<std::ptrdiff_t>(first_of_models), rows.end());
  const std::vector<Row> of_procedural(
      rows.begin(),
      rows.begin() + static_cast<std::ptrdiff_t>(first_of_models));
  std::vector<Row> grouped = totals;
  for (const auto& [name, members] :
       {std::make_pair(kProcedural, &of_procedural),
        std::make_pair(kModels, &of_models)}) {
    for (const char* kind : {kWays, kWalks}) {
      std::vector<Row> own;
      std::copy_if(members->begin(), members->end(), std::back_inserter(own),
                   [&](const Row& row) { return row.motions == kind; });
      const std::vector<Row> group = TotalsOf(own, name, kind);
      grouped.insert(grouped.end(), group.begin(), group.end());
    }
  }
  return grouped;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("Continuity against what is possible.");
  ContinuityOptions options;
  std::string folder;
  app.add_option("--models", folder,
                 "Folder of models (scripts/models.sh); if not set, without");
  app.add_option("--motions", options.motions, "Of each kind, a space")
      ->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();
  RequireGnuplot();
  const std::vector<MotionSpace> procedural = MotionSpaces();
  std::vector<std::string> missing;
  std::vector<MotionSpace> models;
  if (!folder.empty()) models = ModelSpaces(folder, &missing);
  std::vector<Row> rows;
  const auto measure = [&](const MotionSpace& space) {
    const std::vector<Row> of_space = MeasureContinuity(space, options);
    rows.insert(rows.end(), of_space.begin(), of_space.end());
    std::cerr << space.name << std::endl;
  };
  for (const MotionSpace& space : procedural) measure(space);
  const std::size_t first_of_models = rows.size();
  for (const MotionSpace& space : models) measure(space);
  const std::vector<Row> totals = TotalsOf(rows, "all", "all");
  Table shown = RowTable(Grouped(totals, rows, first_of_models));
  shown.title = "Contact spaces together, all but the hollow box";
  program->Write("continuity.csv", ToCsv(RowTable(rows)));
  program->Write("continuity.svg", Draw(totals));
  program->Write(
      "continuity.md",
      kIntroduction + Contents(procedural, models, missing) + Findings(totals) +
          OnAllSpaces(rows) +
          "\n![Jumps against depth: what any rule must have, and what each "
          "metric has.](continuity.svg)\n\n" +
          ToMarkdown(shown) +
          "\nSpace by space, the hollow box with them: "
          "[continuity.csv](continuity.csv)\n\n" +
          program->Circumstances(options.seed) + "\n");
  program->Commit();
  std::cout << ToText(shown);
  return 0;
}

}  // namespace phongpd::bench
