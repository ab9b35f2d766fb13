// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "core/contact/contact_space_cache.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/answer_check.h"
#include "problems/studies/clearance_wish.h"
#include "problems/studies/trajectory_study.h"

namespace phongpd::python {

using Point = std::array<double, 3>;

inline Eigen::Vector3d ToVector(const Point& p) { return {p[0], p[1], p[2]}; }

// Keeps contact spaces in the user's cache folder, or nowhere.
ContactSpaceCache FolderOf(bool cache);

// What a motion in time is to do, as Python tells it: lengths are texts.
struct MotionWishes {
  std::array<Point, 3> limits;  // of velocity, acceleration and jerk
  std::vector<std::tuple<Point, std::string, double>> via;  // tolerance, dwell
  double duration;
  std::string margin;
  std::string preset;
  double max_seconds;
  bool is_required;
};

// A world and what has been prepared in it for one kind of question or the
// other.  Ipopt runs once at a time in a process, and preparing is no question
// for two threads at once: one mutex for all.
class Workshop {
 public:
  Workshop(const Scene& scene, bool cache, double max_mib);

  const World& world() const { return world_; }
  const Scene& scene() const { return scene_; }
  // All obstacles' contact spaces, built when first asked for: Ctrl-C stops
  // that.  Called with Python's lock.
  const WorldSpaces& Spaces() const;

  // A row as `phongpd optimize` writes it, judged.  Empty texts and 0: the
  // scene's own.  Ctrl-C stops what is built for it, as in Plan.
  std::string Optimize(const Point& start, const Point& goal,
                       const std::string& metric, const std::string& margin,
                       int waypoints, std::uint64_t seed, double max_seconds,
                       bool is_straight, const std::string& preset,
                       const std::string& model, bool is_required);

  // A row as `phongpd optimize --limits` writes it, judged.
  std::string OptimizeInTime(const Point& start, const Point& goal,
                             const std::string& model,
                             const MotionWishes& wishes);
  // As `phongpd retime` writes it.
  std::string Retime(const std::vector<Point>& path,
                     const MotionWishes& wishes);

  // A row as `phongpd plan` writes it, judged.
  std::string Plan(const Point& start, const Point& goal,
                   const std::string& planner, const std::string& retraction,
                   const std::string& clearance, double max_seconds,
                   std::uint64_t seed, const std::string& preset,
                   const std::string& model, bool is_required);

 private:
  Scene Between(const Point& start, const Point& goal) const;
  // Asks for a motion of that scene, and writes the row of the answer.
  template <typename Ask>
  std::string InTime(Scene scene, const MotionWishes& wishes,
                     const std::atomic<bool>& is_asked, const Ask& ask);
  std::string Judged(const Scene& scene, const AnswerClaims& claims,
                     const ClearanceWish& wish,
                     nlohmann::ordered_json* row) const;

  Scene scene_;
  ContactSpaceCache cache_;
  World world_;
  TrajectoryStudy trajectories_;
  std::mutex one_at_a_time_;
  mutable std::atomic<bool> is_built_{false};  // Spaces()
};

}  // namespace phongpd::python
