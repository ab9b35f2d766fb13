// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/command.h"

#include <fcntl.h>
#include <unistd.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/contact/content_hash.h"
#include "core/mesh/counted.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"
#include "core/mesh/mesh_range.h"
#include "files/descriptor.h"
#include "planners/world/budget.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/output/row_parts.h"
#include "problems/output/text.h"

namespace phongpd::cli {

namespace {

// Operands are Solids or meshes.
template <typename Operand>
ContactSpace LoadOrBuildOf(const Operand& robot, const std::string& robot_name,
                           const Operand& obstacle,
                           const std::string& obstacle_name,
                           const ContactSpaceOptions& options, bool use_cache) {
  Progress("building the contact space");
  ContactSpace space =
      BuildContactSpaceCached(robot, obstacle, options, UserCache(!use_cache));
  // Only now they are known to have a size.
  WarnOfUnits(robot, robot_name, obstacle, obstacle_name);
  for (const std::string& warning : space.report().warnings) Warn(warning);
  return space;
}

}  // namespace

ContactSpace LoadOrBuild(const Solid& robot, const Solid& obstacle,
                         const ContactSpaceOptions& options, bool use_cache) {
  return LoadOrBuildOf(robot, robot.name(), obstacle, obstacle.name(), options,
                       use_cache);
}

ContactSpace LoadOrBuild(const TriangleMesh& robot,
                         const TriangleMesh& obstacle,
                         const ContactSpaceOptions& options, bool use_cache) {
  return LoadOrBuildOf(robot, options.robot_name, obstacle,
                       options.obstacle_name, options, use_cache);
}

CLI::Option* AddContactSpaceFile(CLI::App* app, std::string* path) {
  return app
      ->add_option("--contact-space", *path,
                   "Written by phongpd contact-space: a .pcs file, or a mesh")
      ->type_name("FILE");
}

void AddBuildLimits(CLI::App* app, double* max_seconds, double* max_mib) {
  app->add_option("--max-seconds", *max_seconds,
                  "Refuse what is predicted to take longer, and stop "
                  "what does (0: never)")
      ->type_name("S")
      ->transform(SecondsFromZero());
  app->add_option("--max-mib", *max_mib,
                  "Build by boxes what is predicted to need more memory in "
                  "one, refuse what needs more even so, and stop what does "
                  "(0: nine tenths of what is free, and only stop)")
      ->type_name("MIB")
      ->check(AtLeast(0.0));
}

void AddField(CLI::App* app, std::string* field) {
  app->add_option("--field", *field,
                  "Phong field: normals in closed form, or the paper's "
                  "tangent planes by Newton")
      ->check(CLI::IsMember({"normal", "tangent-plane"}))
      ->capture_default_str();
}

void AddBudget(CLI::App* app, const std::string& what, std::string* budget) {
  app->add_option("--budget", *budget,
                  "Pick " + what +
                      " that answered most often within so many seconds of "
                      "processors, builds included, with about as many "
                      "triangles (results/trade/budget.md; --explain says "
                      "which). Other options win over it; it limits nothing, "
                      "--time and --max-seconds do")
      ->transform(SecondsAboveZero())
      ->type_name("SECONDS");
}

double BudgetOf(const std::string& budget) {
  const double seconds = ParseDouble(budget, "--budget");
  RequireBudget(seconds, "--budget");
  return seconds;
}

void AddPreset(CLI::App* app, const std::string& of, std::string* preset) {
  app->add_option("--preset", *preset,
                  "What is spent on a better path; every path is exact. " + of +
                      ". Other options win over it (scene's own if not set, "
                      "balanced if that says none)")
      ->check(CLI::IsMember(PresetNames()));
}

void SetPreset(const std::string& preset, Scene* scene) {
  if (!preset.empty()) scene->preset = ParsePreset(preset, "--preset");
}

void AddSliding(CLI::App* app, PenetrationTrackerOptions* options) {
  app->add_option("--slide-ratio", options->ratio,
                  "Sliding contact: it makes for where the depth is at most "
                  "so many times the Euclidean; at least 1")
      ->check(Between(1.0, 1e6))
      ->capture_default_str();
  app->add_option("--slide-speed", options->speed,
                  "... moving at most so many times as far as the robot; the "
                  "depth changes by at most one more")
      ->check(Between(1e-6, 1e6))
      ->capture_default_str();
}

PhongMetricOptions MetricOptions(const std::string& field,
                                 const Length& smoothing_length,
                                 const ContactSpace& contact) {
  const double diagonal = contact.length();
  RequireLength(smoothing_length, LengthRange::kFromZero, diagonal,
                "--smoothing-length");
  PhongMetricOptions options;
  options.field =
      field == "normal" ? FieldKind::kNormal : FieldKind::kTangentPlane;
  options.field_options.smoothing_length =
      smoothing_length.Resolve(diagonal).share;
  options.Validate();
  return options;
}

const char* const kSmoothingLengthHelp =
    "Of the Phong field, 0 (the paper) to the contact space's diagonal D: 0.1 "
    "or 0.1D is a share of D, 0.5unit is in the user's unit";

void TellAbout(const Scene& scene) {
  for (const std::string& warning : scene.warnings) Warn(warning);
  const std::string skipped = SkippedObstaclesNote(scene);
  if (!skipped.empty()) Progress(skipped);
}

void TellAboutSpaces(const World& world, std::size_t triangles) {
  const WorldReport report = world.Report();
  for (const std::string& warning : report.warnings) Warn(warning);
  if (world.BuiltConvolution() != nullptr) {
    Progress("free space alone: " +
             Counted(world.BuiltConvolution()->facets(), "facet") +
             " modelled, ready after " + Rounded(report.seconds) + " s");
  }
  if (report.contact_spaces == 0) return;
  std::string kept;
  if (report.parts_from_cache == report.parts) {
    kept = " (kept from before)";
  } else if (report.from_cache) {
    kept = " (" + std::to_string(report.parts_from_cache) + " of " +
           std::to_string(report.parts) + " parts kept from before)";
  }
  Progress("contact space: " + Counted(triangles, "triangle") + ", " +
           Rounded(report.seconds) + " s" + kept);
}

Length LengthFlag(const std::string& text, const std::string& flag,
                  LengthRange range, const Scene* scene) {
  const std::string unit = scene == nullptr ? "" : scene->workspace.unit;
  const double diagonal =
      scene == nullptr ? 0.0 : ContactBounds(scene->workspace).Diagonal();
  const Length length = ParseLength(text, flag, unit);
  RequireLength(length, range, diagonal, flag, unit);
  return length;
}

void AddMeshUnit(CLI::App* app, std::string* unit) {
  app->add_option("--unit", *unit,
                  "What the meshes' unit is called: lengths may say it then, "
                  "20mm, and others are refused; nothing is converted")
      ->check(CLI::IsMember(UnitNames()))
      ->type_name("NAME");
}

std::string WithoutUnitName(const std::string& text, const std::string& unit) {
  if (unit.empty() || UnitNamedIn(text) != unit) return text;
  return text.substr(0, text.size() - unit.size()) + "unit";
}

double MeshLengthFlag(const std::string& text, const std::string& flag,
                      const std::string& unit) {
  const std::string named = UnitNamedIn(text), word = "unit";
  std::string number = WithoutUnitName(text, unit);
  if (number.size() > word.size() &&
      number.compare(number.size() - word.size(), word.size(), word) == 0) {
    number.resize(number.size() - word.size());
    number.resize(number.find_last_not_of(' ') + 1);
  }
  double length = -1.0;
  try {
    length = ParseDouble(number, flag);
  } catch (const InputError&) {
    // Below: what a length is, not what a number is.
  }
  if (length >= 0.0) return std::abs(length);
  std::string note;
  if (!named.empty() && named != unit) {
    note = unit.empty() ? "; --unit " + named + " says that it is theirs"
                        : "; that is " + unit + ", and nothing is converted";
  }
  throw InputError(flag + ": expected a length as 20 or 20" +
                   (unit.empty() ? "unit" : unit) +
                   ", in the meshes' unit, found '" + text.substr(0, 40) + "'" +
                   note);
}

void AddNoCache(CLI::App* app, bool* no_cache) {
  app->add_flag("--no-cache", *no_cache,
                "Build anew, and do not keep the contact space for the next "
                "time in $PHONGPD_CACHE_DIR, $XDG_CACHE_HOME/phongpd or "
                "~/.cache/phongpd");
}

ContactSpaceCache UserCache(bool no_cache) {
  ContactSpaceCache cache;
  if (!no_cache) cache.directory = DefaultCacheDirectory();
  return cache;
}

void AddRoot(CLI::App* app, std::string* root) {
  app->add_option("--root", *root,
                  "Refuse a scene file whose mesh files, links and .. "
                  "followed, lie outside this folder (for scene files of "
                  "others)")
      ->check(IsFolder())
      ->type_name("DIR");
}

void AddVerify(CLI::App* app, bool* verify) {
  app->add_flag("--verify,!--no-verify", *verify,
                "Judge every answer again on the original meshes, by code that "
                "shares nothing with contact spaces; a wrong one is a fault of "
                "the program (default: on)");
}

void RequireRuns(int runs) {
  if (runs >= 1) return;
  throw InputError("--runs: expected at least 1, found " +
                   std::to_string(runs));
}

std::string MeshText(const TriangleMesh& mesh, const std::string& path) {
  return MeshContent(mesh, path == kStandardOutput ? "-.off" : path);
}

void DeclareMesh(OutputFiles* outputs, const std::string& path) {
  RequireEnding(path, "--output", {".off", ".obj", ".stl", ".ply"});
  outputs->Declare(path);
}

void WriteMeshTo(OutputFiles* outputs, const std::string& path,
                 const TriangleMesh& mesh) {
  outputs->Write(path, MeshText(mesh, path));
}

void CommitAndTell(OutputFiles* outputs, const std::string& text) {
  const bool holds_data = outputs->UseStandardOutput();
  outputs->Commit();
  (holds_data ? std::cerr : std::cout) << text;
}

Eigen::Vector3d ParsePoint(const std::vector<std::string>& cells,
                           const std::string& flag) {
  Eigen::Vector3d point;
  for (int k = 0; k < 3; ++k) {
    point[k] = ParseDouble(cells.at(static_cast<std::size_t>(k)), flag);
  }
  return point;
}

namespace {

// Two builds of one version may give different rows.
std::string ProgramDigest() {
  const internal::Descriptor file(open("/proc/self/exe", O_RDONLY | O_CLOEXEC));
  if (!file.IsOpen()) return "";
  return internal::ToHex(internal::HashContent(internal::ReadAll(file)));
}

}  // namespace

nlohmann::ordered_json CommandSettings(const CLI::App& app,
                                       const std::vector<SceneSource>& scenes) {
  using Json = nlohmann::ordered_json;
  static const std::set<std::string> others = {
      "--help", "--output",   "--json",    "--html",
      "--svg",  "--ompl-log", "--no-cache"};
  Json settings = {{"command", app.get_name()}};
  for (const CLI::Option* const option : app.get_options()) {
    const std::string name = option->get_name();
    if (others.count(name) != 0) continue;
    settings[name] = option->count() > 0 ? Json(option->results())
                                         : Json(option->get_default_str());
  }
  Json& digests = settings["contents of scenes"] = Json::array();
  for (const SceneSource& scene : scenes) digests.push_back(scene.Digest());
  settings["versions"] = VersionsRow();
  settings["program"] = ProgramDigest();
  return settings;
}

void FailVerification(const std::string& what) {
  throw std::runtime_error("verification on the original solids failed: " +
                           what);
}

void Note(const std::string& text) {
  std::cerr << "phongpd: " << OneLine(text) << '\n';
}

void Warn(const std::string& text) { Note("warning: " + text); }

}  // namespace phongpd::cli
