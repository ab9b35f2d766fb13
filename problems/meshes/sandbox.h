// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace phongpd {

struct SandboxLimits {
  double max_mib = 4096.0;     // that the process may grow by
  double max_seconds = 120.0;  // of its processor time
  // By the clock, for what waits: far more, as the machine may be busy.
  double max_wait_seconds = 600.0;
};

// For the reader of a file of that many bytes: what its contents can need many
// times over, so that a small one that says it is huge ends soon.
SandboxLimits LimitsFor(std::size_t bytes);

// Runs `work` in a process of its own and returns the bytes that it returned.
// What it prints is not seen, and it ends when this process does.  For
// libraries that a file can make crash, or run and allocate without end; `work`
// may use no threads. Throws InputError "<what>: …" when the process ends in
// another way, and with the words of an exception that left `work`.
std::string RunInSandbox(const std::string& what,
                         const std::function<std::string()>& work,
                         const SandboxLimits& limits = {});

}  // namespace phongpd
