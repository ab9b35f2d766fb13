// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "problems/output/text.h"
#include "viewer/display_mesh.h"
#include "viewer/page_numbers.h"
#include "viewer/view_entries.h"
#include "viewer/view_json_behind.h"
#include "viewer/view_json_modules.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::AppendNumber;
using internal::Base64;
using internal::CornerBytes;
using internal::PointJson;
using internal::PointsJson;
using internal::ShownPositions;
using internal::TurnJson;
using Json = nlohmann::ordered_json;

Json MaybePoint(const std::optional<Vector3d>& p) {
  return p ? PointJson(*p) : Json(nullptr);
}

Json MeshJson(const TriangleMesh& mesh, const std::string& name,
              std::size_t most, const internal::PageFrame& frame,
              std::vector<std::string>* notes) {
  const DisplayMesh shown = MeshForDisplay(mesh, most);
  if (shown.cell > 0.0) {
    notes->push_back(name + ": " + std::to_string(shown.mesh.triangles.size()) +
                     " of " + std::to_string(mesh.triangles.size()) +
                     " triangles are shown, simplified on a grid of " +
                     Rounded(shown.cell) + " for display only");
  }
  return {{"name", name},
          {"triangles", mesh.triangles.size()},
          {"shown", shown.mesh.triangles.size()},
          {"positions", Base64(ShownPositions(shown.mesh.vertices, frame))},
          {"indices", Base64(CornerBytes(shown.mesh))}};
}

Json MotionJson(const ViewMotion& motion) {
  if (motion.positions.empty()) return nullptr;
  Json json = {{"positions", PointsJson(motion.positions)},
               {"traces", Json::array()}};
  for (const ViewTrace& trace : motion.traces) {
    json["traces"].push_back({{"name", trace.name},
                              {"pd", PointsJson(trace.pd)},
                              {"status", trace.status}});
  }
  return json;
}

// The meshes of one page, which lose triangles alike if there are too many.
class PageMeshes {
 public:
  PageMeshes(const View& view, std::size_t most,
             const internal::PageFrame& frame)
      : most_(most), frame_(frame) {
    Count(view.robot);
    for (const ViewMesh& mesh : view.meshes) Count(mesh.mesh);
    for (const NamedPath& path : view.paths) Count(path.robot);
    for (const ViewMover& one : view.movers) Count(one.mesh);
  }

  Json Still(const ViewMesh& mesh, std::vector<std::string>* notes) const {
    Json json = MeshJson(mesh.mesh, mesh.name, Share(mesh.mesh), frame_, notes);
    json["role"] = ToString(mesh.role);
    return json;
  }

  // At the origin, or where it is at the configuration 0, which is moved about.
  Json Body(const TriangleMesh& mesh, const std::string& name,
            std::vector<std::string>* notes) const {
    if (mesh.triangles.empty()) return nullptr;
    return MeshJson(mesh, name, Share(mesh), {Vector3d::Zero(), frame_.scale},
                    notes);
  }

 private:
  void Count(const TriangleMesh& mesh) { all_ += mesh.triangles.size(); }

  std::size_t Share(const TriangleMesh& mesh) const {
    const std::size_t triangles = mesh.triangles.size();
    if (all_ <= most_) return triangles;
    const double share =
        static_cast<double>(triangles) / static_cast<double>(all_);
    return std::max<std::size_t>(
        1000, static_cast<std::size_t>(share * static_cast<double>(most_)));
  }

  std::size_t all_ = 0;  // triangles
  std::size_t most_;     // of them that the page may hold
  internal::PageFrame frame_;
};

Json EndsJson(const std::vector<ViewEnds>& ends) {
  Json json = Json::array();
  for (const ViewEnds& one : ends) {
    json.push_back({{"robot", one.robot},
                    {"start", PointJson(one.start)},
                    {"goal", PointJson(one.goal)}});
  }
  return json;
}

// What stands and what moves, and where.
void AddBodies(const View& view, const PageMeshes& meshes, Json* json,
               std::vector<std::string>* notes) {
  (*json)["meshes"] = Json::array();
  for (const ViewMesh& mesh : view.meshes) {
    (*json)["meshes"].push_back(meshes.Still(mesh, notes));
  }
  (*json)["robot"] = meshes.Body(view.robot, "robot", notes);
  (*json)["movers"] = Json::array();
  for (const ViewMover& one : view.movers) {
    (*json)["movers"].push_back(
        {{"name", one.name},
         {"body", meshes.Body(one.mesh, one.name, notes)},
         {"points", PointsJson(one.points)}});
  }
  (*json)["start"] = MaybePoint(view.start);
  (*json)["goal"] = MaybePoint(view.goal);
  (*json)["start_turn"] = TurnJson(view.start_turn);
  (*json)["goal_turn"] = TurnJson(view.goal_turn);
  (*json)["ends"] = EndsJson(view.ends);
  (*json)["bounds"] = view.bounds.IsEmpty()
                          ? Json(nullptr)
                          : Json({{"min", PointJson(view.bounds.min)},
                                  {"max", PointJson(view.bounds.max)}});
}

Json WindowsJson(const ViewAnswer& answer) {
  if (answer.window_reaches.empty()) return nullptr;
  Json axes = Json::array();
  for (int k = 0; k < 3; ++k) {
    axes.push_back(PointJson(answer.window_axes.col(k)));
  }
  return {{"reaches", answer.window_reaches}, {"axes", axes}};
}

// What a page can ask about: a robot from a start to a goal, or several.
Json TaskJson(const View& view) {
  const bool is_one = view.start && view.goal && !view.robot.triangles.empty();
  if (view.serve_command.empty() || !view.motion.positions.empty() ||
      (!is_one && view.ends.empty())) {
    return nullptr;
  }
  return {{"command", view.serve_command},
          {"served", view.is_served},
          {"clearance", view.wanted_clearance},
          {"kind", !view.ends.empty() ? "robots"
                   : view.turns       ? "turns"
                                      : "translates"}};
}

// Paths with their robots and what lies behind them.
void AddPaths(const View& view, const PageMeshes& meshes,
              const internal::PageFrame& frame, Json* json,
              std::vector<std::string>* notes) {
  for (const char* list :
       {"paths", "graphs", "planes", "iterates", "regions", "windows"}) {
    (*json)[list] = Json::array();
  }
  for (std::size_t i = 0; i < view.paths.size(); ++i) {
    const NamedPath& path = view.paths[i];
    (*json)["paths"].push_back(PathEntry(path));
    (*json)["paths"].back()["robot"] =
        meshes.Body(path.robot, path.name, notes);
    internal::AddBehind(path, i, frame, json, notes);
  }
}

}  // namespace

Json ViewJson(const View& view, std::size_t most_triangles) {
  const BoundingBox box = ViewBounds(view);
  const Vector3d center = box.Center();
  double scale = std::max(box.Diagonal(), ComputeBounds(view.robot).Diagonal());
  if (!(scale > 0.0)) scale = 1.0;
  const PageMeshes meshes(view, most_triangles, {center, scale});

  Json json;
  json["title"] = view.title;
  json["unit"] = view.unit;
  std::vector<std::string> notes = view.notes;
  json["notes"] = Json::array();
  json["center"] = PointJson(center);
  json["scale"] = scale;
  AddBodies(view, meshes, &json, &notes);
  AddPaths(view, meshes, {center, scale}, &json, &notes);
  json["motion"] = MotionJson(view.motion);
  json["answers"] = Json::array();
  for (const ViewAnswer& answer : view.answers) {
    json["answers"].push_back(AnswerEntry(answer));
    json["windows"].push_back(WindowsJson(answer));
  }
  json["probe"] = internal::ProbeJson(view, &notes);
  json["task"] = TaskJson(view);
  json["solver"] =
      json["task"].is_null() ? Json(nullptr) : internal::SolverJson(view);
  json["notes"] = notes;
  return json;
}

}  // namespace phongpd
