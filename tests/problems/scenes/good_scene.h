// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace phongpd::testing {

// A scene file of many parts, for tests that change it.
inline nlohmann::ordered_json GoodScene() {
  return nlohmann::ordered_json::parse(R"({
    "name": "good",
    "robot": {"shape": {"type": "ball", "radius": 0.5, "triangles": 20}},
    "obstacles": [
      {"id": "cube", "shape": {"type": "box", "size": [1, 1, 1]},
       "position": [0, 0, 0], "scale": 2,
       "rotation": {"axis": [0, 0, 1], "degrees": 30}},
      {"id": "step", "shape": {"type": "cells", "x": [0, 1, 2], "y": [0, 1],
                               "z": [0, 1, 2], "layers": [["##"], ["#."]]},
       "rotation": [1, 0, 0, 0, 0, -1, 0, 1, 0]}],
    "bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]},
    "start": [-3, 0, 0],
    "goal": [3, 0, 0],
    "limits": {"velocity": 1, "acceleration": [2, 2, 2], "jerk": 10},
    "via": [{"point": [0, 0, 4], "tolerance": 0.01, "dwell": 0.5}],
    "moving": [{"id": "cart", "shape": {"type": "box", "size": [1, 1, 1]},
                "position": [0, 0, 9],
                "motion": [{"duration": 2, "points": [[0, 0, 0], [1, 0, 0]]}]}],
    "duration": 0,
    "penetration": {"metric": "phong", "field": "normal",
                    "smoothing_length": 0.1, "jacobian": "direction"},
    "trajectory": {"waypoints": 40, "samples_per_segment": 2, "margin": 0.01,
                   "max_segment_ratio": 1.6,
                   "ipopt": {"tol": 1e-6, "mu_strategy": "adaptive"}},
    "planning": {"planner": "contact-surface", "time_limit": 5.0,
                 "clearance": 0.01},
    "feasible": true,
    "witness": [[-3, 0, 0], [0, 0, 4], [3, 0, 0]]
  })");
}

}  // namespace phongpd::testing
