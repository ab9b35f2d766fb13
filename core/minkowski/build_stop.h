// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "core/mesh/mesh_error.h"

// How a build of a contact space ends without one.
namespace phongpd {

// Its limits do not allow it (ContactSpaceOptions::max_seconds and max_mib):
// the input is sound, and another model of it may do.
class BuildRefusal : public InputError {
 public:
  using InputError::InputError;
};

// CancelBuilds stopped it.
class BuildCancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Stops all builds of contact spaces (BuildContactSpace and whatever calls it)
// that are running in this process: each throws BuildCancelled, as a rule
// within a tenth of a second, and leaves nothing behind.  Builds that begin
// later are not touched.  For whoever lets people interrupt; safe from any
// thread and from signal handlers.
void CancelBuilds();

}  // namespace phongpd
