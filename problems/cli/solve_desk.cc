// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/solve_desk.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "problems/output/json_text.h"

namespace phongpd::cli {
namespace {

ServedAnswer Failed(int status, const std::string& why) {
  return {status, JsonText({{"error", OneLine(why)}})};
}

}  // namespace

struct SolveDesk::Impl {
  struct Task {
    std::string question;
    std::promise<ServedAnswer> answer;
  };

  Impl(std::function<std::string(const std::string&)> by, double limit)
      : solve(std::move(by)), seconds(limit), worker([this] { Work(); }) {}

  ServedAnswer Solve(const std::string& question) const {
    try {
      return {200, solve(question)};
    } catch (const InputError& error) {
      return Failed(400, error.what());
    } catch (const std::bad_alloc&) {
      return Failed(500, "out of memory");
    } catch (const std::exception& error) {
      return Failed(500, std::string("internal error: ") + error.what());
    }
  }

  void Work() {
    for (;;) {
      Task now;
      {
        std::unique_lock<std::mutex> lock(mutex);
        wake.wait(lock, [this] { return task.has_value() || is_over; });
        if (!task) return;
        now = std::move(*task);
        task.reset();
      }
      ServedAnswer answer = Solve(now.question);
      {
        // Whoever has the answer may ask the next.
        const std::lock_guard<std::mutex> lock(mutex);
        is_busy = false;
      }
      now.answer.set_value(std::move(answer));
    }
  }

  std::function<std::string(const std::string&)> solve;
  double seconds;
  std::mutex mutex;
  std::condition_variable wake;
  std::optional<Task> task;  // that the worker has not taken yet
  bool is_busy = false;      // a task waits or is worked at
  bool is_over = false;
  std::thread worker;  // the last member: it uses the others
};

SolveDesk::SolveDesk(std::function<std::string(const std::string&)> solve,
                     double seconds)
    : impl_(std::make_unique<Impl>(std::move(solve), seconds)) {}

SolveDesk::~SolveDesk() {
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->is_over = true;
  }
  impl_->wake.notify_all();
  impl_->worker.join();
}

ServedAnswer SolveDesk::Ask(const std::string& question) {
  std::future<ServedAnswer> answer;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    if (impl_->is_busy) {
      return Failed(503, "another question is being answered; ask again soon");
    }
    impl_->is_busy = true;
    impl_->task.emplace();
    impl_->task->question = question;
    answer = impl_->task->answer.get_future();
  }
  impl_->wake.notify_all();
  const std::chrono::duration<double> limit(impl_->seconds);
  if (answer.wait_for(limit) == std::future_status::ready) return answer.get();
  return Failed(504, "expected an answer within " +
                         FormatDouble(impl_->seconds) +
                         " s, found none yet; ask again later, or begin with a "
                         "longer --time");
}

}  // namespace phongpd::cli
