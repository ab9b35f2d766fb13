// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/bounds/mesh_repair.h"
#include "core/mesh/counted.h"
#include "core/solid/mesh_defects.h"
#include "core/solid/solid.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_report_json.h"
#include "problems/cli/depth_row.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/defect_mesh.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"
#include "viewer/page_numbers.h"

namespace phongpd::cli {
namespace {

using internal::PointJson;
using Json = nlohmann::ordered_json;

// Of a kind of defect, for people and in JSON.
constexpr std::size_t kShownPlaces = 3, kListedPlaces = 1000;

struct CheckFlags {
  std::vector<std::string> files;
  std::string repair = "reject";
  std::string defects;
  std::string output;
  bool json = false;
};

// One mesh, as it is and as it is repaired.
struct Finding {
  std::string file;
  TriangleMesh mesh;
  MeshReport examined;
  std::vector<MeshDefect> defects;
  bool is_solid = false;
  std::string reason;  // why not
  Solid solid;
  MeshReport report;
  RepairReport repair;
};

Finding Examine(const std::string& file, Repair repair) {
  Finding finding;
  finding.file = file;
  finding.mesh = LoadMesh(file);
  Progress("examining " + file);
  finding.examined = ExamineMesh(finding.mesh);
  finding.defects = FindDefects(finding.mesh);
  try {
    finding.solid = RepairSolid(finding.mesh, file, repair, kRepairAlpha,
                                &finding.report, &finding.repair);
    finding.is_solid = true;
  } catch (const InputError& error) {
    finding.reason = error.what();
  }
  return finding;
}

Json FindingJson(const Finding& finding) {
  Json places = Json::array();
  std::map<DefectKind, std::size_t> counts;
  for (const MeshDefect& defect : finding.defects) {
    if (++counts[defect.kind] > kListedPlaces) continue;
    places.push_back({{"kind", ToString(defect.kind)},
                      {"place", PointJson(defect.place)},
                      {"triangles", defect.triangles}});
  }
  Json totals = Json::object();
  for (const auto& [kind, count] : counts) totals[ToString(kind)] = count;
  const BoundingBox box = ComputeBounds(finding.mesh);
  const int genus = SurfaceGenus(finding.mesh);
  Json json = ToJson(finding.is_solid ? finding.report : finding.examined,
                     finding.repair, finding.file);
  json["solid"] = finding.is_solid;
  json["reason"] = finding.reason;
  json["genus"] = genus < 0 ? Json() : Json(genus);
  json["genus_after"] =
      finding.is_solid ? Json(SurfaceGenus(finding.solid)) : Json();
  json["bounds"] = {{"min", PointJson(box.min)}, {"max", PointJson(box.max)}};
  json["diagonal"] = box.Diagonal();
  json["defect_counts"] = totals;
  json["defects"] = places;
  return json;
}

std::string Places(const Finding& finding) {
  TextStream text;
  for (const DefectKind kind :
       {DefectKind::kOpenEdge, DefectKind::kNonManifoldEdge,
        DefectKind::kMisorientedEdge, DefectKind::kSelfIntersection}) {
    std::vector<std::string> places;
    for (const MeshDefect& defect : finding.defects) {
      if (defect.kind == kind) {
        places.push_back('(' + RoundedPoint(defect.place) + ')');
      }
    }
    if (places.empty()) continue;
    text << "  " << ToString(kind) << ": " << places.size() << ", at ";
    const bool has_more = places.size() > kShownPlaces;
    if (has_more) places.resize(kShownPlaces);
    text << Joined(places, " ") << (has_more ? " ..." : "") << '\n';
  }
  return text.str();
}

std::string Words(const Finding& finding) {
  TextStream text;
  const BoundingBox box = ComputeBounds(finding.mesh);
  const MeshReport& found = finding.examined;
  text << finding.file << ": " << Counted(found.triangles, "triangle") << ", "
       << Counted(found.vertices, "vertex", "vertices") << ", "
       << Counted(found.components, "component");
  const int genus = SurfaceGenus(finding.mesh);
  if (genus >= 0) text << ", genus " << genus;
  text << ", diagonal " << Rounded(box.Diagonal(), kDigits) << " from ("
       << RoundedPoint(box.min) << ") to (" << RoundedPoint(box.max) << ")\n"
       << Places(finding);
  for (const std::string& line : finding.repair.actions) {
    text << "  " << line << '\n';
  }
  for (const std::string& line : finding.report.warnings) {
    text << "  " << line << '\n';
  }
  if (finding.is_solid) {
    text << "  a solid, volume "
         << Rounded(SignedVolume(finding.solid), kDigits);
    if (finding.repair.is_wrapped) {
      text << ", at most " << Rounded(finding.repair.wrap_bound)
           << " away from the surface it had";
    }
    text << '\n';
  } else {
    // The file is named above.
    const std::string name = finding.file + ": ";
    const bool is_named = finding.reason.rfind(name, 0) == 0;
    text << "  NO SOLID: "
         << (is_named ? finding.reason.substr(name.size()) : finding.reason)
         << '\n';
  }
  return text.str();
}

int Check(const CheckFlags& flags) {
  const bool writes = !flags.defects.empty() || !flags.output.empty();
  if (writes && flags.files.size() != 1) {
    throw InputError(
        "--defects, --output: expected one mesh with them, found " +
        std::to_string(flags.files.size()));
  }
  OutputFiles outputs;
  DeclareIfNamed(&outputs, flags.defects, "--defects", {".off", ".ply"});
  if (!flags.output.empty()) {
    RequireFreeName(flags.output);
    DeclareMesh(&outputs, flags.output);
  }
  if (flags.json) RequireFreeStandardOutput(outputs);
  const Repair repair = ParseRepair(flags.repair, "--repair");
  std::string text;
  bool are_solids = true;
  for (const std::string& file : flags.files) {
    const Finding finding = Examine(file, repair);
    are_solids = are_solids && finding.is_solid;
    text += flags.json ? JsonText(FindingJson(finding)) + '\n' : Words(finding);
    if (!flags.defects.empty()) {
      outputs.Write(
          flags.defects,
          DefectMeshContent(finding.mesh, finding.defects, flags.defects));
    }
    if (!flags.output.empty()) {
      if (!finding.is_solid) throw InputError(finding.reason);
      WriteMeshTo(&outputs, flags.output, finding.solid);
    }
  }
  CommitAndTell(&outputs, text);
  return are_solids ? kDone : kNoAnswer;
}

}  // namespace

Command AddCheck(CLI::App* app) {
  auto flags = std::make_shared<CheckFlags>();
  app->add_option("MESH", flags->files,
                  std::string("Meshes to examine (") + kMeshFormats + ")")
      ->required()
      ->type_name("FILE");
  AddRepair(app, &flags->repair);
  app->add_option("--defects", flags->defects,
                  "The triangles at the defects as a mesh to look at (OFF or "
                  "PLY): red at open edges, orange at edges of three or more, "
                  "blue where directions differ, magenta where it crosses "
                  "itself")
      ->type_name("FILE");
  app->add_option("--output", flags->output,
                  "The solid, repaired as --repair asks; refused if it is none")
      ->type_name("FILE");
  AddJson(app, &flags->json,
          "An object a mesh: counts, genus, size, what a repair did, and the "
          "places of up to 1000 defects of a kind");
  AddExamples(
      app,
      {"phongpd check part.stl", "phongpd check scan.ply --defects bad.ply",
       "phongpd check scan.ply --repair wrap --output solid.off",
       "phongpd check robot.urdf#arm base.dae --json"},
      "Exit code 0: all are solids (after the repair); 1: not all.");
  return [flags] { return Check(*flags); };
}

}  // namespace phongpd::cli
