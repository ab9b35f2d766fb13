// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "core/contact_space/contact_space.h"
#include "problems/cli/command.h"
#include "problems/output_files.h"
#include "problems/text.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Flags {
  std::string robot;
  std::string obstacle;
  std::string output;
  std::string report;
  bool outer_shell_only = false;
  double max_seconds = 0.0;
  double max_mib = 0.0;
};

Json ToJson(const MeshReport& mesh, const std::string& file) {
  return {{"file", file},
          {"vertices", mesh.vertices},
          {"triangles", mesh.triangles},
          {"components", mesh.components},
          {"degenerate_triangles", mesh.degenerate_triangles},
          {"duplicate_vertices", mesh.duplicate_vertices},
          {"duplicate_triangles", mesh.duplicate_triangles},
          {"inverted_components", mesh.inverted_components},
          {"volume", mesh.volume},
          {"warnings", mesh.warnings}};
}

Json ToJson(const ContactSpaceReport& report) {
  Json seconds = Json::object();
  for (const auto& [stage, time] : report.seconds) seconds[stage] = time;
  return {{"triangles", report.triangles},
          {"vertices", report.vertices},
          {"closed", report.closed},
          {"manifold", report.manifold},
          {"components", report.components},
          {"genus", report.genus},
          {"cavities", report.cavities},
          {"volume", report.volume},
          {"self_intersections", report.self_intersections},
          {"degenerate_triangles", report.degenerate_triangles},
          {"seconds", seconds},
          {"peak_mib", report.peak_mib},
          {"method", report.method},
          {"predicted_cost",
           {{"meetings", report.predicted.meetings},
            {"arrangement_faces", report.predicted.arrangement_faces},
            {"seconds", report.predicted.seconds},
            {"mib", report.predicted.mib}}},
          {"approximation", {{"kind", "none"}, {"bound", report.grid_step}}},
          {"convolution_triangles", report.convolution_triangles},
          {"arrangement_faces", report.arrangement_faces},
          {"cells", report.cells},
          {"judged_cells", report.judged_cells},
          {"canonical_frame", report.canonical_frame},
          {"grid_step", report.grid_step},
          {"warnings", report.warnings}};
}

std::string Plural(int count, const char* noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string Rounded(double value) {
  std::ostringstream stream;
  stream.precision(4);
  stream << value;
  return stream.str();
}

void PrintSummary(const Flags& flags, const ContactSpaceReport& report) {
  double total = 0.0;
  for (const auto& [stage, time] : report.seconds) total += time;
  std::cout << flags.output << ": " << report.triangles << " triangles, "
            << report.vertices << " vertices, "
            << (report.closed ? "closed, " : "NOT CLOSED, ")
            << (report.manifold ? "manifold, " : "NOT MANIFOLD, ")
            << Plural(report.components, "component") << ", genus "
            << report.genus << ", "
            << (report.cavities == 1 ? "1 cavity"
                                     : Plural(report.cavities, "cavitie"))
            << ", volume " << FormatDouble(report.volume) << '\n'
            << "built in " << Rounded(total) << " s, peak "
            << Rounded(report.peak_mib) << " MiB, "
            << report.convolution_triangles << " convolution and "
            << report.arrangement_faces << " arrangement faces\n";
}

int BuildAndWrite(const Flags& flags) {
  OutputFiles outputs;
  DeclareMesh(&outputs, flags.output);
  if (!flags.report.empty()) outputs.Declare(flags.report);
  MeshReport robot_report;
  MeshReport obstacle_report;
  const TriangleMesh robot = LoadSolid(flags.robot, &robot_report);
  const TriangleMesh obstacle = LoadSolid(flags.obstacle, &obstacle_report);

  ContactSpaceOptions options;
  options.outer_shell_only = flags.outer_shell_only;
  options.max_seconds = flags.max_seconds;
  options.max_mib = flags.max_mib;
  options.robot_name = flags.robot;
  options.obstacle_name = flags.obstacle;
  Progress("building the contact space");
  const ContactSpace space = BuildContactSpace(robot, obstacle, options);
  for (const std::string& warning : space.report.warnings) Warn(warning);

  WriteMeshTo(&outputs, flags.output, space.mesh);
  if (!flags.report.empty()) {
    Json report = ToJson(space.report);
    report["robot"] = ToJson(robot_report, flags.robot);
    report["obstacle"] = ToJson(obstacle_report, flags.obstacle);
    outputs.Write(flags.report, report.dump(2) + '\n');
  }
  const bool silent = outputs.UseStandardOutput();
  outputs.Commit();
  if (!silent) PrintSummary(flags, space.report);
  return kDone;
}

}  // namespace

Command AddContactSpace(CLI::App* app) {
  auto flags = std::make_shared<Flags>();
  app->add_option("--robot", flags->robot,
                  "Mesh of the translating robot (OFF, OBJ, STL, PLY)")
      ->required()
      ->type_name("FILE");
  app->add_option("--obstacle", flags->obstacle, "Mesh of the fixed obstacle")
      ->required()
      ->type_name("FILE");
  app->add_option("--output", flags->output,
                  "Contact space, in the format of its extension")
      ->required()
      ->type_name("FILE");
  app->add_option("--report", flags->report, "What was built, as JSON")
      ->type_name("FILE");
  app->add_flag("--outer-shell-only", flags->outer_shell_only,
                "Leave out bounded free cavities");
  app->add_option("--max-seconds", flags->max_seconds,
                  "Refuse what is predicted to take longer (0: never)")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
  app->add_option("--max-mib", flags->max_mib,
                  "Refuse what is predicted to need more memory (0: never)")
      ->type_name("MIB")
      ->check(CLI::NonNegativeNumber);
  return [flags] { return BuildAndWrite(*flags); };
}

}  // namespace phongpd::cli
