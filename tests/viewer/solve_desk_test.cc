// SPDX-License-Identifier: GPL-3.0-or-later
// Who is answered by the desk behind `view --serve`, and how a question ends.
#include "problems/cli/solve_desk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/mesh/mesh_error.h"

namespace phongpd::cli {
namespace {

constexpr double kPatience = 60.0;  // seconds

// Until it is so; what never is times the test out.
template <typename Is>
void Await(const Is& is) {
  while (!is()) std::this_thread::yield();
}

TEST(SolveDesk, TellsAnswersRefusalsAndFaultsApart) {
  SolveDesk desk(
      [](const std::string& question, const auto&) -> std::string {
        if (question == "bad")
          throw InputError("question: expected\na good one");
        if (question == "fault") throw std::runtime_error("broken");
        return "{\"is\": \"" + question + "\"}";
      },
      [] {}, kPatience);
  EXPECT_EQ(desk.Ask("good").status, 200);
  EXPECT_EQ(desk.Ask("good").json, "{\"is\": \"good\"}");
  const ServedAnswer bad = desk.Ask("bad");
  EXPECT_EQ(bad.status, 400);
  EXPECT_EQ(bad.json.find('\n'), std::string::npos) << bad.json;
  EXPECT_EQ(desk.Ask("fault").status, 500);
}

TEST(SolveDesk, CancelEndsTheQuestionThatIsAnsweredAndNoOther) {
  std::atomic<bool> has_begun{false}, is_stopped{false};
  std::atomic<int> stops{0};
  SolveDesk desk(
      [&](const std::string& question, const auto& is_cancelled) {
        if (question == "quick") return std::string("{}");
        has_begun = true;
        Await([&] { return is_cancelled(); });
        // Whatever does not ask is stopped from outside, more than once.
        Await([&] { return stops >= 3; });
        is_stopped = true;
        return std::string("{}");
      },
      [&] { ++stops; }, kPatience);
  EXPECT_NE(desk.Cancel().json.find("false"), std::string::npos)
      << "there is nothing to cancel";
  EXPECT_EQ(stops, 0);
  auto slow = std::async(std::launch::async, [&] { return desk.Ask("slow"); });
  Await([&] { return has_begun.load(); });
  EXPECT_EQ(desk.Ask("quick").status, 503) << "one at a time";
  const ServedAnswer cancelled = desk.Cancel();
  EXPECT_EQ(cancelled.status, 200);
  EXPECT_NE(cancelled.json.find("true"), std::string::npos);
  const ServedAnswer answer = slow.get();
  EXPECT_EQ(answer.status, 409);
  EXPECT_NE(answer.json.find("cancelled"), std::string::npos);
  EXPECT_TRUE(is_stopped);
  const int before = stops;
  EXPECT_EQ(desk.Ask("quick").status, 200) << "the next is not touched";
  EXPECT_EQ(stops, before);
}

TEST(SolveDesk, WhatIsTooSlowIsCancelled) {
  std::atomic<bool> is_told{false};
  SolveDesk desk(
      [&](const std::string& question, const auto& is_cancelled) {
        if (question == "slow") {
          Await([&] { return is_cancelled(); });
          is_told = true;
        }
        return std::string("{}");
      },
      [] {}, 0.02);
  EXPECT_EQ(desk.Ask("slow").status, 504);
  Await([&] { return is_told.load(); });
  Await([&] { return desk.Ask("quick").status == 200; });
}

// Nobody presses Cancel: whoever is told so was cancelled in another's place,
// whose answer came just as its limit passed.
TEST(SolveDesk, WhatIsTooSlowCancelsNoOther) {
  using Clock = std::chrono::steady_clock;
  constexpr double kLimit = 0.0005;  // seconds; each question takes about that
  constexpr int kAskers = 3, kQuestions = 2000;
  constexpr std::chrono::microseconds kPause(20);
  SolveDesk desk(
      [&](const std::string&, const auto& is_cancelled) {
        const auto end = Clock::now() + std::chrono::duration<double>(kLimit);
        while (Clock::now() < end && !is_cancelled()) std::this_thread::yield();
        return std::string("{}");
      },
      [] {}, kLimit);
  std::atomic<int> left{kQuestions}, cancelled{0}, answered{0};
  const auto ask = [&] {
    while (left > 0) {
      const int status = desk.Ask("x").status;
      if (status == 503) {
        std::this_thread::sleep_for(kPause);
        continue;
      }
      --left;
      cancelled += status == 409 ? 1 : 0;
      answered += status == 200 ? 1 : 0;
    }
  };
  std::vector<std::thread> askers;
  for (int i = 0; i < kAskers; ++i) askers.emplace_back(ask);
  for (std::thread& asker : askers) asker.join();
  EXPECT_EQ(cancelled, 0);
  EXPECT_GT(answered, 0);
}

TEST(SolveDesk, GoesAwayWhileAQuestionIsAnswered) {
  std::promise<void> begun;
  auto desk = std::make_unique<SolveDesk>(
      [&](const std::string&, const auto& is_cancelled) {
        begun.set_value();
        Await([&] { return is_cancelled(); });
        return std::string("{}");
      },
      [] {}, kPatience);
  SolveDesk* const asked = desk.get();
  auto slow = std::async(std::launch::async, [&] { return asked->Ask("x"); });
  begun.get_future().wait();
  asked->Cancel();
  EXPECT_EQ(slow.get().status, 409);
  desk.reset();
}

}  // namespace
}  // namespace phongpd::cli
