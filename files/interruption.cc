// SPDX-License-Identifier: GPL-3.0-or-later
#include "files/interruption.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <utility>

namespace phongpd::internal {

// Entries are reused but never freed: a handler may walk the list at any time.
struct RemovedOnSignal::Entry {
  enum State { kFree, kBeingChanged, kArmed };
  std::atomic<int> state{kBeingChanged};
  bool is_directory = false;  // such entries are not reused: order counts
  int folder = -1;
  std::string name;
  Entry* next = nullptr;
};

namespace {

constexpr int kSignals[] = {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXCPU, SIGABRT};

enum Phase { kRunning, kSignalsWait, kDying };
std::atomic<int> phase{kRunning};
std::atomic<int> waiting_signal{0};

enum Question { kNobodyAnswers, kMayAsk, kHasAsked };
std::atomic<int> question{kNobodyAnswers};

static_assert(std::atomic<int>::is_always_lock_free);

std::mutex one_waits;

}  // namespace

std::atomic<RemovedOnSignal::Entry*> RemovedOnSignal::newest_{nullptr};

// All calls are async-signal-safe.
void RemoveFilesNow() {
  using Entry = RemovedOnSignal::Entry;
  for (const bool directories : {false, true}) {
    for (Entry* entry = RemovedOnSignal::newest_.load(); entry != nullptr;
         entry = entry->next) {
      int armed = Entry::kArmed;
      // What is being changed elsewhere is no file yet, or none any more.
      if (!entry->state.compare_exchange_strong(armed, Entry::kBeingChanged)) {
        continue;
      }
      if (entry->is_directory == directories) {
        unlinkat(entry->folder, entry->name.c_str(),
                 directories ? AT_REMOVEDIR : 0);
      } else {
        entry->state.store(Entry::kArmed);
      }
    }
  }
}

namespace {

// The signal is blocked in its own handler, and kills when that is left.
void Die(int signal) {
  RemoveFilesNow();
  struct sigaction ends = {};
  ends.sa_handler = SIG_DFL;
  sigaction(signal, &ends, nullptr);
  raise(signal);
}

extern "C" void OnSignal(int signal) {
  const int error = errno;
  int may_ask = kMayAsk;
  if (signal == SIGINT &&
      question.compare_exchange_strong(may_ask, kHasAsked)) {
    return;
  }
  int running = kRunning;
  if (phase.compare_exchange_strong(running, kDying)) {
    Die(signal);
  } else if (running == kSignalsWait) {
    waiting_signal.store(signal);
  }
  errno = error;
}

// Another thread is about to end the process.
[[noreturn]] void AwaitEnd() {
  for (;;) pause();
}

}  // namespace

void RemoveFilesOnSignals() {
  for (const int signal : kSignals) {
    struct sigaction action = {};
    if (sigaction(signal, nullptr, &action) != 0 ||
        action.sa_handler == SIG_IGN) {
      continue;  // nohup, or a shell's background job
    }
    action.sa_handler = OnSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int other : kSignals) sigaddset(&action.sa_mask, other);
    sigaction(signal, &action, nullptr);
  }
}

RemovedOnSignal::RemovedOnSignal(int folder, std::string name) {
  const bool is_directory = folder == AT_FDCWD;
  for (Entry* entry = newest_.load(); entry != nullptr && !is_directory;
       entry = entry->next) {
    int free = Entry::kFree;
    if (entry->state.compare_exchange_strong(free, Entry::kBeingChanged)) {
      entry_ = entry;
      break;
    }
  }
  const bool is_new = entry_ == nullptr;
  if (is_new) entry_ = new Entry;
  entry_->is_directory = is_directory;
  entry_->folder = folder;
  entry_->name = std::move(name);
  if (is_new) {
    entry_->next = newest_.load();
    while (!newest_.compare_exchange_weak(entry_->next, entry_)) {
    }
  }
  entry_->state.store(Entry::kArmed);
}

void RemovedOnSignal::Confirm() const {
  if (phase.load() != kDying) return;
  unlinkat(entry_->folder, entry_->name.c_str(),
           entry_->is_directory ? AT_REMOVEDIR : 0);
  AwaitEnd();
}

RemovedOnSignal::RemovedOnSignal(RemovedOnSignal&& other) noexcept
    : entry_(std::exchange(other.entry_, nullptr)) {}

RemovedOnSignal& RemovedOnSignal::operator=(RemovedOnSignal&& other) noexcept {
  if (this != &other) {
    Forget();
    entry_ = std::exchange(other.entry_, nullptr);
  }
  return *this;
}

void RemovedOnSignal::Forget() {
  if (entry_ == nullptr) return;
  int armed = Entry::kArmed;
  entry_->state.compare_exchange_strong(
      armed, entry_->is_directory ? Entry::kBeingChanged : Entry::kFree);
  entry_ = nullptr;
}

SignalsWait::SignalsWait() {
  one_waits.lock();
  int running = kRunning;
  if (!phase.compare_exchange_strong(running, kSignalsWait)) AwaitEnd();
}

SignalsWait::~SignalsWait() {
  phase.store(kRunning);
  const int signal = waiting_signal.exchange(0);
  one_waits.unlock();
  if (signal != 0) raise(signal);
}

InterruptAsks::InterruptAsks() { question.store(kMayAsk); }

InterruptAsks::~InterruptAsks() { question.store(kNobodyAnswers); }

bool InterruptAsks::HasAsked() const { return question.load() == kHasAsked; }

}  // namespace phongpd::internal
