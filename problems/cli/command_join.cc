// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/contact/contact_space_piece.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_io.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/contact_space_report_json.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

struct JoinFlags {
  std::vector<std::string> pieces;
  std::string output;
  std::string report;
  bool json = false;
};

int Join(const JoinFlags& flags) {
  OutputFiles outputs;
  if (!flags.output.empty()) DeclareContactSpace(&outputs, flags.output);
  DeclareIfNamed(&outputs, flags.report, "--report", {".json"});
  if (flags.json) RequireFreeStandardOutput(outputs);
  std::vector<ContactSpacePiece> pieces;
  for (const std::string& path : flags.pieces) {
    pieces.push_back(ParsePiece(
        ReadInputFile(path, "a piece of a contact space", kMaxMeshBytes),
        path));
  }
  const ContactSpace space = JoinContactSpace(pieces);
  pieces.clear();
  if (!flags.output.empty()) WriteContactSpaceTo(&outputs, flags.output, space);
  const ContactSpaceReport& found = space.report();
  Json report = ToJson(found);
  report["robot"] = ToJson(found.robot, found.robot_repair, "robot");
  report["obstacle"] =
      ToJson(found.obstacle, found.obstacle_repair, "obstacle");
  const std::string text = JsonText(report, 2) + '\n';
  if (!flags.report.empty()) outputs.Write(flags.report, text);
  CommitAndTell(&outputs, flags.json ? text : Summary(flags.output, found));
  return kDone;
}

}  // namespace

Command AddJoin(CLI::App* app) {
  auto flags = std::make_shared<JoinFlags>();
  app->add_option("pieces", flags->pieces,
                  "Files that contact-space --piece i/n wrote: all n, in any "
                  "order; 2i/2n and 2i+1/2n stand for i/n")
      ->required()
      ->type_name("FILE");
  app->add_option("--output", flags->output,
                  "Contact space, as contact-space writes it: a mesh, or a "
                  ".pcs file; if not set, only what was built is told")
      ->type_name("FILE");
  app->add_option("--report", flags->report, "What was built, as JSON")
      ->type_name("FILE");
  AddJson(app, &flags->json, "The report on standard output");
  AddExamples(
      app,
      {"phongpd contact-space robot.off scan.ply --piece "
       "0/2 --output 0.piece",
       "phongpd contact-space robot.off scan.ply --piece "
       "1/2 --output 1.piece",
       "phongpd join 0.piece 1.piece --output contact.pcs"},
      "The pieces may be built at once, on several machines.  The result is "
      "that of one whole build.  A piece that is lost, repeated, cut short or "
      "of another build is named, and nothing is written.");
  return [flags] { return Join(*flags); };
}

}  // namespace phongpd::cli
