// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/trajectory_comparison.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half]
                                : 0.5 * (values[half - 1] + values[half]);
}

PipelineOptions OneSolve(TrajectoryStart start, bool is_adaptive) {
  PipelineOptions options;
  options.start = start;
  options.polish = PolishWhen::kNever;
  // The study's two settings: plain Ipopt, and what closes most of the gap.
  using Mu = IpoptSettings::MuStrategy;
  options.optimizer.ipopt.mu_strategy =
      is_adaptive ? Mu::kAdaptive : Mu::kMonotone;
  if (!is_adaptive) options.optimizer.ipopt.stall_iterations = 0;
  options.also_line = false;
  const bool is_repaired = start == TrajectoryStart::kRepaired;
  options.optimizer.rows = is_adaptive && is_repaired ? 3 : 1;
  return options;
}

using CellKey = std::array<std::string, 3>;

CellKey KeyOf(const Json& row) {
  return {RowText(row, "scene"), RowText(row, "protocol"),
          RowText(row, "method")};
}
// The exactly free paths by scene and seed.
class Rivals {
 public:
  explicit Rivals(const std::vector<Json>& rows) {
    for (const Json& row : rows) {
      if (row.at("collision_free").get<bool>()) {
        paths_[ProblemOf(row)].push_back(PathOf(row));
      }
    }
  }

  // The least objective of those that keep as clear as this one, itself among
  // them.
  double BestObjective(const Json& row) const {
    const Rival own = PathOf(row);
    double best = own.objective;
    for (const Rival& rival : paths_.at(ProblemOf(row))) {
      if (rival.missing <= std::max(own.missing, kToleratedMissing)) {
        best = std::min(best, rival.objective);
      }
    }
    return best;
  }

 private:
  struct Rival {
    double objective, missing;
  };
  static Rival PathOf(const Json& row) {
    return {RowNumber(row, "objective"), RowNumber(row, "missing_clearance")};
  }

  std::map<ProblemKey, std::vector<Rival>> paths_;
};

ComparisonCell Summarize(const CellKey& key,
                         const std::vector<const Json*>& rows,
                         const Rivals& rivals) {
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
        is_solved && RowText(*row, "status_class") == "stalled_feasible";
    cell.free_only += is_free && !is_solved;
    cell.claims_only += row->at("solver_claims_solved").get<bool>() &&
                        !row->at("solver_path_free").get<bool>();
    iterations.push_back(RowNumber(*row, "iterations"));
    seconds.push_back(RowNumber(*row, "seconds/total"));
    all += iterations.back();
    restoration += RowNumber(*row, "restoration_iterations");
    callbacks += RowNumber(*row, "seconds/callbacks");
    total += seconds.back();
    if (!is_solved) continue;
    const double least = rivals.BestObjective(*row);
    // No way is shorter than that from a point to itself.
    const double ratio =
        least > 0.0 ? RowNumber(*row, "objective") / least : 1.0;
    ++cell.rivals;
    cell.mean_ratio += ratio;
    cell.within_2_percent += ratio <= 1.02;
    cell.within_10_percent += ratio <= 1.1;
    cell.least_clearance = std::min(cell.least_clearance,
                                    RowNumber(*row, "lengths/clearance/share"));
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
       OneSolve(Start::kStraight, false)},
      {"straight-adaptive",
       "straight start, adaptive mu, stall stop, 1 row a sample",
       OneSolve(Start::kStraight, true)},
      {"repaired-monotone",
       "repaired start, monotone mu, no stall stop, 1 row a sample",
       OneSolve(Start::kRepaired, false)},
      {"repaired-adaptive",
       "repaired start, adaptive mu, stall stop, 3 rows a sample",
       OneSolve(Start::kRepaired, true)},
      {"pipeline",
       "the default of optimize: repair, Ipopt, judge, corridor where needed",
       PipelineOptions()},
  };
  return protocols;
}

const TrajectoryProtocol& FindProtocol(const std::string& name) {
  std::vector<std::string> names;
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    if (protocol.name == name) return protocol;
    names.push_back(protocol.name);
  }
  throw InputError("--protocols: expected some of " + Joined(names) +
                   "; found '" + name + "'" + DidYouMean(name, names));
}

std::vector<ComparisonCell> Summarize(const std::vector<Json>& rows) {
  std::vector<CellKey> order;
  std::map<CellKey, std::vector<const Json*>> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CheckComparisonRow(rows[i], "row " + std::to_string(i + 1));
    std::vector<const Json*>& cell = cells[KeyOf(rows[i])];
    if (cell.empty()) order.push_back(KeyOf(rows[i]));
    cell.push_back(&rows[i]);
  }
  const Rivals rivals(rows);
  std::vector<ComparisonCell> result;
  for (const CellKey& key : order) {
    result.push_back(Summarize(key, cells[key], rivals));
  }
  return result;
}

std::string ComparisonCsv(const std::vector<ComparisonCell>& cells) {
  TextStream csv;
  csv << "scene,protocol,method,runs,solved,stalled,free_not_solved,"
         "claims_but_collides,median_iterations,restoration_share,"
         "median_seconds,callback_share,mean_objective_ratio,within_2_percent,"
         "within_10_percent,least_clearance\n";
  for (const ComparisonCell& c : cells) {
    csv << CsvCell(c.scene) << ',' << c.protocol << ',' << c.method << ','
        << c.runs << ',' << c.solved << ',' << c.stalled << ',' << c.free_only
        << ',' << c.claims_only << ',' << Rounded(c.median_iterations, 4) << ','
        << Rounded(c.restoration_share) << ',' << Rounded(c.median_seconds)
        << ',' << Rounded(c.callback_share) << ',' << Rounded(c.mean_ratio, 5)
        << ',' << c.within_2_percent << ',' << c.within_10_percent << ','
        << Rounded(c.least_clearance) << '\n';
  }
  return csv.str();
}

double ProfileCurve::Share(double factor) const {
  const auto end = std::upper_bound(ratios.begin(), ratios.end(), factor);
  return problems == 0 ? 0.0
                       : static_cast<double>(end - ratios.begin()) / problems;
}

std::vector<ProfileCurve> ProfileCurves(const std::vector<Json>& rows,
                                        const std::string& protocol,
                                        const std::string& measure) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::map<ProblemKey, std::map<std::string, double>> problems;
  std::vector<ProfileCurve> curves;
  for (const Json& row : rows) {
    if (RowText(row, "protocol") != protocol) continue;
    const std::string method = RowText(row, "method");
    problems[ProblemOf(row)][method] =
        row.at("solved").get<bool>() ? std::max(1e-9, RowNumber(row, measure))
                                     : kNever;
    const bool is_known =
        std::any_of(curves.begin(), curves.end(),
                    [&](const ProfileCurve& c) { return c.method == method; });
    if (!is_known) curves.push_back({method, {}, 0});
  }
  for (ProfileCurve& curve : curves) {
    for (const auto& entry : problems) {
      const std::map<std::string, double>& values = entry.second;
      const auto own = values.find(curve.method);
      if (own == values.end()) continue;  // was not asked
      ++curve.problems;
      if (!(own->second < kNever)) continue;
      double best = kNever;
      for (const auto& value : values) best = std::min(best, value.second);
      curve.ratios.push_back(own->second / best);
    }
    std::sort(curve.ratios.begin(), curve.ratios.end());
  }
  return curves;
}

}  // namespace phongpd
