// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/operands.h"

#include <filesystem>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "problems/cli/command.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/text.h"

namespace phongpd::cli {

void AddRepair(CLI::App* app, std::string* repair) {
  app->add_option("--repair", *repair,
                  "What to do about meshes that are no solids: reject, safe "
                  "(changes no solid) or wrap (approximates); phongpd check "
                  "says what is wrong with one")
      ->check(CLI::IsMember({"reject", "safe", "wrap"}))
      ->capture_default_str()
      ->type_name("KIND");
}

TriangleMesh LoadMesh(const std::string& path) {
  std::vector<std::string> warnings;
  TriangleMesh mesh = ReadAnyMesh(path, &warnings);
  for (const std::string& line : warnings) Warn(line);
  return mesh;
}

Solid LoadSolid(const std::string& path, Repair repair) {
  MeshReport report;
  RepairReport repaired;
  Solid solid = RepairSolid(LoadMesh(path), path, repair, kRepairAlpha, &report,
                            &repaired);
  for (const std::string& action : repaired.actions) {
    Warn(path + ": " + action);
  }
  if (repaired.is_wrapped) {
    Warn(path + ": the wrap is at most " + Rounded(repaired.wrap_bound) +
         " away from the surface it had");
  }
  for (const std::string& line : NamedWarnings(report, path)) Warn(line);
  return solid;
}

void RequireFreeName(const std::string& output) {
  std::error_code none;
  if (output.empty() || !std::filesystem::is_regular_file(output, none)) return;
  throw InputError(output +
                   ": expected a name that is free, found a file; name "
                   "another, or remove it");
}

void WarnOfUnits(const TriangleMesh& a, const std::string& name_a,
                 const TriangleMesh& b, const std::string& name_b) {
  const std::string note = UnitsNote(a, name_a, b, name_b);
  if (!note.empty()) Warn(note);
}

}  // namespace phongpd::cli
