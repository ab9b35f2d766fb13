// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/trajectory_comparison.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/gnuplot.h"
#include "problems/text.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

PipelineOptions OneSolve(TrajectoryStart start, bool is_adaptive) {
  PipelineOptions options;
  options.start = start;
  options.polish = PolishWhen::kNever;
  // The study's two settings: plain Ipopt, and what closes most of the gap.
  using Mu = IpoptSettings::MuStrategy;
  options.optimizer.ipopt.mu_strategy =
      is_adaptive ? Mu::kAdaptive : Mu::kMonotone;
  options.optimizer.ipopt.stall_stop = is_adaptive;
  const bool is_repaired = start == TrajectoryStart::kRepaired;
  options.optimizer.rows = is_adaptive && is_repaired ? 3 : 1;
  return options;
}

std::string Text(const Json& row, const char* key) {
  return row.at(key).get<std::string>();
}

// A number by its path, "seconds/total".
double Number(const Json& row, const std::string& path) {
  return row.at(Json::json_pointer("/" + path)).get<double>();
}

using CellKey = std::array<std::string, 3>;
using ProblemKey = std::pair<std::string, long>;

CellKey KeyOf(const Json& row) {
  return {Text(row, "scene"), Text(row, "protocol"), Text(row, "method")};
}
ProblemKey ProblemOf(const Json& row) {
  return {Text(row, "scene"), row.at("seed").get<long>()};
}

// The best objective of an exactly free path, by scene and seed.
std::map<ProblemKey, double> BestObjectives(const std::vector<Json>& rows) {
  std::map<ProblemKey, double> best;
  for (const Json& row : rows) {
    if (!row.at("collision_free").get<bool>()) continue;
    const double objective = Number(row, "objective");
    const auto [it, is_new] = best.emplace(ProblemOf(row), objective);
    if (!is_new) it->second = std::min(it->second, objective);
  }
  return best;
}

ComparisonCell Summarize(const CellKey& key,
                         const std::vector<const Json*>& rows,
                         const std::map<ProblemKey, double>& best) {
  ComparisonCell cell;
  cell.scene = key[0];
  cell.protocol = key[1];
  cell.method = key[2];
  cell.runs = static_cast<int>(rows.size());
  std::vector<double> iterations, seconds;
  double all = 0.0, restoration = 0.0, callbacks = 0.0, total = 0.0;
  cell.least_clearance = std::numeric_limits<double>::infinity();
  for (const Json* row : rows) {
    const bool is_solved = row->at("solved").get<bool>();
    const bool is_free = row->at("collision_free").get<bool>();
    cell.solved += is_solved;
    cell.stalled +=
        is_solved && Text(*row, "status_class") == "stalled_feasible";
    cell.free_only += is_free && !is_solved;
    cell.claims_only += row->at("solver_claims_solved").get<bool>() &&
                        !row->at("solver_path_free").get<bool>();
    iterations.push_back(Number(*row, "iterations"));
    seconds.push_back(Number(*row, "seconds/total"));
    all += iterations.back();
    restoration += Number(*row, "restoration_iterations");
    callbacks += Number(*row, "seconds/callbacks");
    total += seconds.back();
    if (!is_solved) continue;
    const double ratio = Number(*row, "objective") / best.at(ProblemOf(*row));
    ++cell.rivals;
    cell.mean_ratio += ratio;
    cell.within_2_percent += ratio <= 1.02;
    cell.within_10_percent += ratio <= 1.1;
    cell.least_clearance =
        std::min(cell.least_clearance, Number(*row, "clearance"));
  }
  if (cell.rivals > 0) {
    cell.mean_ratio /= cell.rivals;
  } else {
    cell.least_clearance = 0.0;
  }
  cell.median_iterations = Median(iterations);
  cell.median_seconds = Median(seconds);
  cell.restoration_share = all > 0.0 ? restoration / all : 0.0;
  cell.callback_share = total > 0.0 ? callbacks / total : 0.0;
  return cell;
}

}  // namespace

const std::vector<TrajectoryProtocol>& TrajectoryProtocols() {
  using Start = TrajectoryStart;
  static const std::vector<TrajectoryProtocol> protocols = {
      {"straight-monotone",
       "straight start, Ipopt's monotone mu, no stall stop, 1 row a sample",
       OneSolve(Start::kStraight, false), true},
      {"straight-adaptive",
       "straight start, adaptive mu, stall stop, 1 row a sample",
       OneSolve(Start::kStraight, true), true},
      {"repaired-monotone",
       "repaired start, monotone mu, no stall stop, 1 row a sample",
       OneSolve(Start::kRepaired, false), true},
      {"repaired-adaptive",
       "repaired start, adaptive mu, stall stop, 3 rows a sample",
       OneSolve(Start::kRepaired, true), true},
      {"pipeline",
       "the default of optimize: repair, Ipopt, judge, corridor where needed",
       PipelineOptions(), false},
  };
  return protocols;
}

const TrajectoryProtocol& FindProtocol(const std::string& name) {
  std::string names;
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    if (protocol.name == name) return protocol;
    names += (names.empty() ? "" : ", ") + protocol.name;
  }
  throw InputError("--protocols: expected some of " + names + "; found '" +
                   name + "'");
}

std::vector<ComparisonCell> Summarize(const std::vector<Json>& rows) {
  std::vector<CellKey> order;
  std::map<CellKey, std::vector<const Json*>> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    try {
      std::vector<const Json*>& cell = cells[KeyOf(rows[i])];
      if (cell.empty()) order.push_back(KeyOf(rows[i]));
      cell.push_back(&rows[i]);
    } catch (const Json::exception& error) {
      throw InputError("row " + std::to_string(i + 1) +
                       ": expected a row of phongpd compare, found " +
                       error.what());
    }
  }
  const std::map<ProblemKey, double> best = BestObjectives(rows);
  std::vector<ComparisonCell> result;
  for (const CellKey& key : order) {
    result.push_back(Summarize(key, cells[key], best));
  }
  return result;
}

std::string ComparisonCsv(const std::vector<ComparisonCell>& cells) {
  std::ostringstream csv;
  csv << "scene,protocol,method,runs,solved,stalled,free_not_solved,"
         "claims_but_collides,median_iterations,restoration_share,"
         "median_seconds,callback_share,mean_objective_ratio,within_2_percent,"
         "within_10_percent,least_clearance\n";
  for (const ComparisonCell& c : cells) {
    csv << c.scene << ',' << c.protocol << ',' << c.method << ',' << c.runs
        << ',' << c.solved << ',' << c.stalled << ',' << c.free_only << ','
        << c.claims_only << ',' << Rounded(c.median_iterations, 4) << ','
        << Rounded(c.restoration_share) << ',' << Rounded(c.median_seconds)
        << ',' << Rounded(c.callback_share) << ',' << Rounded(c.mean_ratio, 5)
        << ',' << c.within_2_percent << ',' << c.within_10_percent << ','
        << Rounded(c.least_clearance) << '\n';
  }
  return csv.str();
}

std::string PerformanceProfile(const std::vector<Json>& rows,
                               const std::string& protocol,
                               const std::string& measure) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::map<ProblemKey, std::map<std::string, double>> problems;
  std::vector<std::string> methods;
  for (const Json& row : rows) {
    if (Text(row, "protocol") != protocol) continue;
    const std::string method = Text(row, "method");
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) {
      methods.push_back(method);
    }
    problems[ProblemOf(row)][method] =
        row.at("solved").get<bool>() ? std::max(1e-9, Number(row, measure))
                                     : kNever;
  }
  std::map<std::string, std::vector<double>> ratios;
  for (const auto& [problem, values] : problems) {
    double best = kNever;
    for (const auto& entry : values) best = std::min(best, entry.second);
    for (const auto& [method, value] : values) {
      if (value < kNever) ratios[method].push_back(value / best);
    }
  }
  std::ostringstream script;
  std::string plots;
  int block = 0;
  for (const std::string& method : methods) {
    std::vector<double>& sorted = ratios[method];
    std::sort(sorted.begin(), sorted.end());
    script << "$m" << block << " << EOD\n1 0\n";
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      script << FormatDouble(sorted[i]) << ' '
             << static_cast<double>(i + 1) /
                    static_cast<double>(problems.size())
             << '\n';
    }
    script << "100 "
           << static_cast<double>(sorted.size()) /
                  static_cast<double>(problems.size())
           << "\nEOD\n";
    plots += (plots.empty() ? "plot $m" : ", $m") + std::to_string(block) +
             " using 1:2 with steps lw 2 title '" + method + "'";
    ++block;
  }
  script << "set logscale x\nset xrange [1:100]\nset yrange [0:1]\n"
         << "set xlabel '" << measure << " over the least of all methods'\n"
         << "set ylabel 'share of problems solved'\n"
         << "set key right bottom\nset title '" << protocol << ", "
         << problems.size() << " problems'\n"
         << plots << '\n';
  return RenderSvg(script.str(), 720, 440);
}

std::string CompactCsv(const std::vector<Json>& rows) {
  std::ostringstream csv;
  csv << "scene,protocol,method,seed,status,status_class,solved,"
         "solver_claims_solved,collision_free,iterations,"
         "restoration_iterations,jacobian_evaluations,objective,inf_pr,inf_du,"
         "clearance,branch_ends,seconds_callbacks,seconds_total\n";
  for (const Json& row : rows) {
    csv << Text(row, "scene") << ',' << Text(row, "protocol") << ','
        << Text(row, "method") << ',' << row.at("seed") << ','
        << Text(row, "status") << ',' << Text(row, "status_class") << ','
        << row.at("solved") << ',' << row.at("solver_claims_solved") << ','
        << row.at("collision_free") << ',' << row.at("iterations") << ','
        << row.at("restoration_iterations") << ','
        << row.at("evaluations").at("jacobian") << ','
        << Rounded(Number(row, "objective"), 8) << ','
        << Rounded(Number(row, "inf_pr")) << ','
        << Rounded(Number(row, "inf_du")) << ','
        << Rounded(Number(row, "clearance"), 4) << ','
        << row.at("queries").at("branch_ends") << ','
        << Rounded(Number(row, "seconds/callbacks")) << ','
        << Rounded(Number(row, "seconds/total")) << '\n';
  }
  return csv.str();
}

std::vector<Json> ReadComparison(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": expected rows, found no such file");
  std::vector<Json> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    Json row = Json::parse(line, nullptr, false);
    if (!row.is_object()) {
      throw InputError(path + ": row " + std::to_string(rows.size() + 1) +
                       ": expected a JSON object, found " + line.substr(0, 40));
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError(path + ": expected rows, found none");
  return rows;
}

}  // namespace phongpd
