// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>

// What must not outlive the program when a signal ends it.
namespace phongpd::internal {

// From now on SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXCPU and SIGABRT (GMP, for
// one, aborts when memory is short) first remove what RemovedOnSignal names,
// then end the process as they always do (a shell sees 128 + the signal's
// number).  Signals that are ignored stay so.
void RemoveFilesOnSignals();

// Removes it now, for a process that is about to end in another way.
void RemoveFilesNow();

// While this lives, the file `name` in the open folder is removed by those
// signals; with `folder` AT_FDCWD, the empty directory `name`, after all files
// and the newest first.  To be made before the file is.
class RemovedOnSignal {
 public:
  RemovedOnSignal() = default;
  RemovedOnSignal(int folder, std::string name);
  ~RemovedOnSignal() { Forget(); }
  RemovedOnSignal(RemovedOnSignal&& other) noexcept;
  RemovedOnSignal& operator=(RemovedOnSignal&& other) noexcept;

  // The file is there now: removes it if a signal is just ending the process.
  void Confirm() const;
  void Forget();

 private:
  struct Entry;
  friend void RemoveFilesNow();
  static std::atomic<Entry*> newest_;
  Entry* entry_ = nullptr;
};

// While this lives those signals wait, so that a change of several files is
// either done or not begun.  One at a time: others wait, and none within
// another.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
};

// While this lives the first Ctrl-C (SIGINT) asks for the best answer so far
// instead of ending the process, as the next one does.  One at a time.
class InterruptAsks {
 public:
  InterruptAsks();
  ~InterruptAsks();
  InterruptAsks(const InterruptAsks&) = delete;
  InterruptAsks& operator=(const InterruptAsks&) = delete;

  bool HasAsked() const;
};

}  // namespace phongpd::internal
