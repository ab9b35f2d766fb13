// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before a program (LD_PRELOAD), it writes down where the program does
// an invalid floating-point operation, one that makes or compares a NaN: lines
// "FILE OFFSET" appended to $PHONGPD_INVALID_LOG, each place once a process.
// The program goes on as it would have.  Linux on x86-64; threads take the
// trap over from the one that starts them.
#include <dlfcn.h>
#include <fcntl.h>
#include <fenv.h>
#include <signal.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr unsigned kMaskSse = 0x80, kFlagSse = 0x01;
constexpr unsigned short kMaskX87 = 0x01, kFlagsX87 = 0x81;
constexpr long kSingleStep = 0x100;

int log_file = -1;

void Record(std::uintptr_t place) {
  static std::atomic<std::uintptr_t> known[4096];
  for (std::size_t i = 0; i < 4096; ++i) {
    std::atomic<std::uintptr_t>& slot = known[(place + i) % 4096];
    std::uintptr_t free_slot = 0;
    if (slot.compare_exchange_strong(free_slot, place)) break;
    if (free_slot == place) return;
  }
  Dl_info module;
  if (dladdr(reinterpret_cast<void*>(place), &module) == 0) return;
  const auto base = reinterpret_cast<std::uintptr_t>(module.dli_fbase);
  char line[512];
  const int size = std::snprintf(line, sizeof line, "%s %#jx\n",
                                 module.dli_fname, place - base);
  if (size > 0 && write(log_file, line, static_cast<std::size_t>(size)) < 0) {
    std::abort();
  }
}

// The operation is done again with the trap off; the step after it turns the
// trap on.
void OnInvalid(int, siginfo_t*, void* context) {
  mcontext_t& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
  Record(static_cast<std::uintptr_t>(machine.gregs[REG_RIP]));
  machine.fpregs->mxcsr = (machine.fpregs->mxcsr | kMaskSse) & ~kFlagSse;
  machine.fpregs->cwd |= kMaskX87;
  machine.fpregs->swd &= static_cast<unsigned short>(~kFlagsX87);
  machine.gregs[REG_EFL] |= kSingleStep;
}

void OnStep(int, siginfo_t*, void* context) {
  mcontext_t& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
  machine.fpregs->mxcsr &= ~(kMaskSse | kFlagSse);
  machine.fpregs->cwd &= static_cast<unsigned short>(~kMaskX87);
  machine.fpregs->swd &= static_cast<unsigned short>(~kFlagsX87);
  machine.gregs[REG_EFL] &= ~kSingleStep;
}

[[gnu::constructor]] void TrapInvalid() {
  const char* const name = std::getenv("PHONGPD_INVALID_LOG");
  if (name == nullptr) return;
  log_file = open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  struct sigaction action = {};
  action.sa_flags = SA_SIGINFO;
  action.sa_sigaction = OnInvalid;
  sigaction(SIGFPE, &action, nullptr);
  action.sa_sigaction = OnStep;
  sigaction(SIGTRAP, &action, nullptr);
  feenableexcept(FE_INVALID);
}

}  // namespace
