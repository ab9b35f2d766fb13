// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "core/mesh/mesh_error.h"

// How a build of a contact space ends without one.
namespace phongpd {

// A limit would be passed, or was (ContactSpaceOptions::max_seconds, max_mib).
// The input is sound: higher limits, or a coarser model, may do.
class BuildRefusal : public InputError {
 public:
  using InputError::InputError;
};

// CancelBuilds stopped it, or another work that watches for that.
class BuildCancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Stops all builds of contact spaces (BuildContactSpace and whatever calls it)
// that are running in this process: each throws BuildCancelled, as a rule
// within a tenth of a second, and leaves nothing behind.  Builds that begin
// later are not touched.  For programs that a person may interrupt; safe to
// call from any thread and from signal handlers.
void CancelBuilds();

// For other work that takes long: CancelBuilds stops it like a build.  Solves
// by Ipopt, samplers and the routes of contact-surface look.  Thread-safe.
class CancelWatch {
 public:
  CancelWatch();  // from now on

  bool IsCancelled() const;
  // Throws BuildCancelled "<what> was cancelled".
  void Check(const char* what) const;

 private:
  unsigned before_;
};

}  // namespace phongpd
