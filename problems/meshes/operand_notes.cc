// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/operand_notes.h"

#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/output/text.h"

namespace phongpd {

Repair ParseRepair(const std::string& text, const std::string& what) {
  if (text == "reject") return Repair::kReject;
  if (text == "safe") return Repair::kSafe;
  if (text == "wrap") return Repair::kWrap;
  throw InputError(what + ": expected reject, safe or wrap, found " + text);
}

std::string UnitsNote(const TriangleMesh& a, const std::string& name_a,
                      const TriangleMesh& b, const std::string& name_b) {
  // Between a metre and a millimetre are 1000; the sizes of parts that go
  // together spread by less than the rest.
  constexpr double kSuspicious = 300.0;
  const double size_a = ComputeBounds(a).Diagonal();
  const double size_b = ComputeBounds(b).Diagonal();
  const double ratio = size_a > size_b ? size_a / size_b : size_b / size_a;
  if (!(ratio > kSuspicious)) return "";
  return name_a + " and " + name_b + ": diagonals " + Rounded(size_a) +
         " and " + Rounded(size_b) + ", " + Rounded(ratio) +
         " times apart; is one in metres and the other in millimetres?";
}

}  // namespace phongpd
