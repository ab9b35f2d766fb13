// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/bounds/mesh_repair.h"
#include "core/mesh/triangle_mesh.h"

// What people say of operands, and should be told of them.
namespace phongpd {

// reject, safe or wrap.  Throws InputError naming `what` (a flag or a key).
Repair ParseRepair(const std::string& text, const std::string& what);

// A sentence where two meshes that go together are of sizes that do not: one
// diagonal more than 300 times the other, as of a part in metres beside one in
// millimetres; else empty.
std::string UnitsNote(const TriangleMesh& a, const std::string& name_a,
                      const TriangleMesh& b, const std::string& name_b);

}  // namespace phongpd
