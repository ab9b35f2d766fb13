// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/paper_benchmarks.h"

#include <nlohmann/json.hpp>

#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"

namespace phongpd {
namespace {

PaperBenchmark Make(const std::string& name, const std::string& title,
                    const std::string& paper_triangles,
                    std::vector<PaperMotion> motions) {
  const Scene scene = ParseScene(MakeScene(name, {}), name);
  return {name,
          title,
          scene.workspace.robot,
          JoinedObstacle(scene.workspace),
          paper_triangles,
          std::move(motions)};
}

}  // namespace

std::vector<PaperBenchmark> PaperBenchmarks() {
  return {
      Make("ball_cone", "ball 1008 and cone 78", "1035",
           {{"across",
             "through the cone beside its axis",
             {{-2.2, 0.15, 0.5}, {2.2, 0.25, 0.7}, 400}}}),
      Make("cone_axes", "cone 78 and axes 60", "440",
           {{"across",
             "through one bar beside its axis",
             {{1.4, -1.6, -0.9}, {1.5, 1.6, -0.7}, 400}}}),
      Make("ball_wrench", "ball 1008 and wrench 772", "about 4K",
           {{"across",
             "across the handle",
             {{0.2, -1.2, 0.1}, {0.4, 1.2, 0.05}, 400}},
            {"along",
             "along the handle and through the jaw",
             {{-4.2, 0.12, 0.08}, {4.2, 0.05, 0.15}, 400}}}),
  };
}

PaperMotion PaperMoment() {
  return {"moment",
          "Fig. 8's moment: pushed over the handle",
          {{0.3, -0.25, 0.7}, {0.3, 0.25, -0.7}, 25}};
}

}  // namespace phongpd
