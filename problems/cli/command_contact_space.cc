// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/bounds/mesh_approximation.h"
#include "core/contact/contact_space.h"
#include "core/contact/contact_space_piece.h"
#include "core/mesh/counted.h"
#include "core/mesh/mesh_io.h"
#include "core/solid/solid.h"
#include "planners/exact/verification.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/contact_space_report_json.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/cli/shard.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ContactSpaceFlags {
  std::vector<std::string> meshes;  // A and B, or none
  std::string robot;
  std::string obstacle;
  std::string output;
  std::string report;
  std::string piece;
  bool outer_shell_only = false;
  bool robot_hull = false;
  std::string target_faces = "0";
  std::string wrap_alpha = "0";
  std::string repair = "reject";
  double max_seconds = 0.0;
  double max_mib = 0.0;
  bool json = false;
  bool no_cache = false;
  bool verify = true;
};

std::size_t ParseTargetFaces(const std::string& text) {
  const double value = ParseDouble(text, "--target-faces");
  const bool is_none = value == 0.0;
  if (is_none || (value >= 4.0 && value <= 1e9 && value == std::floor(value))) {
    return static_cast<std::size_t>(value);
  }
  throw InputError("--target-faces: expected a whole number of at least 4, " +
                   ("found " + text));
}

// Refused by the flag's name, and before a mesh is read.
double ParseWrapAlpha(const std::string& text) {
  double alpha = -1.0;
  try {
    alpha = ParseDouble(text, "--wrap");
  } catch (const InputError&) {
    // Below: it is a share and no length, 5mm.
  }
  if (alpha == 0.0 || (alpha >= kMinWrapAlpha && alpha <= kMaxWrapAlpha)) {
    return alpha;
  }
  throw InputError("--wrap: expected a fraction of the diagonal from " +
                   FormatDouble(kMinWrapAlpha) + " to " +
                   FormatDouble(kMaxWrapAlpha) + ", found " + text);
}

// The flags that change the operands or the result.
ContactSpaceOptions OptionsOf(const ContactSpaceFlags& flags) {
  ContactSpaceOptions options;
  options.outer_shell_only = flags.outer_shell_only;
  options.robot_hull = flags.robot_hull;
  options.target_faces = ParseTargetFaces(flags.target_faces);
  options.wrap_alpha = ParseWrapAlpha(flags.wrap_alpha);
  options.repair = ParseRepair(flags.repair, "--repair");
  options.max_seconds = flags.max_seconds;
  options.max_mib = flags.max_mib;
  options.robot_name = flags.robot;
  options.obstacle_name = flags.obstacle;
  return options;
}

// Middles of up to 100 triangles, judged on the operands; null where these are
// not the files' solids, or were judged when the cache was filled.  Throws
// std::runtime_error for a point that is not on the contact surface.
Json VerifySample(const ContactSpaceFlags& flags, const TriangleMesh& robot,
                  const TriangleMesh& obstacle, const ContactSpace& space) {
  const bool is_exact =
      space.report().approximation.steps.empty() && flags.repair == "reject";
  if (!flags.verify || !is_exact || space.report().from_cache) return nullptr;
  Workspace solids;
  solids.robot = MakeSolid(robot, flags.robot);
  solids.obstacles = {MakeSolid(obstacle, flags.obstacle)};
  const Verifier verifier(solids);
  constexpr std::size_t kPoints = 100;
  const std::vector<Triangle>& triangles = space.mesh().triangles;
  const std::size_t stride = 1 + triangles.size() / (kPoints + 1);
  int points = 0, within_rounding = 0;
  double seconds = 0.0;
  for (std::size_t i = 0; i < triangles.size(); i += stride, ++points) {
    const auto corner = [&](std::size_t k) -> const Eigen::Vector3d& {
      return space.mesh().vertices[static_cast<std::size_t>(triangles[i][k])];
    };
    const Verification found =
        verifier.VerifySurface((corner(0) + corner(1) + corner(2)) / 3.0,
                               (corner(1) - corner(0))
                                   .cross(corner(2) - corner(0))
                                   .stableNormalized());
    seconds += found.seconds;
    within_rounding += found.verdict == Verdict::kWithinRounding ? 1 : 0;
    if (found.verdict == Verdict::kRefuted) {
      FailVerification(found.reason);
    }
  }
  return {{"points", points},
          {"within_rounding", within_rounding},
          {"wrong", 0},
          {"seconds", seconds}};
}

// One part of n, to be joined.
int BuildAndWritePiece(const ContactSpaceFlags& flags) {
  const Shard part = ParseShard(flags.piece, "--piece");
  if (flags.output.empty() || !flags.report.empty() || flags.json) {
    throw InputError(
        "--piece: expected --output and neither --report nor --json, which "
        "phongpd join has for the whole, found " +
        std::string(flags.output.empty() ? "no --output" : "one of them"));
  }
  OutputFiles outputs;
  outputs.Declare(flags.output);
  const ContactSpaceOptions options = OptionsOf(flags);
  const ContactSpacePiece piece =
      BuildContactSpacePiece(LoadMesh(flags.robot), LoadMesh(flags.obstacle),
                             options, {part.index, part.count});
  outputs.Write(flags.output, PieceContent(piece));
  CommitAndTell(&outputs, flags.output + ": piece " + flags.piece + ", " +
                              Counted(piece.faces(), "face") + " in " +
                              Counted(piece.boxes(), "box", "boxes") + '\n');
  return kDone;
}

// A and B, or, until 0.3, by flags: those of `flags` are set to either.
void TakeMeshes(ContactSpaceFlags* flags) {
  const bool has_flags = !flags->robot.empty() || !flags->obstacle.empty();
  const std::string expected = "contact-space: expected two meshes, A and B, ";
  if (has_flags && !flags->meshes.empty()) {
    throw InputError(expected + "found " + flags->meshes.front() +
                     " and --robot or --obstacle as well");
  }
  if (!has_flags && flags->meshes.size() == 2) {
    flags->robot = flags->meshes.front();
    flags->obstacle = flags->meshes.back();
  }
  if (!flags->robot.empty() && !flags->obstacle.empty()) return;
  std::string found = "none";
  if (!flags->meshes.empty()) found = flags->meshes.front() + " alone";
  if (has_flags) found = flags->robot.empty() ? "no --robot" : "no --obstacle";
  throw InputError(expected + "found " + found +
                   " (see phongpd contact-space --help)");
}

int BuildAndWrite(ContactSpaceFlags flags) {
  TakeMeshes(&flags);
  if (!flags.piece.empty()) return BuildAndWritePiece(flags);
  OutputFiles outputs;
  if (!flags.output.empty()) DeclareContactSpace(&outputs, flags.output);
  DeclareIfNamed(&outputs, flags.report, "--report", {".json"});
  if (flags.json) RequireFreeStandardOutput(outputs);
  const ContactSpaceOptions options = OptionsOf(flags);
  const TriangleMesh robot = LoadMesh(flags.robot);
  const TriangleMesh obstacle = LoadMesh(flags.obstacle);
  const ContactSpace space =
      LoadOrBuild(robot, obstacle, options, !flags.no_cache);
  const Json verification = VerifySample(flags, robot, obstacle, space);

  if (!flags.output.empty()) WriteContactSpaceTo(&outputs, flags.output, space);
  const ContactSpaceReport& found = space.report();
  Json report = ToJson(found);
  report["robot"] = ToJson(found.robot, found.robot_repair, flags.robot);
  report["obstacle"] =
      ToJson(found.obstacle, found.obstacle_repair, flags.obstacle);
  report["verification"] = verification;
  const std::string text = JsonText(report, 2) + '\n';
  if (!flags.report.empty()) outputs.Write(flags.report, text);
  CommitAndTell(&outputs, flags.json ? text : Summary(flags.output, found));
  return kDone;
}

}  // namespace

Command AddContactSpace(CLI::App* app) {
  auto flags = std::make_shared<ContactSpaceFlags>();
  app->add_option("A", flags->meshes,
                  std::string("Mesh of the translating robot, and B, that of "
                              "the fixed obstacle (") +
                      kMeshFormats + ")")
      ->expected(0, 2)
      ->type_name("FILE");
  app->add_option("--robot", flags->robot, "The same as A, until 0.3")
      ->type_name("FILE");
  app->add_option("--obstacle", flags->obstacle, "The same as B, until 0.3")
      ->type_name("FILE");
  app->add_option(
         "--output", flags->output,
         "Contact space: a mesh in the format of its extension, or, as "
         ".pcs, all of it (planes, kinds, report); if not set, only what "
         "was built is told")
      ->type_name("FILE");
  app->add_option("--report", flags->report, "What was built, as JSON")
      ->type_name("FILE");
  AddJson(app, &flags->json, "The report on standard output");
  app->add_flag("--robot-hull", flags->robot_hull,
                "Take the robot's convex hull: contact space only grows");
  app->add_option("--target-faces", flags->target_faces,
                  "Decimate each operand to about N triangles")
      ->type_name("N");
  app->add_option("--wrap", flags->wrap_alpha,
                  "Wrap each operand, closing gaps below about twice ALPHA, a "
                  "fraction of its diagonal (0.002 to 1)")
      ->type_name("ALPHA");
  AddRepair(app, &flags->repair);
  app->add_flag("--outer-shell-only", flags->outer_shell_only,
                "Leave out bounded free cavities");
  app->add_option("--piece", flags->piece,
                  "Build part i of n, 0 <= i < n, and write it to --output; "
                  "all n together are what phongpd join makes the contact "
                  "space of")
      ->type_name("i/n");
  AddBuildLimits(app, &flags->max_seconds, &flags->max_mib);
  AddVerify(app, &flags->verify);
  AddNoCache(app, &flags->no_cache);
  AddExamples(
      app, {"phongpd contact-space robot.off wrench.stl",
            "phongpd contact-space robot.off wrench.stl --output contact.pcs",
            "phongpd contact-space robot.off scan.ply --repair wrap "
            "--target-faces 2000 --output contact.off",
            "phongpd contact-space robot.off wrench.stl --json | jq .genus",
            "phongpd contact-space robot.off scan.ply --piece 0/4 --output "
            "0.piece"});
  return [flags] { return BuildAndWrite(*flags); };
}

}  // namespace phongpd::cli
