// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/minkowski/contact_space_options.h"

namespace phongpd::python {

// Of ContactSpace.build and ContactSpacePiece.build, as Python hands them on.
inline ContactSpaceOptions BuildOptions(bool robot_hull, size_t target_faces,
                                        double wrap, bool outer_shell_only,
                                        double max_seconds, double max_mib) {
  ContactSpaceOptions options;
  options.robot_hull = robot_hull;
  options.target_faces = target_faces;
  options.wrap_alpha = wrap;
  options.outer_shell_only = outer_shell_only;
  options.max_seconds = max_seconds;
  options.max_mib = max_mib;
  return options;
}

}  // namespace phongpd::python
