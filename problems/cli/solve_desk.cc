// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/solve_desk.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
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

constexpr std::chrono::milliseconds kAgain(20);

ServedAnswer Failed(int status, const std::string& why) {
  return {status, JsonText({{"error", OneLine(why)}})};
}

}  // namespace

struct SolveDesk::Impl {
  struct Task {
    std::string question;
    std::promise<ServedAnswer> answer;
  };

  Impl(Solve by, std::function<void()> stop_by, double limit)
      : solve(std::move(by)),
        stop(std::move(stop_by)),
        seconds(limit),
        worker([this] { Work(); }),
        stopper([this] { StopCancelled(); }) {}

  ServedAnswer Solved(const std::string& question) const {
    try {
      return {200, solve(question, [this] { return is_cancelled.load(); })};
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
      ServedAnswer answer = Solved(now.question);
      {
        // Whoever has the answer may ask the next.
        const std::lock_guard<std::mutex> lock(mutex);
        if (is_cancelled) answer = Failed(409, "cancelled");
        is_busy = is_cancelled = false;
      }
      now.answer.set_value(std::move(answer));
    }
  }

  // What is to be stopped may only be about to begin: hence again and again.
  void StopCancelled() {
    std::unique_lock<std::mutex> lock(mutex);
    while (!is_over || is_cancelled) {
      wake.wait(lock, [this] { return is_over || is_cancelled; });
      if (!is_cancelled) continue;
      stop();
      wake.wait_for(lock, kAgain, [this] { return !is_cancelled; });
    }
  }

  // With the mutex held.
  void CancelTask() {
    if (is_busy) is_cancelled = true;
  }

  // False if that question is over: the next one is somebody else's.
  bool CancelQuestion(std::uint64_t number) {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!is_busy || number != taken) return false;
      CancelTask();
    }
    wake.notify_all();
    return true;
  }

  Solve solve;
  std::function<void()> stop;
  double seconds;
  std::mutex mutex;
  std::condition_variable wake;
  std::optional<Task> task;               // that the worker has not taken yet
  std::uint64_t taken = 0;                // how many tasks there were
  bool is_busy = false;                   // the last one waits, or is worked at
  std::atomic<bool> is_cancelled{false};  // that one
  bool is_over = false;
  std::thread worker, stopper;  // the last members: they use the others
};

SolveDesk::SolveDesk(Solve solve, std::function<void()> stop, double seconds)
    : impl_(
          std::make_unique<Impl>(std::move(solve), std::move(stop), seconds)) {}

SolveDesk::~SolveDesk() {
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->is_over = true;
    impl_->CancelTask();
  }
  impl_->wake.notify_all();
  impl_->worker.join();
  impl_->stopper.join();
}

ServedAnswer SolveDesk::Ask(const std::string& question) {
  std::future<ServedAnswer> answer;
  std::uint64_t number = 0;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    if (impl_->is_busy) {
      return Failed(503, "another question is being answered; ask again soon");
    }
    impl_->is_busy = true;
    number = ++impl_->taken;
    impl_->task.emplace();
    impl_->task->question = question;
    answer = impl_->task->answer.get_future();
  }
  impl_->wake.notify_all();
  const std::chrono::duration<double> limit(impl_->seconds);
  // What has come while the limit passed is an answer, too.
  if (answer.wait_for(limit) == std::future_status::ready ||
      !impl_->CancelQuestion(number)) {
    return answer.get();
  }
  return Failed(504, "expected an answer within " +
                         FormatDouble(impl_->seconds) +
                         " s, found none yet; ask again later, or begin with a "
                         "longer --time");
}

ServedAnswer SolveDesk::Cancel() {
  bool is_cancelled = false;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->CancelTask();
    is_cancelled = impl_->is_cancelled;
  }
  impl_->wake.notify_all();
  return {200, JsonText({{"cancelled", is_cancelled}})};
}

}  // namespace phongpd::cli
