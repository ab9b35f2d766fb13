// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh/mesh_error.h"

namespace phongpd {

// A build that its limits do not allow (ContactSpaceOptions::max_seconds and
// max_mib): the input is sound, and another model of it may do.
class BuildRefusal : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace phongpd
