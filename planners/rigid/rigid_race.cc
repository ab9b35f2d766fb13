// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_race.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "planners/rigid/rigid_portfolio.h"

namespace phongpd::internal {
namespace {

// Between two looks at the stop by a caller who waits.
constexpr std::chrono::milliseconds kPatience(5);

// The best finish so far: the least work, and of equal ones the lowest lane.
class BestFinish {
 public:
  static constexpr int kLaneBits = 6;

  // One of these is before another if its number is less.
  static std::uint64_t Finish(long work, int lane) {
    return (static_cast<std::uint64_t>(work) << kLaneBits) |
           static_cast<std::uint64_t>(lane);
  }

  void Tell(std::uint64_t finish) {
    std::uint64_t best = best_.load(std::memory_order_relaxed);
    while (finish < best && !best_.compare_exchange_weak(best, finish)) {
    }
  }

  bool IsBefore(std::uint64_t finish) const {
    return best_.load(std::memory_order_relaxed) < finish;
  }

  bool HasAny() const { return best_.load() != kNone; }
  std::size_t Lane() const {
    return static_cast<std::size_t>(best_.load() & ((1U << kLaneBits) - 1U));
  }

 private:
  static constexpr std::uint64_t kNone =
      std::numeric_limits<std::uint64_t>::max();

  std::atomic<std::uint64_t> best_{kNone};
};

// What a lane leaves; written by its thread.
struct Lane {
  RaceEnd end;
  std::exception_ptr error;
};

class PortfolioRace {
 public:
  PortfolioRace(const RigidModel& model, const TreeTask& task,
                std::uint64_t seed, int lanes, RigidStop* stop)
      : model_(model),
        task_(task),
        seed_(seed),
        stop_(stop),
        lanes_(static_cast<std::size_t>(lanes)) {}

  RaceEnd Run() {
    RunThreads();
    for (const Lane& lane : lanes_) {
      if (lane.error) std::rethrow_exception(lane.error);
    }
    if (best_.HasAny()) return std::move(lanes_[best_.Lane()].end);
    RaceEnd all;
    for (const Lane& lane : lanes_) {
      all.checks += lane.end.checks;
      all.tests += lane.end.tests;
      all.nodes += lane.end.nodes;
    }
    return all;
  }

 private:
  // Joins, whatever is thrown meanwhile.
  struct Threads {
    explicit Threads(std::atomic<bool>* is_over_) : is_over(is_over_) {}
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;
    ~Threads() {
      *is_over = true;
      for (std::thread& one : all) one.join();
    }

    std::atomic<bool>* is_over;
    std::vector<std::thread> all;
  };

  void RunThreads() {
    Threads threads(&is_over_);
    threads.all.reserve(lanes_.size());
    for (std::size_t lane = 1; lane < lanes_.size(); ++lane) {
      threads.all.emplace_back([this, lane] {
        Run(lane);
        const std::lock_guard<std::mutex> lock(mutex_);
        ++ended_;
        has_ended_.notify_one();
      });
    }
    Run(0);
    Wait();
  }

  // Until all others have ended.
  void Wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto have_all_ended = [this] { return ended_ + 1 == lanes_.size(); };
    while (!has_ended_.wait_for(lock, kPatience, have_all_ended)) {
      lock.unlock();
      if (stop_->Asks()) is_over_ = true;
      lock.lock();
    }
  }

  void Run(std::size_t lane) noexcept {
    try {
      Race(static_cast<int>(lane), &lanes_[lane].end);
    } catch (...) {
      lanes_[lane].error = std::current_exception();
      is_over_ = true;
    }
  }

  void Race(int lane, RaceEnd* end) {
    const RigidPortfolio* self = nullptr;
    // The work may have been passed within a round, too.
    RigidStop stop(std::numeric_limits<double>::infinity(), [&] {
      if (lane == 0 && stop_->Asks()) is_over_ = true;
      return is_over_.load(std::memory_order_relaxed) ||
             best_.IsBefore(BestFinish::Finish(self->work(), lane));
    });
    end->seed = LaneSeed(seed_, lane);
    RigidPortfolio portfolio(model_, task_, end->seed, &stop);
    self = &portfolio;
    if (portfolio.Search(&stop)) {
      end->path = portfolio.path();
      end->planner = portfolio.planner();
      best_.Tell(BestFinish::Finish(portfolio.work(), lane));
    }
    end->checks = portfolio.checks();
    end->tests = portfolio.tests();
    end->nodes = portfolio.nodes();
  }

  const RigidModel& model_;
  const TreeTask& task_;
  const std::uint64_t seed_;
  RigidStop* stop_;  // the caller's
  BestFinish best_;
  std::atomic<bool> is_over_{false};
  std::vector<Lane> lanes_;
  std::mutex mutex_;
  std::condition_variable has_ended_;
  std::size_t ended_ = 0;  // threads, by the mutex
};

}  // namespace

// Sebastiano Vigna's SplitMix64 (public domain).
std::uint64_t LaneSeed(std::uint64_t seed, int lane) {
  if (lane == 0) return seed;
  std::uint64_t z =
      seed + static_cast<std::uint64_t>(lane) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

RaceEnd RacePortfolios(const RigidModel& model, const TreeTask& task,
                       std::uint64_t seed, int lanes, RigidStop* stop) {
  return PortfolioRace(model, task, seed, lanes, stop).Run();
}

}  // namespace phongpd::internal
