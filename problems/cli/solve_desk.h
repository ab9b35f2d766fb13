// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "problems/cli/loopback_server.h"

namespace phongpd::cli {

// Gives questions to one worker, one at a time, and waits for no answer longer
// than a limit.  Statuses, as HTTP has them:
//   200  the answer
//   400  the question, or what it asks for, is refused (InputError)
//   409  Cancel has ended it
//   500  no memory, or a fault of the program
//   503  another question is being answered
//   504  the limit has passed; it alone is cancelled, and until the worker has
//        noticed, others get 503
class SolveDesk {
 public:
  // Makes JSON of a question, on the worker's thread; ends early, with anything
  // or nothing, once it is told that it is cancelled.
  using Solve = std::function<std::string(
      const std::string& question, const std::function<bool()>& is_cancelled)>;

  // `stop` ends what `solve` is at and does not ask: called again and again
  // until a question that is cancelled is over.
  SolveDesk(Solve solve, std::function<void()> stop, double seconds);
  ~SolveDesk();  // cancels, and waits for the worker
  SolveDesk(const SolveDesk&) = delete;
  SolveDesk& operator=(const SolveDesk&) = delete;

  // By any thread.
  ServedAnswer Ask(const std::string& question);
  // {"cancelled": true}; false if there was nothing to cancel.  By any thread.
  ServedAnswer Cancel();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::cli
