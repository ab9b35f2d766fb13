// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view_json_behind.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "viewer/display_mesh.h"

namespace phongpd::internal {
namespace {

using Json = nlohmann::ordered_json;

Json GraphJson(const NamedPath& path, std::size_t number,
               const PageFrame& frame, std::vector<std::string>* notes) {
  const ViewGraph& graph = path.behind.graph;
  const std::size_t count = graph.edges.size();
  const std::size_t step = (count + kMaxDisplayEdges - 1) / kMaxDisplayEdges;
  std::string indices;
  std::size_t shown = 0;
  for (std::size_t e = 0; e < count; e += step, ++shown) {
    AppendNumber(&indices, static_cast<std::uint32_t>(graph.edges[e].first));
    AppendNumber(&indices, static_cast<std::uint32_t>(graph.edges[e].second));
  }
  if (shown < count) {
    notes->push_back(path.name + ": " + std::to_string(shown) + " of " +
                     std::to_string(count) + " edges of the " + graph.name +
                     " are shown");
  }
  return {{"path", number},
          {"name", graph.name},
          {"points", graph.points.size()},
          {"edges", count},
          {"positions", Base64(ShownPositions(graph.points, frame))},
          {"indices", Base64(indices)}};
}

Json IteratesJson(const NamedPath& path, std::size_t number,
                  const PageFrame& frame, std::vector<std::string>* notes) {
  const ViewIterates& iterates = path.behind.iterates;
  Json kept = Json::array();
  std::string positions;
  for (const ViewIterate& iterate : iterates.kept) {
    kept.push_back({{"number", iterate.number},
                    {"stage", iterate.stage},
                    {"restoration", iterate.is_restoration},
                    {"free", iterate.is_free},
                    {"objective", iterate.objective},
                    {"violation", iterate.violation}});
    positions += ShownPositions(iterate.points, frame);
  }
  if (iterates.kept.size() < iterates.count) {
    notes->push_back(path.name + ": " + std::to_string(iterates.kept.size()) +
                     " of " + std::to_string(iterates.count) +
                     " iterations are kept, the first and the last among them");
  }
  return {{"path", number},
          {"count", iterates.count},
          {"kept", kept},
          {"points", iterates.kept.front().points.size()},
          {"positions", Base64(positions)}};
}

Json PlanesJson(const std::vector<ViewPlane>& planes, std::size_t number) {
  Json list = Json::array();
  for (const ViewPlane& plane : planes) {
    list.push_back({{"point", PointJson(plane.point)},
                    {"normal", PointJson(plane.normal)},
                    {"size", plane.size}});
  }
  return {{"path", number}, {"planes", list}};
}

}  // namespace

void AddBehind(const NamedPath& path, std::size_t number,
               const PageFrame& frame, Json* page,
               std::vector<std::string>* notes) {
  const ViewBehind& behind = path.behind;
  if (!behind.graph.points.empty()) {
    (*page)["graphs"].push_back(GraphJson(path, number, frame, notes));
  }
  if (!behind.planes.empty()) {
    (*page)["planes"].push_back(PlanesJson(behind.planes, number));
  }
  if (!behind.window.IsEmpty()) {
    (*page)["regions"].push_back({{"path", number},
                                  {"min", PointJson(behind.window.min)},
                                  {"max", PointJson(behind.window.max)}});
  }
  if (!behind.iterates.kept.empty()) {
    (*page)["iterates"].push_back(IteratesJson(path, number, frame, notes));
  }
}

}  // namespace phongpd::internal
