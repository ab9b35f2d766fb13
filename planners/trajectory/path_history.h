// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "planners/trajectory/ipopt_solve.h"
#include "planners/trajectory/trajectory_problem.h"

namespace phongpd {

// An iterate of Ipopt as the path that it stands for.
struct PathIterate {
  std::string stage;       // of the pipeline: "ipopt", "corridor"; or empty
  int route = 0;           // as in StageRecord
  int round = 0;           // of the stage, from 0
  IterationRecord record;  // numbered within its round
  Path path;               // start and goal included
};
using PathObserver = std::function<void(const PathIterate&)>;

// Makes the settings tell `observer` of every iterate, besides what they do
// already; `path_of` must live as long as they are used.  Nothing where there
// is no observer.
void TellPaths(const PathObserver& observer, int round,
               const std::function<Path(const Eigen::VectorXd&)>& path_of,
               IpoptSettings* settings);

// The paths of all iterations of a run, in order, thinned evenly so that they
// stay small: of `count` iterations every stride()-th, the first, and the last.
class PathHistory {
 public:
  // What is kept: at most so many paths, with so many points together (two
  // paths in any case).
  static constexpr std::size_t kMostPaths = 240;
  static constexpr std::size_t kMostPoints = 60000;

  // An iterate with the number, round, route and stage of the one before takes
  // its place (IpoptSettings::on_iteration).
  void Add(const PathIterate& iterate);

  struct Entry {
    std::size_t number = 0;  // of all iterations, from 0
    PathIterate iterate;
  };
  std::vector<Entry> Kept() const;
  std::size_t count() const { return count_; }
  std::size_t stride() const { return stride_; }

 private:
  std::size_t count_ = 0;
  std::size_t stride_ = 1;
  std::vector<Entry> kept_;
  Entry last_;
};

}  // namespace phongpd
