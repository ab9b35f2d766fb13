// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: continuity against what is possible.  Every jump of every metric on
// held motions, of which kind it is, and the least number of jumps that any
// rule could have on the same motions.  Writes CSV, SVG and continuity.md.
#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <numeric>
#include <sstream>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/pictures/gnuplot.h"
#include "results/bench/jump_classes.h"
#include "results/bench/program.h"
#include "results/bench/yardstick.h"

namespace phongpd::bench {
namespace {

struct Options {
  std::string directory;
  int motions = 10;
  int frames = 200;
  std::uint64_t seed = 2;
};

// A metric, or the yardstick for some c, on one contact space or all of them.
struct Row {
  std::string space, rule;
  int frames = 0;  // inside
  int jumps = 0;
  std::array<int, kJumpClasses> classes = {};  // of metrics
  bool is_bound = false;
  double ratio = 0.0;          // c of a bound
  std::vector<double> ratios;  // of metrics: depth over Euclidean depth

  double Mean() const {
    return is_bound
               ? ratio
               : std::accumulate(ratios.begin(), ratios.end(), 0.0) /
                     std::max<double>(1.0, static_cast<double>(ratios.size()));
  }
};

const std::vector<double>& Ratios() {
  static const std::vector<double> ratios = {1.1, 1.33, 1.5, 2.0, 3.0};
  return ratios;
}

struct Case {
  const MotionSpace& space;
  std::vector<Motion> motions;
  std::vector<std::vector<double>> depths;
};

Row Follow(const Case& held, const std::string& name,
           const BeginFollowing& begin, bool has_branches) {
  const double jump = kMotionJump * held.space.contact.length();
  Row row;
  row.space = held.space.name;
  row.rule = name;
  for (std::size_t m = 0; m < held.motions.size(); ++m) {
    const Motion& motion = held.motions[m];
    Follower follow = begin();
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const Follower before = follow;
      const MotionStep step = follow(motion[i]);
      if (held.depths[m][i] > 0.0) {
        ++row.frames;
        row.ratios.push_back(step.pd.norm() / held.depths[m][i]);
      }
      if (i > 0 && (step.pd - last).norm() > jump) {
        ++row.jumps;
        const JumpClass kind = ClassOfJump(before, motion[i - 1], motion[i],
                                           last, jump, has_branches);
        ++row.classes[static_cast<std::size_t>(kind)];
      }
      last = step.pd;
    }
  }
  return row;
}

std::vector<Row> MeasureSpace(const MotionSpace& space,
                              const Options& options) {
  const EuclideanMetric euclidean(space.contact);
  Case held{
      space,
      MakeMotions(space.contact, options.motions, options.frames, options.seed),
      {}};
  for (const Motion& motion : held.motions) {
    held.depths.push_back(EuclideanDepths(euclidean, motion));
  }
  std::vector<Row> rows;
  rows.push_back(Follow(held, "euclidean", FollowMetric(euclidean), false));
  for (const double ell : {0.0, 0.1, 0.2}) {
    PhongMetricOptions phong;
    phong.field_options.smoothing_length = ell;
    const PhongMetric metric(space.contact, phong);
    rows.push_back(
        Follow(held, "phong@" + Rounded(ell), FollowMetric(metric), true));
  }
  const PenetrationTracker tracker(space.contact);
  rows.push_back(Follow(held, "tracker", FollowTracker(tracker), true));
  const Yardstick yardstick(space.contact);
  std::vector<int> least(Ratios().size(), 0);
  for (std::size_t m = 0; m < held.motions.size(); ++m) {
    const std::vector<int> of_motion =
        yardstick.LeastJumps(held.motions[m], held.depths[m], Ratios());
    for (std::size_t c = 0; c < least.size(); ++c) least[c] += of_motion[c];
  }
  for (std::size_t c = 0; c < least.size(); ++c) {
    Row row;
    row.space = space.name;
    row.rule = "any rule, c = " + Rounded(Ratios()[c]);
    row.frames = rows.front().frames;
    row.jumps = least[c];
    row.is_bound = true;
    row.ratio = Ratios()[c];
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> Totals(const std::vector<Row>& rows) {
  std::vector<Row> totals;
  for (const Row& row : rows) {
    if (row.space.find("hollow") != std::string::npos) continue;
    auto same = std::find_if(totals.begin(), totals.end(),
                             [&](const Row& r) { return r.rule == row.rule; });
    if (same == totals.end()) {
      totals.push_back(row);
      totals.back().space = "all but the hollow box";
      continue;
    }
    same->frames += row.frames;
    same->jumps += row.jumps;
    for (std::size_t k = 0; k < same->classes.size(); ++k) {
      same->classes[k] += row.classes[k];
    }
    same->ratios.insert(same->ratios.end(), row.ratios.begin(),
                        row.ratios.end());
  }
  return totals;
}

Table RowTable(const std::vector<Row>& rows) {
  return MakeTable(
      "Jumps and what they are",
      "A jump: PD changes by more than 5 % of D between two frames. Fold "
      "inside: the answer is not continuous there (a branch ends and says so; "
      "the nearest point flips). Exit elsewhere: the robot leaves far from its "
      "contact. Steep: no jump where the step is divided by 32768. Ratio: "
      "depth over Euclidean depth; of `any rule` it is the bound c that holds "
      "at every frame.",
      {"contact space", "rule", "frames inside", "jumps", "fold inside",
       "exit elsewhere", "steep", "bug", "mean ratio", "99 %"},
      rows, [](const Row& r, const auto& add) {
        const std::string none = "–";
        const auto count = [&](int k) {
          return r.is_bound ? none
                            : Shown(r.classes[static_cast<std::size_t>(k)]);
        };
        add(r.space, r.rule, r.frames, r.jumps, count(0), count(1), count(2),
            count(3), r.is_bound ? "≤ " + Rounded(r.ratio) : Rounded(r.Mean()),
            r.is_bound ? none : Rounded(Quantile(r.ratios, 0.99)));
      });
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
              << " \"" << r.rule << "\"\n";
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
          "'least of any rule', $m using 1:2:1:3 with xerrorbars pt 7 ps 1.2 "
          "lc rgb '#0060B0' notitle, $m using 1:2:4 with labels left offset "
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

constexpr char kIntroduction[] =
    R"(# Continuity against what is possible

Every jump of every metric on the same motions, of which kind it is, and beside
them the least number of jumps that *any* rule could have whose depth is at most
c times the Euclidean one at every frame, with hindsight even. That is a lower
bound: pieces of the surface in reach, carried from frame to frame
(`results/bench/yardstick.h`). A metric may be below the bound of a c where its
own depth is, at some frames, more than c times the Euclidean one.

)";

int Run(int argc, char** argv) {
  CLI::App app("Continuity against what is possible.");
  Options options;
  app.add_option("--output", options.directory, "Directory to write into")
      ->required();
  app.add_option("--motions", options.motions)->capture_default_str();
  app.add_option("--frames", options.frames)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  RequireGnuplot();
  std::vector<Row> rows;
  for (const MotionSpace& space : MotionSpaces()) {
    const std::vector<Row> of_space = MeasureSpace(space, options);
    rows.insert(rows.end(), of_space.begin(), of_space.end());
    std::cerr << space.name << std::endl;
  }
  const std::vector<Row> totals = Totals(rows);
  const Table all = RowTable(totals);
  const Table each = RowTable(rows);
  OutputDirectory out(options.directory);
  out.Write("continuity.csv", ToCsv(each));
  out.Write("continuity.svg", Draw(totals));
  Table shown = all;
  shown.title = "Contact spaces together";
  out.Write(
      "continuity.md",
      kIntroduction + Findings(totals) +
          "\n![Jumps against depth: what any rule must have, and what each "
          "metric has.](continuity.svg)\n\n" +
          ToMarkdown(shown) + "\n" + ToMarkdown(each) +
          "\nRows: [continuity.csv](continuity.csv)\n\n" +
          Circumstances(CommandLine("build/continuity_benchmark", argc, argv),
                        options.seed) +
          "\n");
  out.Commit();
  std::cout << ToText(all);
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("continuity_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
