// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/sandbox.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>

#include "core/mesh/mesh_error.h"
#include "files/descriptor.h"

namespace phongpd {
namespace {

using internal::Descriptor;

// Sanitizers reserve terabytes of addresses.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

constexpr char kAnswer = 'a', kError = 'e';

void Limit(const SandboxLimits& limits) {
  const auto set = [](__rlimit_resource which, double value) {
    rlimit limit;
    if (getrlimit(which, &limit) != 0) return;
    const auto wanted = static_cast<rlim_t>(value);
    if (wanted < limit.rlim_cur) limit.rlim_cur = wanted;
    setrlimit(which, &limit);
  };
  set(RLIMIT_CORE, 0.0);
  set(RLIMIT_CPU, std::ceil(limits.max_seconds));
  if (!kLimitsMemory) return;
  double pages = 0.0;
  std::ifstream("/proc/self/statm") >> pages;
  set(RLIMIT_AS, pages * static_cast<double>(sysconf(_SC_PAGESIZE)) +
                     limits.max_mib * 1024.0 * 1024.0);
}

// The handlers of the parent would remove its files.
void ResetSignals() {
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGSEGV, SIGABRT,
                           SIGFPE, SIGBUS, SIGILL, SIGXCPU, SIGPIPE}) {
    std::signal(number, SIG_DFL);
  }
}

[[noreturn]] void Child(pid_t parent, const Descriptor& out,
                        const std::function<std::string()>& work,
                        const SandboxLimits& limits) {
  ResetSignals();
  // It ends with its parent, which may have ended before that was said.
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) _exit(1);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  // Nor is what the parent has yet to print printed here as well.
  for (const int number : {STDOUT_FILENO, STDERR_FILENO}) {
    if (nowhere >= 0 && number != out.number()) dup2(nowhere, number);
  }
  int code = 0;
  try {
    Limit(limits);
    internal::WriteAll(out, kAnswer + work());
  } catch (const std::bad_alloc&) {
    code = 1;
  } catch (const std::exception& error) {
    try {
      internal::WriteAll(out, std::string(1, kError) + error.what());
    } catch (...) {
      code = 1;
    }
  } catch (...) {
    code = 1;
  }
  // No destructors: what they would remove is the parent's.
  _exit(code);
}

// Until the other end is closed, at most that long; whether it was.
bool ReadToEnd(const Descriptor& in, double seconds, std::string* bytes) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const std::chrono::duration<double, std::milli> left = end - Clock::now();
    pollfd waiting = {in.number(), POLLIN, 0};
    const int ready = poll(&waiting, 1, std::max(0, int(left.count()) + 1));
    if (ready == 0) return false;
    if (ready < 0 && errno == EINTR) continue;
    const ssize_t count = read(in.number(), buffer.data(), buffer.size());
    if (count > 0) {
      bytes->append(buffer.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      return true;
    }
  }
}

std::string Ending(int status) {
  if (WIFSIGNALED(status)) {
    return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
               ? "one that takes too long to read"
               : "one that its reader crashes on";
  }
  return "one that needs too much memory to read";
}

}  // namespace

SandboxLimits LimitsFor(std::size_t bytes) {
  const SandboxLimits most;
  const double mib = static_cast<double>(bytes) / 0x1p20;
  const double seconds = std::min(most.max_seconds, 8.0 + 4.0 * mib);
  return {std::min(most.max_mib, 512.0 + 256.0 * mib), seconds,
          std::min(most.max_wait_seconds, 10.0 * seconds)};
}

std::string RunInSandbox(const std::string& what,
                         const std::function<std::string()>& work,
                         const SandboxLimits& limits) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw InputError(what + ": cannot be read (" + std::strerror(errno) + ")");
  }
  const Descriptor in(ends[0]);
  Descriptor out(ends[1]);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) {
    throw InputError(what + ": cannot be read (" + std::strerror(errno) + ")");
  }
  if (child == 0) Child(parent, out, work, limits);
  out = Descriptor();
  std::string bytes;
  if (!ReadToEnd(in, limits.max_wait_seconds, &bytes)) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0 || bytes.empty()) {
    throw InputError(what + ": expected a file that can be read, found " +
                     Ending(status));
  }
  if (bytes.front() == kError) throw InputError(bytes.substr(1));
  return bytes.substr(1);
}

}  // namespace phongpd
