// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/bounds/mesh_repair.h"
#include "core/solid/solid.h"

// How commands read the meshes that people name.
namespace phongpd::cli {

// Declares --repair: what happens to meshes that are no solids.
void AddRepair(CLI::App* app, std::string* repair);

// ReadAnyMesh; what the user should know goes to standard error, one line a
// warning.
TriangleMesh LoadMesh(const std::string& path);

// Reads an operand as a solid, repaired as --repair asks; what was done goes to
// standard error, too.  Throws InputError naming the file.
Solid LoadSolid(const std::string& path, Repair repair = Repair::kReject);

// Warns where the sizes of two operands suggest different units.
void WarnOfUnits(const TriangleMesh& a, const std::string& name_a,
                 const TriangleMesh& b, const std::string& name_b);

// Throws InputError where a file has that name: a mesh or scene that somebody
// has made is not replaced without a word.
void RequireFreeName(const std::string& output);

}  // namespace phongpd::cli
