// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/behind_json.h"

#include <nlohmann/json.hpp>

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

Json Point(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Vector3d PointOf(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(),
          json.at(2).get<double>()};
}

Json Points(const std::vector<Vector3d>& points) {
  Json json = Json::array();
  for (const Vector3d& p : points) json.push_back(Point(p));
  return json;
}

std::vector<Vector3d> PointsOf(const Json& json) {
  std::vector<Vector3d> points;
  for (const Json& p : json) points.push_back(PointOf(p));
  return points;
}

Json Iterate(const ViewIterate& iterate) {
  return {{"number", iterate.number},
          {"stage", iterate.stage},
          {"restoration", iterate.is_restoration},
          {"free", iterate.is_free},
          {"objective", iterate.objective},
          {"violation", iterate.violation},
          {"points", Points(iterate.points)}};
}

ViewIterate IterateOf(const Json& json) {
  ViewIterate iterate;
  json.at("number").get_to(iterate.number);
  json.at("stage").get_to(iterate.stage);
  json.at("restoration").get_to(iterate.is_restoration);
  json.at("free").get_to(iterate.is_free);
  json.at("objective").get_to(iterate.objective);
  json.at("violation").get_to(iterate.violation);
  iterate.points = PointsOf(json.at("points"));
  return iterate;
}

}  // namespace

Json BehindJson(const ViewBehind& behind) {
  const ViewGraph& graph = behind.graph;
  Json json = {{"graph",
                {{"name", graph.name},
                 {"points", Points(graph.points)},
                 {"edges", graph.edges}}},
               {"planes", Json::array()},
               {"window", Json()},
               {"iterations", behind.iterates.count},
               {"iterates", Json::array()}};
  if (!behind.window.IsEmpty()) {
    json["window"] = {Point(behind.window.min), Point(behind.window.max)};
  }
  for (const ViewPlane& plane : behind.planes) {
    json["planes"].push_back({{"point", Point(plane.point)},
                              {"normal", Point(plane.normal)},
                              {"size", plane.size}});
  }
  for (const ViewIterate& iterate : behind.iterates.kept) {
    json["iterates"].push_back(Iterate(iterate));
  }
  return json;
}

ViewBehind BehindOf(const Json& json) {
  ViewBehind behind;
  const Json& graph = json.at("graph");
  behind.graph = {graph.at("name").get<std::string>(),
                  PointsOf(graph.at("points")),
                  graph.at("edges").get<std::vector<std::pair<int, int>>>()};
  for (const Json& plane : json.at("planes")) {
    behind.planes.push_back({PointOf(plane.at("point")),
                             PointOf(plane.at("normal")),
                             plane.at("size").get<double>()});
  }
  if (const Json& window = json.at("window"); !window.is_null()) {
    behind.window = {PointOf(window.at(0)), PointOf(window.at(1))};
  }
  json.at("iterations").get_to(behind.iterates.count);
  for (const Json& iterate : json.at("iterates")) {
    behind.iterates.kept.push_back(IterateOf(iterate));
  }
  return behind;
}

}  // namespace phongpd
