// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/convergence_report.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "problems/output/gnuplot.h"
#include "problems/output/text.h"
#include "problems/studies/performance_profile.h"

namespace phongpd::bench {

namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<ComparisonCell>;

}  // namespace

const ComparisonCell* Find(const Cells& cells, const std::string& scene,
                           const std::string& protocol,
                           const std::string& method) {
  for (const ComparisonCell& c : cells) {
    if (c.scene == scene && c.protocol == protocol && c.method == method) {
      return &c;
    }
  }
  return nullptr;
}

std::string SolvedText(const ComparisonCell& c) {
  std::string text = Shown(c.solved) + "/" + Shown(c.runs);
  if (c.stalled > 0) text += " (" + Shown(c.stalled) + "s)";
  if (c.free_only > 0) text += " +" + Shown(c.free_only) + "f";
  if (c.claims_only > 0) text += " " + Shown(c.claims_only) + "c";
  return text;
}

namespace {

template <typename Key>
std::vector<std::string> Distinct(const Cells& cells, const Key& key) {
  std::vector<std::string> names;
  for (const ComparisonCell& c : cells) {
    const std::string name = key(c);
    if (name.empty()) continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

std::vector<std::string> Scenes(const Cells& cells) {
  return Distinct(cells, [](const ComparisonCell& c) { return c.scene; });
}

std::vector<std::string> Methods(const Cells& cells,
                                 const std::string& protocol) {
  return Distinct(cells, [&](const ComparisonCell& c) {
    return c.protocol == protocol ? c.method : std::string();
  });
}

std::string EffortText(const ComparisonCell& c) {
  return Rounded(c.median_iterations, 4) + " · " +
         Rounded(100.0 * c.restoration_share, 2) + " % · " +
         Rounded(1e3 * c.median_seconds) + " ms";
}

// Scenes by methods of one protocol.
template <typename Text>
Table Matrix(const Cells& cells, const std::string& protocol, std::string title,
             std::string note, const Text& text) {
  const std::vector<std::string> methods = Methods(cells, protocol);
  Table table{std::move(title), std::move(note), {"scene"}, {}};
  table.header.insert(table.header.end(), methods.begin(), methods.end());
  for (const std::string& scene : Scenes(cells)) {
    std::vector<std::string> row = {scene};
    bool has_run = false;
    for (const std::string& method : methods) {
      const ComparisonCell* c = Find(cells, scene, protocol, method);
      row.push_back(c == nullptr ? "–" : text(*c));
      has_run = has_run || c != nullptr;
    }
    if (has_run) table.rows.push_back(std::move(row));
  }
  return table;
}

// ℓ against depth excess, solved share and iterations, one curve a group.
std::string TradeOffFigure(const ConvergenceResults& results,
                           const std::string& protocol) {
  std::ostringstream script;
  std::string plots[3];
  int block = 0;
  for (const SceneGroup& group : SceneGroups()) {
    script << "$g" << block << " << EOD\n";
    std::map<double, std::array<double, 5>> points;
    for (const DepthExcess& e : results.excess) {
      if (!Belongs(e.scene, group)) continue;
      std::array<double, 5>& p = points[e.smoothing_length];
      p[0] += e.mean;
      p[1] += 1.0;
    }
    bool has_curve = false;
    for (auto& [ell, p] : points) {
      const std::string method = "phong@" + FormatDouble(ell);
      int cells = 0;
      for (const ComparisonCell& c : results.cells) {
        if (c.protocol != protocol || c.method != method ||
            !Belongs(c.scene, group)) {
          continue;
        }
        p[2] += c.solved;
        p[3] += c.runs;
        p[4] += c.median_iterations;
        ++cells;
      }
      if (cells == 0) continue;
      has_curve = true;
      script << ell << ' ' << p[0] / p[1] << ' ' << 100.0 * p[2] / p[3] << ' '
             << p[4] / cells << '\n';
    }
    script << "EOD\n";
    if (has_curve) {
      for (int k = 0; k < 3; ++k) {
        plots[k] += (plots[k].empty() ? "plot $g" : ", $g") +
                    std::to_string(block) +
                    " using 1:" + std::to_string(k + 2) +
                    " with linespoints lw 2 title '" + group.name + "'";
      }
    }
    ++block;
  }
  const char* const labels[3] = {"mean PhongPD / Euclidean PD", "solved, %",
                                 "median iterations"};
  // The curves leave no corner free for a key: it has a field of its own.
  script << "set multiplot layout 1,4 title '" << protocol << "'\n"
         << "set xlabel 'smoothing length / diagonal'\nset xtics 0.1\n"
         << "unset key\n";
  for (int k = 0; k < 3; ++k) {
    script << "set title '" << labels[k] << "'\n";
    if (k == 1) script << "set yrange [0:105]\n";
    if (k == 2) script << "set yrange [0:*]\n";
    script << plots[k] << '\n';
  }
  script << "unset title\nunset xlabel\nunset tics\nunset border\n"
         << "set key center left Left reverse\nset yrange [-2:-1]\n"
         << plots[0] << "\nunset multiplot\n";
  return RenderSvg(script.str(), 1200, 400);
}

}  // namespace

bool Belongs(const std::string& scene, const SceneGroup& group) {
  const bool is_scanned = scene.find("edge=") != std::string::npos;
  if (is_scanned != group.is_scanned) return false;
  const std::string family = scene.substr(0, scene.find(':'));
  return std::find(group.families.begin(), group.families.end(), family) !=
         group.families.end();
}

const std::vector<SceneGroup>& SceneGroups() {
  static const std::vector<SceneGroup> groups = {
      {"traps", {"u_axis", "u_trap", "l"}, false},
      {"plates", {"plate", "long_plate"}, false},
      {"scanned traps, plates",
       {"u_axis", "u_trap", "plate", "long_plate"},
       true},
      {"holes and tunnels", {"torus_hole", "peg_tunnel"}, false},
      {"other",
       {"cone_axes", "ball_wrench", "ball_convex", "clutter", "knot"},
       false}};
  return groups;
}

std::vector<NamedTable> Tables(const ConvergenceResults& results) {
  const Cells& cells = results.cells;
  std::vector<NamedTable> tables;
  const std::string key =
      " Solved / runs; s: of them by a stall stop, exactly free but not proved "
      "optimal; +f: exactly free, not solved; c: claimed solved but collides.";
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    if (Methods(cells, protocol.name).empty()) continue;
    tables.push_back(
        {protocol.name + "-solved.csv",
         Matrix(cells, protocol.name, protocol.name + ": solved",
                "Protocol: " + protocol.meaning + "." + key, SolvedText)});
    tables.push_back(
        {protocol.name + "-effort.csv",
         Matrix(cells, protocol.name, protocol.name + ": effort",
                "Median iterations · share of them in restoration · median "
                "time without the contact space.",
                EffortText)});
  }
  tables.push_back({"verdicts.csv", VerdictTable(results)});
  tables.push_back({"what-helps.csv", WhatHelpsTable(results)});
  tables.push_back({"losses.csv", LossTable(results)});
  tables.push_back(
      {"excess.csv",
       MakeTable(
           "What smoothing costs",
           "PhongPD over Euclidean PD at random interior points, and the "
           "angle between the Jacobian `direction` and the exact gradient.",
           {"scene", "ℓ", "mean excess", "worst", "limited vertices",
            "median angle", "worst angle"},
           results.excess, [](const DepthExcess& e, const auto& add) {
             add(e.scene, e.smoothing_length, Rounded(e.mean, 4), e.worst,
                 Rounded(100.0 * e.limited_share, 2) + " %",
                 Rounded(e.median_angle) + "°", Rounded(e.worst_angle) + "°");
           })});
  return tables;
}

std::vector<Figure> TradeOffFigures(const ConvergenceResults& results) {
  std::vector<Figure> figures;
  for (const char* name : {"straight-monotone", "straight-adaptive"}) {
    const std::string protocol = name;
    if (Methods(results.cells, protocol).empty()) continue;
    figures.push_back(
        {"trade-off-" + protocol + ".svg",
         "Speed against accuracy, " + protocol +
             ": what a longer smoothing length costs in depth (left) and gains "
             "in convergence from straight, colliding starts.",
         TradeOffFigure(results, protocol)});
  }
  return figures;
}

std::vector<Figure> Figures(const ConvergenceResults& results) {
  std::vector<Figure> figures = TradeOffFigures(results);
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    if (Methods(results.cells, protocol.name).size() < 2) continue;
    // Name, place in a row, in words.
    const std::array<const char*, 3> measures[] = {
        {"iterations", "iterations", "iterations"},
        {"jacobians", "evaluations/jacobian", "Jacobians"},
        {"seconds", "seconds/total", "seconds"}};
    for (const auto& [name, measure, words] : measures) {
      figures.push_back(
          {"profile-" + protocol.name + "-" + name + ".svg",
           "Performance profile (Dolan and Moré), " + protocol.name +
               ": the share of all problems solved with at most x times the "
               "fewest " +
               words + " of any metric.",
           PerformanceProfile(results.rows, protocol.name, measure),
           std::string(name) != "iterations"});
    }
  }
  return figures;
}

}  // namespace phongpd::bench
