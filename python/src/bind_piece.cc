// SPDX-License-Identifier: GPL-3.0-or-later
// Contact spaces by pieces.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "core/contact/contact_space_piece.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_io.h"
#include "core/solid/solid.h"
#include "python/src/bindings.h"
#include "python/src/build_options.h"
#include "python/src/interruptible.h"

namespace phongpd::python {
namespace {

ContactSpacePiece Build(const Solid& robot, const Solid& obstacle, int index,
                        int count, bool robot_hull, size_t target_faces,
                        double wrap, bool outer_shell_only, double max_seconds,
                        double max_mib) {
  ContactSpaceOptions options = BuildOptions(
      robot_hull, target_faces, wrap, outer_shell_only, max_seconds, max_mib);
  options.robot_name = robot.name();
  options.obstacle_name = obstacle.name();
  return Interruptible([&] {
    return BuildContactSpacePiece(robot.mesh(), obstacle.mesh(), options,
                                  {index, count});
  });
}

ContactSpacePiece Read(const std::string& path) {
  const Computing computing;
  return ParsePiece(
      ReadInputFile(path, "a piece of a contact space", kMaxMeshBytes), path);
}

nb::bytes Content(const ContactSpacePiece& piece) {
  const std::string bytes = [&] {
    const Computing computing;
    return PieceContent(piece);
  }();
  return nb::bytes(bytes.data(), bytes.size());
}

}  // namespace

void BindPiece(nb::module_& module) {
  nb::class_<ContactSpacePiece>(module, "ContactSpacePiece")
      .def_static("build", &Build)
      .def_static("read", &Read)
      .def("content", &Content)
      .def_prop_ro("index",
                   [](const ContactSpacePiece& p) { return p.number().index; })
      .def_prop_ro("count",
                   [](const ContactSpacePiece& p) { return p.number().count; })
      .def_prop_ro("boxes", &ContactSpacePiece::boxes)
      .def_prop_ro("faces", &ContactSpacePiece::faces);
  module.def("join", [](const std::vector<ContactSpacePiece>& pieces) {
    return Interruptible([&] { return JoinContactSpace(pieces); });
  });
}

}  // namespace phongpd::python
