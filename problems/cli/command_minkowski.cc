// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_io.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/contact_space_report_json.h"
#include "problems/output/output_files.h"

namespace phongpd::cli {
namespace {

struct Flags {
  std::string a;
  std::string b;
  std::string output;
  std::string report;
  bool difference = false;
  double max_seconds = 0.0;
  double max_mib = 0.0;
  bool no_cache = false;
};

// −A: every point through the origin, and so every triangle turned over.
TriangleMesh Reflected(TriangleMesh mesh) {
  for (Eigen::Vector3d& v : mesh.vertices) v = -v;
  return Reversed(std::move(mesh));
}

// The contact space of a robot A and an obstacle B is that of B ⊕ (−A), and so
// B ⊕ A the one of −A and B.
int Sum(const Flags& flags) {
  OutputFiles outputs;
  if (flags.difference) {
    DeclareContactSpace(&outputs, flags.output);
  } else {
    DeclareMesh(&outputs, flags.output);
  }
  if (!flags.report.empty()) outputs.Declare(flags.report);
  ContactSpaceOptions options;
  options.robot_name = flags.a;
  options.obstacle_name = flags.b;
  options.max_seconds = flags.max_seconds;
  options.max_mib = flags.max_mib;
  TriangleMesh a = ReadMesh(flags.a);
  const TriangleMesh b = ReadMesh(flags.b);
  if (!flags.difference) a = Reflected(std::move(a));
  const ContactSpace space = LoadOrBuild(a, b, options, !flags.no_cache);
  if (flags.difference) {
    WriteContactSpaceTo(&outputs, flags.output, space);
  } else {
    WriteMeshTo(&outputs, flags.output, space.mesh());
  }
  const ContactSpaceReport& found = space.report();
  if (!flags.report.empty()) {
    nlohmann::ordered_json report = {
        {"sum", flags.difference ? "B + (-A)" : "A + B"}};
    report.update(ToJson(found));
    report["a"] = ToJson(found.robot, found.robot_repair, flags.a);
    report["b"] = ToJson(found.obstacle, found.obstacle_repair, flags.b);
    outputs.Write(flags.report, report.dump(2) + '\n');
  }
  CommitAndTell(&outputs, Summary(flags.output, found));
  return kDone;
}

}  // namespace

Command AddMinkowski(CLI::App* app) {
  auto flags = std::make_shared<Flags>();
  app->add_option("A", flags->a, "Mesh of a solid (OFF, OBJ, STL, PLY)")
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
                  "difference also .pcs")
      ->required()
      ->type_name("FILE");
  app->add_option("--report", flags->report, "What was built, as JSON")
      ->type_name("FILE");
  AddBuildLimits(app, &flags->max_seconds, &flags->max_mib);
  AddNoCache(app, &flags->no_cache);
  return [flags] { return Sum(*flags); };
}

}  // namespace phongpd::cli
