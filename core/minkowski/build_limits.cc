// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/build_limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/minkowski/build_observer.h"
#include "core/minkowski/build_stop.h"

namespace phongpd {
namespace {

// How often CancelBuilds was called.
std::atomic<unsigned> cancellations{0};
static_assert(std::atomic<unsigned>::is_always_lock_free,
              "a signal handler may call CancelBuilds");

std::atomic<BuildObserver> observer{nullptr};

}  // namespace

void CancelBuilds() { ++cancellations; }

CancelWatch::CancelWatch() : before_(cancellations.load()) {}

bool CancelWatch::IsCancelled() const {
  return cancellations.load(std::memory_order_relaxed) != before_;
}

void CancelWatch::Check(const char* what) const {
  if (IsCancelled()) throw BuildCancelled(std::string(what) + " was cancelled");
}

void ObserveBuilds(BuildObserver to_call) { observer = to_call; }

namespace internal {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
// Of what is free; the rest is for what a build leaves to its caller.
constexpr double kFreeShare = 0.9;
// Reading the resident set takes some ten microseconds, in which little grows.
constexpr double kMemoryEvery = 1e-3;  // seconds
// Reading the clock is no matter beside a few facets.
constexpr unsigned kCallsPerLook = 8;

// The first number of a file of one, or infinity.
double NumberIn(const char* path) {
  std::ifstream in(path);
  double number = kNone;
  return in >> number ? number : kNone;
}

ProcessMib Process() {
  std::ifstream in("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  in >> all >> resident;
  const double page = static_cast<double>(sysconf(_SC_PAGESIZE)) / kMib;
  return {all * page, resident * page};
}

// What the machine has left, and its control group.
double UnusedMib() {
  double unused = kNone;
  std::ifstream in("/proc/meminfo");
  std::string name, unit;
  for (double value = 0.0; in >> name >> value; std::getline(in, unit)) {
    if (name == "MemAvailable:") unused = value / 1024.0;
  }
  const double most = NumberIn("/sys/fs/cgroup/memory.max");
  const double used = NumberIn("/sys/fs/cgroup/memory.current");
  if (std::isfinite(most) && std::isfinite(used)) {
    unused = std::min(unused, (most - used) / kMib);
  }
  return unused;
}

// Address space that a process of this size may still take.
double AddressSpaceMib(double size) {
  rlimit limit;
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? static_cast<double>(limit.rlim_cur) / kMib - size
             : kNone;
}

}  // namespace

BuildLimits::BuildLimits(const ContactSpaceOptions& options)
    : operands_(options.robot_name + " and " + options.obstacle_name),
      max_seconds_(options.max_seconds > 0.0 ? options.max_seconds : kNone),
      is_automatic_(!(options.max_mib > 0.0)),
      first_(Process()),
      max_mib_(is_automatic_ ? -1.0 : options.max_mib),
      next_memory_(kMemoryEvery) {}

BuildLimits::BuildLimits(const BuildLimits& other)
    : operands_(other.operands_),
      max_seconds_(other.max_seconds_),
      is_automatic_(other.is_automatic_),
      first_(other.first_),
      stopwatch_(other.stopwatch_),
      predicted_(other.predicted_),
      is_cancellable_(other.is_cancellable_),
      cancellations_(other.cancellations_),
      calls_(other.calls_.load(std::memory_order_relaxed)),
      max_mib_(other.max_mib_.load(std::memory_order_relaxed)),
      next_memory_(other.next_memory_.load(std::memory_order_relaxed)) {}

void BuildLimits::LearnFrom(const BuildLimits& copy) const {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  calls_.store(copy.calls_.load(kRelaxed), kRelaxed);
  max_mib_.store(copy.max_mib_.load(kRelaxed), kRelaxed);
  next_memory_.store(copy.next_memory_.load(kRelaxed), kRelaxed);
}

double BuildLimits::max_mib() const {
  const double known = max_mib_.load(std::memory_order_relaxed);
  if (known >= 0.0) return known;
  // As it was in the beginning: threads have taken address space since.
  const double taken = std::max(0.0, Process().resident - first_.resident);
  const double free =
      std::min(UnusedMib() + taken, AddressSpaceMib(first_.all));
  const double found = kFreeShare * std::max(0.0, free);
  max_mib_.store(found, std::memory_order_relaxed);
  return found;
}

void BuildLimits::Predict(const PredictedCost& cost) {
  predicted_ = cost;
  const auto check = [this](const char* option, double limit, double predicted,
                            const char* unit) {
    if (predicted <= limit) return;
    std::ostringstream text;
    text << "expected a contact space of at most " << limit << ' ' << unit
         << " (" << option << "), predicted " << predicted << ' ' << unit;
    Refuse(text.str());
  };
  check("max_seconds", max_seconds_, cost.seconds, "s");
  // A prediction may be several times too high: no reason to refuse what
  // nobody has limited.
  if (!is_automatic_) check("max_mib", max_mib(), cost.mib, "MiB");
}

void BuildLimits::ObserveCancellation() {
  is_cancellable_ = true;
  cancellations_ = cancellations.load();
}

void BuildLimits::StopIfCancelled(const char* stage) const {
  if (is_cancellable_ &&
      cancellations.load(std::memory_order_relaxed) != cancellations_) {
    throw BuildCancelled(operands_ + ": the contact space was cancelled in " +
                         "its " + stage);
  }
}

void BuildLimits::Check(const char* stage) const {
  StopIfCancelled(stage);
  if (calls_.fetch_add(1, std::memory_order_relaxed) % kCallsPerLook == 0) {
    CheckNow(stage);
  }
}

void BuildLimits::CheckNow(const char* stage) const {
  StopIfCancelled(stage);
  const double seconds = stopwatch_.Seconds();
  const BuildObserver tell = observer.load(std::memory_order_relaxed);
  if (tell != nullptr) tell({stage, seconds, predicted_.seconds});
  if (seconds > max_seconds_) {
    std::ostringstream text;
    text << "expected a contact space within " << max_seconds_
         << " s (max_seconds), stopped after " << seconds << " s";
    RefuseIn(stage, text.str());
  }
  if (seconds < next_memory_.load(std::memory_order_relaxed)) return;
  next_memory_.store(seconds + kMemoryEvery, std::memory_order_relaxed);
  const double mib = Process().resident - first_.resident;
  if (mib <= max_mib()) return;
  std::ostringstream text;
  text << "expected a contact space of at most " << max_mib() << " MiB ("
       << (is_automatic_ ? "nine tenths of the memory that was free"
                         : "max_mib")
       << "), stopped at " << mib << " MiB";
  RefuseIn(stage, text.str());
}

void BuildLimits::RefuseIn(const char* stage, const std::string& what) const {
  std::ostringstream text;
  text << what << " in its " << stage;
  if (predicted_.seconds > 0.0) {
    text << " (predicted: " << predicted_.seconds << " s and " << predicted_.mib
         << " MiB)";
  }
  Refuse(text.str());
}

void BuildLimits::Refuse(const std::string& what) const {
  throw BuildRefusal(
      operands_ + ": " + what +
      "; simplify an operand (robot_hull, target_faces) or raise "
      "the limit");
}

}  // namespace internal
}  // namespace phongpd
