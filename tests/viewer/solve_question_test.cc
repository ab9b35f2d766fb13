// SPDX-License-Identifier: GPL-3.0-or-later
// What the page may ask, by the kind of its scene, and who may reach which
// route.
#include "problems/cli/solve_question.h"

#include <gtest/gtest.h>

#include <string>

#include "core/mesh/mesh_error.h"
#include "problems/cli/serve_guard.h"

namespace phongpd::cli {
namespace {

QuestionScope Scope(TaskKind kind) {
  QuestionScope scope;
  scope.kind = kind;
  scope.room = {{-1, -1, -1}, {1, 1, 1}};
  if (kind == TaskKind::kRobots) scope.robots = {"left", "right"};
  return scope;
}

std::string WhyNot(const std::string& text, TaskKind kind) {
  try {
    ReadQuestion(text, Scope(kind));
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(SolveQuestion, OfARobotThatTurnsHasTurnsAtItsEnds) {
  const SolveQuestion question = ReadQuestion(
      R"({"what": "plan", "start": [1, 2, 3], "start_turn": [0.6, 0, 0.8, 0],
          "goal": [4, 5, 6], "options": {"seed": 7}})",
      Scope(TaskKind::kTurns));
  EXPECT_EQ(question.start.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(question.start.orientation.w(), 0.6);
  EXPECT_EQ(question.start.orientation.y(), 0.8);
  EXPECT_EQ(question.goal.orientation.w(), 1.0);
  EXPECT_EQ(question.Seed(), 7u);
  EXPECT_FALSE(question.GivenPreset());
}

TEST(SolveQuestion, OfSeveralRobotsMovesThoseThatItNames) {
  const SolveQuestion question = ReadQuestion(
      R"({"what": "optimize", "robots": [
          {"id": "right", "start": [1, 0, 0], "goal": [0, 1, 0]}],
          "options": {"preset": "tight"}})",
      Scope(TaskKind::kRobots));
  ASSERT_EQ(question.robots.size(), 1u);
  EXPECT_EQ(question.robots[0].index, 1u);
  EXPECT_EQ(question.robots[0].goal, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(question.GivenPreset(), Preset::kTight);
  EXPECT_EQ(ReadQuestion(R"({"what": "depth", "robot": "right",
                             "start": [0, 0, 0]})",
                         Scope(TaskKind::kRobots))
                .robot,
            1u);
}

TEST(SolveQuestion, RefusesWhatItsKindDoesNotHave) {
  constexpr auto kOne = TaskKind::kTranslates, kTurns = TaskKind::kTurns,
                 kRobots = TaskKind::kRobots;
  const struct {
    TaskKind kind;
    const char* text;
    const char* names;
  } cases[] = {
      {kOne, R"({"what": "depth", "start": [0, 0, 0],
                 "start_turn": [1, 0, 0, 0]})",
       "start_turn"},
      {kOne, R"({"what": "optimize", "robots": []})", "robots"},
      {kTurns, R"({"what": "plan", "start": [0, 0, 0]})", "/goal"},
      {kTurns, R"({"what": "depth", "start": [0, 0, 0],
                   "goal_turn": [1, 0, 0, 0]})",
       "/goal_turn"},
      {kTurns, R"({"what": "plan", "start": [0, 0, 0], "goal": [0, 0, 0],
                   "start_turn": [1, 0, 0, 1]})",
       "/start_turn"},
      {kTurns, R"({"what": "plan", "start": [0, 0, 0], "goal": [0, 0, 0],
                   "start_turn": [1, 0, 0]})",
       "/start_turn"},
      {kTurns, R"({"what": "plan", "start": [0, 0, 0], "goal": [0, 0, 0],
                   "options": {"planner": "rrt-connect"}})",
       "/options/planner: expected none of plan of a robot that turns"},
      {kTurns, R"({"what": "optimize", "start": [0, 0, 0], "goal": [0, 0, 0],
                   "options": {"preset": "fast"}})",
       "/options/preset"},
      {kTurns, R"({"what": "plan", "start": [0, 0, 1e9], "goal": [0, 0, 0]})",
       "/start: expected a position within a million D"},
      {kRobots, R"({"what": "plan", "robots": []})", "/what"},
      {kRobots, R"({"what": "optimize"})", "/robots"},
      {kRobots, R"({"what": "optimize", "robots": [], "start": [0, 0, 0]})",
       "/start"},
      {kRobots, R"({"what": "depth", "start": [0, 0, 0]})", "/robot"},
      {kRobots, R"({"what": "depth", "start": [0, 0, 0], "robot": "up"})",
       "/robot"},
      {kRobots, R"({"what": "optimize", "robots": [
          {"id": "left", "start": [0, 0, 0], "goal": [0, 0, 0]},
          {"id": "left", "start": [0, 0, 0], "goal": [0, 0, 0]}]})",
       "/robots/1/id: expected each robot once"},
      {kRobots, R"({"what": "optimize", "robots": [
          {"id": "left", "start": [0, 0, 0]}]})",
       "goal"},
      {kRobots, R"({"what": "optimize", "robots": [],
                    "options": {"metric": "phong"}})",
       "/options/metric"}};
  for (const auto& one : cases) {
    const std::string why = WhyNot(one.text, one.kind);
    EXPECT_NE(why.find(one.names), std::string::npos)
        << one.text << ": " << why;
  }
}

TEST(SolveQuestion, EndsWhenItIsCancelledOrTimeIsUp) {
  bool is_cancelled = false;
  const auto later = EndOf(1e6, [&] { return is_cancelled; });
  EXPECT_FALSE(later());
  is_cancelled = true;
  EXPECT_TRUE(later());
  const auto now = EndOf(-1.0, [] { return false; });
  EXPECT_TRUE(now());
}

// A request that passes but for what a case changes.
RequestHead Head(const std::string& method, const std::string& path) {
  RequestHead head;
  head.method = method;
  head.path = path;
  head.hosts = {"127.0.0.1:8000"};
  head.content_types = {"application/json"};
  head.lengths = {"2"};
  return head;
}

TEST(ServeGuard, CancelIsAskedForAsSolveIs) {
  const ServeRules rules = {"0123456789abcdef", 8000, 65536};
  const auto status = [&](const RequestHead& head) {
    return CheckRequest(head, rules).status;
  };
  for (const std::string route : {"solve", "cancel"}) {
    const std::string path = "/0123456789abcdef/" + route;
    EXPECT_EQ(status(Head("POST", path)), 0) << route;
    EXPECT_EQ(status(Head("GET", path)), 405) << route;
    EXPECT_EQ(status(Head("POST", path + "/")), 404) << route;
    EXPECT_EQ(status(Head("POST", "/" + route)), 403) << route;
    EXPECT_EQ(status(Head("POST", "/0123456789abcdee/" + route)), 403) << route;
    RequestHead head = Head("POST", path);
    head.origins = {"http://evil.example"};
    EXPECT_EQ(status(head), 403) << route;
    head = Head("POST", path);
    head.content_types = {"text/plain"};
    EXPECT_EQ(status(head), 415) << route;
    head = Head("POST", path);
    head.hosts = {"evil.example:8000"};
    EXPECT_EQ(status(head), 421) << route;
  }
}

}  // namespace
}  // namespace phongpd::cli
