// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <unistd.h>

#include "core/mesh/mesh_error.h"

namespace phongpd::python {

// A thread of this process is inside the library.  A fork takes along the locks
// such threads hold, but not the threads: in a child that was forked meanwhile
// a call might wait for ever, so that it is refused.  The counts are kept under
// Python's lock, which a fork from Python holds, too.
class InProgress {
 public:
  // Throws InputError in such a child.
  InProgress() {
    const pid_t here = getpid();
    if (here != home_ && count_ > 0) {
      throw InputError(
          "phongpd: this process was forked while another thread computed with "
          "it, expected none to; start workers by multiprocessing's spawn or "
          "forkserver, or fork before");
    }
    home_ = here;
    ++count_;
  }
  ~InProgress() { --count_; }
  InProgress(const InProgress&) = delete;
  InProgress& operator=(const InProgress&) = delete;

 private:
  static inline pid_t home_ = getpid();
  static inline int count_ = 0;
};

// Other Python threads run on until the end of the scope.
class Computing {
 private:
  const InProgress mark_;  // goes when Python's lock is back
  const nanobind::gil_scoped_release release_;
};

}  // namespace phongpd::python
