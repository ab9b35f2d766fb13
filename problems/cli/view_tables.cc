// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/view_tables.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "planners/world/penetration_spec.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

using Eigen::Vector3d;

std::string_view TakeLine(std::string_view* content) {
  const std::size_t end = content->find('\n');
  std::string_view line = content->substr(0, end);
  content->remove_prefix(end == std::string_view::npos ? content->size()
                                                       : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

bool Has(const std::vector<std::string_view>& header,
         const std::vector<std::string_view>& names) {
  return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
    return std::count(header.begin(), header.end(), name) == 1;
  });
}

// A row of which cells are asked by the names of their columns.
class Row {
 public:
  Row(const std::vector<std::string_view>& header, std::string_view line,
      std::string where)
      : header_(header), cells_(Cells(line)), where_(std::move(where)) {
    if (cells_.size() == header_.size()) return;
    throw InputError(where_ + ": expected " + std::to_string(header_.size()) +
                     " cells as in the header, found " +
                     std::to_string(cells_.size()));
  }

  const std::string& where() const { return where_; }
  std::string Text(std::string_view column) const {
    const auto found = std::find(header_.begin(), header_.end(), column);
    if (found == header_.end()) {
      throw InputError(where_ + ": expected a column " + std::string(column) +
                       ", found none");
    }
    return std::string(
        cells_[static_cast<std::size_t>(found - header_.begin())]);
  }
  double Number(const std::string& column) const {
    return ParseDouble(Text(column), where_ + ": column " + column);
  }
  Vector3d Point(const std::string& prefix) const {
    return {Number(prefix + "x"), Number(prefix + "y"), Number(prefix + "z")};
  }

 private:
  const std::vector<std::string_view>& header_;
  std::vector<std::string_view> cells_;
  std::string where_;
};

// As the page of the motion itself calls it; of "phong" alone no table says ℓ.
std::string TitleOf(const std::string& metric) {
  if (metric == "euclidean") return "Euclidean PD";
  if (metric == "sliding") return "sliding contact";
  if (metric == "phong") return "PhongPD";
  return metric.rfind("phong@", 0) == 0
             ? ParsePenetration(metric, "metric").Title()
             : metric;
}

// Calls visit(row) for all rows.
template <typename Visit>
void ForEachRow(std::string_view content, const std::string& file,
                const Visit& visit) {
  const std::vector<std::string_view> header = Cells(TakeLine(&content));
  for (std::size_t number = 2; !content.empty(); ++number) {
    const std::string_view line = TakeLine(&content);
    if (line.empty()) continue;
    visit(Row(header, line, file + ":" + std::to_string(number)));
  }
}

}  // namespace

TableKind KindOfTable(std::string_view content) {
  const std::vector<std::string_view> header = Cells(TakeLine(&content));
  if (Has(header, {"frame", "metric", "status", "pd_x", "pd_y", "pd_z"})) {
    return TableKind::kMotion;
  }
  if (Has(header, {"x", "qw", "status", "depth", "on_a_x", "on_b_x"})) {
    return TableKind::kDepth;
  }
  if (Has(header, {"x", "y", "z", "status", "signed_distance", "contact_x"})) {
    return TableKind::kQuery;
  }
  return TableKind::kOther;
}

std::vector<ViewTrace> ParseTraces(std::string_view content,
                                   const std::string& file) {
  std::vector<ViewTrace> traces;
  ForEachRow(content, file, [&](const Row& row) {
    const std::string metric = row.Text("metric");
    auto trace =
        std::find_if(traces.begin(), traces.end(),
                     [&](const ViewTrace& t) { return t.name == metric; });
    if (trace == traces.end()) {
      traces.push_back({metric, {}, {}});
      trace = traces.end() - 1;
    }
    const double frame = row.Number("frame");
    if (frame != static_cast<double>(trace->pd.size())) {
      throw InputError(row.where() + ": expected frame " +
                       std::to_string(trace->pd.size()) + " of " + metric +
                       ", found " + row.Text("frame"));
    }
    trace->pd.push_back(row.Point("pd_"));
    trace->status.push_back(row.Text("status"));
  });
  if (traces.empty()) {
    throw InputError(file + ": expected a motion, found no frame");
  }
  for (const ViewTrace& trace : traces) {
    if (trace.pd.size() == traces.front().pd.size()) continue;
    throw InputError(file +
                     ": expected as many frames of every metric, found " +
                     std::to_string(traces.front().pd.size()) + " of " +
                     traces.front().name + " and " +
                     std::to_string(trace.pd.size()) + " of " + trace.name);
  }
  for (ViewTrace& trace : traces) trace.name = TitleOf(trace.name);
  return traces;
}

std::vector<ViewAnswer> ParseDepthTable(std::string_view content,
                                        const std::string& file) {
  std::vector<ViewAnswer> answers;
  ForEachRow(content, file, [&](const Row& row) {
    ViewAnswer answer;
    answer.position = row.Point("");
    answer.orientation = {row.Number("qw"), row.Number("qx"), row.Number("qy"),
                          row.Number("qz")};
    answer.status = row.Text("status");
    answer.depth = row.Number("depth");
    answer.clearance = row.Number("clearance");
    answer.direction = row.Point("direction_");
    answer.on_robot = row.Point("on_a_");
    answer.on_obstacle = row.Point("on_b_");
    answer.has_witness = row.Text("feature_a").rfind("none", 0) != 0;
    answers.push_back(answer);
  });
  return answers;
}

std::vector<ViewAnswer> ParseQueryTable(std::string_view content,
                                        const std::string& file) {
  std::vector<ViewAnswer> answers;
  ForEachRow(content, file, [&](const Row& row) {
    ViewAnswer answer;
    answer.position = row.Point("");
    answer.status = row.Text("status");
    const double distance = row.Number("signed_distance");
    answer.depth = std::max(0.0, -distance);
    answer.clearance = std::max(0.0, distance);
    answer.direction = row.Point("direction_");
    // The arrow leads from the position to its contact.
    answer.on_robot = answer.position;
    answer.on_obstacle = row.Point("contact_");
    answer.has_witness = answer.status != "invalid";
    answers.push_back(answer);
  });
  return answers;
}

}  // namespace phongpd::cli
