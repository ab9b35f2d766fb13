// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before a program (LD_PRELOAD) it makes every invalid floating-point
// operation, one that gives NaN or compares with it, end the program.  Threads
// take the setting over from the one that starts them.
#include <fenv.h>

namespace {
[[gnu::constructor]] void TrapInvalid() { feenableexcept(FE_INVALID); }
}  // namespace
