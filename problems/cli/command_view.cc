// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/descriptor.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/loopback_server.h"
#include "problems/cli/operands.h"
#include "problems/cli/serve_view.h"
#include "problems/cli/view_inputs.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "viewer/gltf.h"
#include "viewer/still_picture.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPictureWidth = 1600, kPictureHeight = 1000;

struct ViewFlags : ViewRequest {
  std::vector<std::string> from_cells, to_cells;
  std::string unit;
  std::string title;
  std::string html, glb, png;
  std::optional<double> moment;
  bool json = false;
  bool serve = false;
  ServeOptions server;
  const CLI::App* app = nullptr;  // that they were declared on
};

// What moves in glTF translates.
void RequireNoTurns(const View& view) {
  for (const NamedPath& path : view.paths) {
    if (path.turns.empty()) continue;
    throw InputError(
        "--glb: expected paths that do not turn the robot, found " + path.name +
        "; take --html");
  }
}

// A new file of the user's own, which stays.
std::string WriteTemporary(const std::string& page) {
  std::error_code error;
  const std::filesystem::path parent =
      std::filesystem::temp_directory_path(error);
  std::string path = ((error ? std::filesystem::path("/tmp") : parent) /
                      "phongpd-view-XXXXXX.html")
                         .string();
  const internal::Descriptor file(mkstemps(path.data(), 5));
  if (!file.IsOpen()) {
    throw InputError(path + ": cannot be written (" + std::strerror(errno) +
                     "); take --html FILE");
  }
  internal::WriteAll(file, page);
  return path;
}

// What is shown, for --json; `page` is where.
Json Contents(const View& view, const std::string& page) {
  Json meshes = Json::array(), paths = Json::array();
  for (const ViewMesh& mesh : view.meshes) {
    meshes.push_back({{"name", mesh.name},
                      {"role", ToString(mesh.role)},
                      {"triangles", mesh.mesh.triangles.size()}});
  }
  for (const NamedPath& path : view.paths) {
    paths.push_back({{"name", path.name},
                     {"points", path.points.size()},
                     {"free", path.is_free}});
  }
  return {{"page", page.empty() ? Json() : Json(page)},
          {"title", view.title},
          {"unit", view.unit},
          {"robot_triangles", view.robot.triangles.size()},
          {"meshes", meshes},
          {"paths", paths},
          {"frames", view.motion.positions.size()},
          {"answers", view.answers.size()},
          {"notes", view.notes}};
}

// Is it served, and is all that was asked for meant for that?
void CheckServe(const ViewFlags& flags) {
  if (!flags.serve) {
    for (const char* name : {"--port", "--time"}) {
      if (flags.app->count(name) == 0) continue;
      throw InputError(std::string(name) +
                       ": expected --serve with it, found none");
    }
    return;
  }
  RequireServer();
  for (const char* name : {"--html", "--glb", "--png", "--json"}) {
    if (flags.app->count(name) == 0) continue;
    throw InputError(std::string("--serve: expected it without ") + name +
                     ", found both; write the page without --serve");
  }
}

// Without a file of another kind there is a page, if only to be opened.
bool HasPage(const ViewFlags& flags) {
  return !flags.html.empty() || (flags.glb.empty() && flags.png.empty());
}

void CheckOutputs(const ViewFlags& flags) {
  RequireEnding(flags.html, "--html", {".html", ".htm"});
  RequireEnding(flags.glb, "--glb", {".glb"});
  RequireEnding(flags.png, "--png", {".png"});
  if (HasPage(flags) || !flags.png.empty()) RequireViewer();
  if (!flags.png.empty()) RequireBrowser();
  if (flags.moment && flags.png.empty()) {
    throw InputError(
        "--moment: expected --png FILE with it, found none; a "
        "page plays all moments");
  }
}

int Look(ViewFlags flags) {
  CheckServe(flags);
  if (!flags.from_cells.empty()) {
    flags.from = ParsePoint(flags.from_cells, "--from");
  }
  if (!flags.to_cells.empty()) flags.to = ParsePoint(flags.to_cells, "--to");
  CheckOutputs(flags);
  const bool is_page = HasPage(flags);
  OutputFiles outputs;
  for (const std::string& path : {flags.html, flags.glb, flags.png}) {
    if (!path.empty()) outputs.Declare(path);
  }
  if (flags.json) RequireFreeStandardOutput(outputs);

  std::optional<ServedScene> scene;
  View view = ReadThings(flags, &scene);
  if (scene) {
    view.serve_command = ServeCommand(flags.things, flags.root, flags.repair);
  }
  if (!flags.unit.empty()) view.unit = flags.unit;
  if (!flags.title.empty()) view.title = flags.title;
  if (flags.serve) {
    if (!scene) {
      throw InputError("--serve: expected a scene, or runs of one, found " +
                       view.title + "; without --serve it can be looked at");
    }
    ServeView(view, *scene, UserCache(flags.no_cache), flags.server);
  }
  const std::string page =
      is_page || !flags.png.empty() ? ViewPage(view) : std::string();
  if (!flags.html.empty()) outputs.Write(flags.html, page);
  if (!flags.glb.empty()) {
    RequireNoTurns(view);
    outputs.Write(flags.glb, ViewGlb(view));
  }
  if (!flags.png.empty()) {
    Progress("drawing the picture");
    outputs.Write(flags.png, StillPicture(page, kPictureWidth, kPictureHeight,
                                          flags.moment));
  }
  outputs.Commit();
  std::string path = flags.html;
  if (is_page && flags.html.empty()) {
    path = WriteTemporary(page);
    if (!flags.json) std::cout << path << '\n';
    OpenOnDisplay(path);
  }
  if (flags.json) std::cout << JsonText(Contents(view, path), 2) << '\n';
  return kDone;
}

// Where it is looked at; without any of them on a page of its own.
void AddViewOutputs(CLI::App* app, ViewFlags* flags) {
  app->add_option("--html", flags->html,
                  "Page to turn, cut and play; one file, needs nothing from "
                  "elsewhere")
      ->type_name("FILE");
  app->add_option("--glb", flags->glb,
                  "Binary glTF 2.0: meshes, paths, the robot's way as an "
                  "animation; for Blender, f3d and others")
      ->type_name("FILE");
  app->add_option("--png", flags->png,
                  "Still picture, 1600 x 1000, the robot at stages along its "
                  "way (needs the browser chromium)")
      ->type_name("FILE");
  app->add_option("--moment", flags->moment,
                  "Of --png: the robot at this share of its way alone, and not "
                  "at stages")
      ->check(Between(0.0, 1.0))
      ->type_name("SHARE");
}

void AddServe(CLI::App* app, ViewFlags* flags) {
  flags->app = app;
  app->add_flag("--serve", flags->serve,
                "Serve the page on 127.0.0.1, where its start and goal can be "
                "moved and planned between; prints the address, which holds a "
                "secret, and ends by Ctrl-C");
  app->add_option("--port", flags->server.port,
                  "Of --serve; 0: any that is free")
      ->check(Between(0, 65535))
      ->capture_default_str()
      ->type_name("N");
  app->add_option("--time", flags->server.seconds,
                  "Of --serve: limit of an answer, seconds")
      ->transform(SecondsAboveZero())
      ->capture_default_str()
      ->type_name("S");
}

// What a table of motion does not say itself.
void AddViewedMotion(CLI::App* app, ViewFlags* flags) {
  app->add_option("--robot", flags->robot,
                  "Mesh of what moves, for tables that do not hold it")
      ->type_name("FILE");
  app->add_option("--from", flags->from_cells,
                  "First position of a motion's table ...")
      ->expected(3)
      ->delimiter(',')
      ->type_name("X Y Z");
  app->add_option("--to", flags->to_cells, "... and its last")
      ->expected(3)
      ->delimiter(',')
      ->type_name("X Y Z");
}

}  // namespace

Command AddView(CLI::App* app) {
  auto flags = std::make_shared<ViewFlags>();
  app->add_option("THING", flags->things,
                  "Meshes, contact spaces (OFF, OBJ, PLY, STL, DAE, glTF, GLB, "
                  "3MF, robot.urdf#link, .pcs), a scene "
                  "(file or FAMILY:key=value,...), rows of optimize and plan, "
                  "a table of motion, answers of depth and query: several are "
                  "shown together. Without an output, a page is written to a "
                  "temporary file, its name is printed, and where there is a "
                  "display xdg-open opens it")
      ->required()
      ->type_name("THING");
  AddViewOutputs(app, flags.get());
  AddViewedMotion(app, flags.get());
  AddServe(app, flags.get());
  app->add_flag(
      "--build", flags->build,
      "Build the contact space of a scene, or take it from the cache, "
      "and show it");
  app->add_option("--unit", flags->unit,
                  "What a unit of length is called (as the scene calls it, or "
                  "units, if not set)")
      ->type_name("NAME");
  app->add_option("--title", flags->title, "Of the page")->type_name("TEXT");
  AddRoot(app, &flags->root);
  AddRepair(app, &flags->repair);
  AddNoCache(app, &flags->no_cache);
  AddJson(app, &flags->json,
          "What is shown, and where its page is, as JSON on standard output");
  AddExamples(
      app, {"phongpd view robot.off obstacle.off",
            "phongpd view u_axis --build --html u.html",
            "phongpd view u_axis --serve",
            "phongpd view phong.jsonl euclidean.jsonl --png paths.png",
            "phongpd view motion.csv contact.off --robot robot.off --from 0 -1 "
            "0 --to 0 1 0"});
  return [flags] { return Look(*flags); };
}

}  // namespace phongpd::cli
