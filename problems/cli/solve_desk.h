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
//   500  no memory, or a fault of the program
//   503  another question is being answered
//   504  the limit has passed; until the worker is done, others get 503
class SolveDesk {
 public:
  // `solve` makes JSON of a question, on the worker's thread.
  SolveDesk(std::function<std::string(const std::string&)> solve,
            double seconds);
  ~SolveDesk();  // waits for the worker
  SolveDesk(const SolveDesk&) = delete;
  SolveDesk& operator=(const SolveDesk&) = delete;

  // By any thread.
  ServedAnswer Ask(const std::string& question);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::cli
