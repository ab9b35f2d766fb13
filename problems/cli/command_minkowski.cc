// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_io.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/contact_space_report_json.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"

namespace phongpd::cli {
namespace {

struct MinkowskiFlags {
  std::string a;
  std::string b;
  std::string output;
  std::string report;
  std::string repair = "reject";
  bool difference = false;
  double max_seconds = 0.0;
  double max_mib = 0.0;
  bool json = false;
  bool no_cache = false;
};

// −A: every point through the origin, and so every triangle turned over.
TriangleMesh Reflected(TriangleMesh mesh) {
  for (Eigen::Vector3d& v : mesh.vertices) v = -v;
  return Reversed(std::move(mesh));
}

// The contact space of a robot A and an obstacle B is that of B ⊕ (−A), and so
// B ⊕ A the one of −A and B.
int Sum(const MinkowskiFlags& flags) {
  OutputFiles outputs;
  const bool has_output = !flags.output.empty();
  if (has_output && flags.difference) {
    DeclareContactSpace(&outputs, flags.output);
  } else if (has_output) {
    DeclareMesh(&outputs, flags.output);
  }
  DeclareIfNamed(&outputs, flags.report, "--report", {".json"});
  if (flags.json) RequireFreeStandardOutput(outputs);
  ContactSpaceOptions options;
  options.repair = ParseRepair(flags.repair, "--repair");
  options.robot_name = flags.a;
  options.obstacle_name = flags.b;
  options.max_seconds = flags.max_seconds;
  options.max_mib = flags.max_mib;
  TriangleMesh a = LoadMesh(flags.a);
  const TriangleMesh b = LoadMesh(flags.b);
  if (!flags.difference) a = Reflected(std::move(a));
  const ContactSpace space = LoadOrBuild(a, b, options, !flags.no_cache);
  if (has_output && flags.difference) {
    WriteContactSpaceTo(&outputs, flags.output, space);
  } else if (has_output) {
    WriteMeshTo(&outputs, flags.output, space.mesh());
  }
  const ContactSpaceReport& found = space.report();
  nlohmann::ordered_json report = {
      {"sum", flags.difference ? "B + (-A)" : "A + B"}};
  report.update(ToJson(found));
  report["a"] = ToJson(found.robot, found.robot_repair, flags.a);
  report["b"] = ToJson(found.obstacle, found.obstacle_repair, flags.b);
  const std::string text = JsonText(report, 2) + '\n';
  if (!flags.report.empty()) outputs.Write(flags.report, text);
  CommitAndTell(&outputs, flags.json ? text : Summary(flags.output, found));
  return kDone;
}

}  // namespace

Command AddMinkowski(CLI::App* app) {
  auto flags = std::make_shared<MinkowskiFlags>();
  app->add_option("A", flags->a,
                  std::string("Mesh of a solid (") + kMeshFormats + ")")
      ->required()
      ->type_name("FILE");
  app->add_option("B", flags->b, "Mesh of another")
      ->required()
      ->type_name("FILE");
  app->add_flag("--difference", flags->difference,
                "B + (-A), all differences b - a: the contact space of a robot "
                "A and an obstacle B");
  app->add_option("--output", flags->output,
                  "Surface of the sum, in the format of its extension; of a "
                  "difference also .pcs; if not set, only what was built is "
                  "told")
      ->type_name("FILE");
  app->add_option("--report", flags->report, "What was built, as JSON")
      ->type_name("FILE");
  AddRepair(app, &flags->repair);
  AddJson(app, &flags->json, "The report on standard output");
  AddBuildLimits(app, &flags->max_seconds, &flags->max_mib);
  AddNoCache(app, &flags->no_cache);
  AddExamples(app, {"phongpd minkowski tool.off part.stl --output sum.off",
                    "phongpd minkowski tool.off part.stl --difference "
                    "--output contact.pcs --report report.json"});
  return [flags] { return Sum(*flags); };
}

}  // namespace phongpd::cli
