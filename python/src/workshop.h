// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/contact/contact_space_cache.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/scenes/scene.h"
#include "python/src/curve_arrays.h"

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
  int routes;    // 0: the preset's
  bool by_norm;  // are the limits
  // Velocity and acceleration at the beginning and at the end.
  std::array<Point, 2> departure, arrival;
};

// An obstacle that moves: its name, its solid, and the pieces of its motion.
using Moving = std::tuple<std::string, Solid, Seconds, Rows3>;

// Joined by moving them by `moved` at most.  Throws InputError that names the
// obstacle.
std::vector<MovingObstacle> MovingObstaclesOf(const std::vector<Moving>& moving,
                                              double* moved);

// They become the request's, in place of the scene's; none: nothing changes.
// Throws as above.
void AddMoving(const std::vector<Moving>& moving, OptimizeRequest* request);

// An answer, and its row as the program writes it.
struct AnswerAndRow {
  PathAnswer answer;
  nlohmann::ordered_json row;
};

// A world for Python.  Ipopt runs once at a time in a process, and samplers
// share OMPL's generator: one question at a time.
class Workshop {
 public:
  Workshop(const Scene& scene, bool cache, double max_mib);

  const World& world() const { return world_; }
  const Scene& scene() const { return scene_; }
  // All obstacles' contact spaces, built when first asked for: Ctrl-C stops
  // that.  Called with Python's lock.
  const WorldSpaces& Spaces() const;

  // The scene's requests between other ends.  Throws InputError for numbers
  // that are not finite.
  PlanRequest PlanBetween(const Point& start, const Point& goal) const;
  OptimizeRequest OptimizeBetween(const Point& start, const Point& goal) const;
  // The same for a motion.
  OptimizeRequest MotionBetween(const Point& start, const Point& goal,
                                const MotionWishes& wishes) const;
  // A length above 0 as users write it.
  Length Clearance(const std::string& text, const std::string& what) const;

  // Ctrl-C stops what is built for them, and takes the best motion so far.
  // Called with Python's lock.
  AnswerAndRow Plan(const PlanRequest& request);
  AnswerAndRow Optimize(const OptimizeRequest& request);
  AnswerAndRow Retime(const std::vector<Point>& path,
                      const OptimizeRequest& request);

 private:
  Scene Between(const Point& start, const Point& goal) const;

  Scene scene_;
  World world_;
  std::mutex one_at_a_time_;
  mutable std::atomic<bool> is_built_{false};  // Spaces()
};

}  // namespace phongpd::python
