// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the certified judge of motions that turn beside FCL, at samples and
// by its continuous collision, on the same motions.  Prints JSON Lines, a row a
// kind of motion and method, times in processor seconds of its thread.
//
// A miss is a motion called free that the certified judge proves colliding; a
// contradiction one called colliding that it proves free.
//
// `--ends` prints the motions with what is proved of them instead, for judges
// of other languages (rigid_peers.py): a row a kind of motion.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "constraints/oracle/fcl_surfaces.h"
#include "results/bench/program.h"
#include "results/bench/rigid_motions.h"

namespace phongpd::bench {
namespace {

// The same surface with each triangle in four, `times` times over.
TriangleMesh Refined(TriangleMesh mesh, int times) {
  for (; times > 0; --times) {
    TriangleMesh fine;
    fine.vertices = mesh.vertices;
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] = middles.try_emplace(
          std::minmax(a, b), static_cast<int>(fine.vertices.size()));
      if (is_new) {
        fine.vertices.push_back(0.5 *
                                (mesh.vertices[static_cast<std::size_t>(a)] +
                                 mesh.vertices[static_cast<std::size_t>(b)]));
      }
      return at->second;
    };
    for (const Triangle& t : mesh.triangles) {
      const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]),
                ca = middle(t[2], t[0]);
      for (const Triangle& part :
           {Triangle{t[0], ab, ca}, Triangle{ab, t[1], bc},
            Triangle{ca, bc, t[2]}, Triangle{ab, bc, ca}}) {
        fine.triangles.push_back(part);
      }
    }
    mesh = std::move(fine);
  }
  return mesh;
}

struct Method {
  std::string name;
  // Is the motion free?  None: undecided.
  std::function<std::optional<bool>(const RigidMotionEnds&)> is_free;
};

std::optional<bool> Certified(const RigidJudge& judge,
                              const RigidMotionEnds& ends) {
  const RigidCheck check = judge.Check(RigidMotion(ends.start, ends.end));
  if (check.outcome == MotionVerdict::kUndecided) return std::nullopt;
  return check.IsFree();
}

// Between the ends, which are free.
bool IsFreeAtSamples(const FclSurfaces& fcl, const RigidMotionEnds& ends,
                     int parts) {
  const RigidMotion motion(ends.start, ends.end);
  for (int i = 1; i < parts; ++i) {
    if (fcl.Meet(motion.At(static_cast<double>(i) / parts))) return false;
  }
  return true;
}

std::vector<Method> Methods(const RigidScene& scene, const RigidJudge& judge,
                            const FclSurfaces& fcl, bool asks_continuous) {
  std::vector<Method> methods = {
      {"certified", [&judge](const RigidMotionEnds& ends) {
         return Certified(judge, ends);
       }}};
  for (const double resolution : {0.01, 0.001}) {
    methods.push_back({"FCL at " + Rounded(100 * resolution) + " %",
                       [&, resolution](const RigidMotionEnds& ends) {
                         return std::optional<bool>(IsFreeAtSamples(
                             fcl, ends, OmplParts(scene, ends, resolution)));
                       }});
  }
  // A tenth of a second each where meshes are fine, and as wrong.
  if (!asks_continuous) return methods;
  methods.push_back({"FCL continuous", [&fcl](const RigidMotionEnds& ends) {
                       return std::optional<bool>(!fcl.Meet(
                           ends.start, ends.end,
                           FclSurfaces::Solver::kConservativeAdvancement));
                     }});
  return methods;
}

// What the method says of the motions, beside what is proved of them, and its
// time.
void AddJudged(const Method& method,
               const std::vector<RigidMotionEnds>& motions,
               const std::vector<std::optional<bool>>& proved,
               nlohmann::ordered_json* row) {
  std::vector<std::optional<bool>> said;
  const double begin = ThreadCpuSeconds();
  for (const RigidMotionEnds& ends : motions) {
    said.push_back(method.is_free(ends));
  }
  const double seconds = ThreadCpuSeconds() - begin;
  int free = 0, colliding = 0, undecided = 0, misses = 0, against = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    free += proved[i] == true ? 1 : 0;
    colliding += proved[i] == false ? 1 : 0;
    undecided += said[i].has_value() ? 0 : 1;
    misses += said[i] == true && proved[i] == false ? 1 : 0;
    against += said[i] == false && proved[i] == true ? 1 : 0;
  }
  const double count = std::max(1.0, static_cast<double>(motions.size()));
  (*row)["method"] = method.name;
  (*row)["motions"] = motions.size();
  (*row)["free"] = free;
  (*row)["colliding"] = colliding;
  (*row)["ms"] = 1e3 * seconds / count;
  (*row)["undecided"] = undecided;
  (*row)["misses"] = misses;
  (*row)["contradictions"] = against;
}

// x, y, z, and w, x, y, z of the orientation.
nlohmann::json ToRow(const RobotPose& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

void PrintEnds(const RigidScene& scene, const RigidJudge& judge,
               RigidMotionKind kind,
               const std::vector<RigidMotionEnds>& motions) {
  nlohmann::ordered_json row = {{"scene", scene.name},
                                {"kind", ToString(kind)},
                                {"motions", nlohmann::json::array()}};
  for (const RigidMotionEnds& ends : motions) {
    const std::optional<bool> is_free = Certified(judge, ends);
    row["motions"].push_back(
        {{"start", ToRow(ends.start)},
         {"end", ToRow(ends.end)},
         {"free", is_free ? nlohmann::json(*is_free) : nlohmann::json()}});
  }
  std::cout << row.dump() << std::endl;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->Options("The certified judge of motions that turn beside FCL.");
  std::string name;
  int count = 200, refined = 0;
  unsigned seed = 1;
  bool prints_ends = false;
  app.add_option("scene", name, "FAMILY or FAMILY:VALUE")->required();
  app.add_option("--motions", count)->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  app.add_option("--refined", refined, "So often each triangle in four")
      ->check(CLI::Range(0, 6));
  app.add_flag("--ends", prints_ends, "Print the motions, judge none");
  program->Parse();
  RigidScene scene = MakeRigidScene(name);
  if (refined > 0) {
    scene.name += " refined " + std::to_string(refined);
    scene.robot = Refined(scene.robot, refined);
    for (TriangleMesh& one : scene.obstacles) one = Refined(one, refined);
  }
  const RigidJudge judge({scene.robot}, scene.obstacles);
  TriangleMesh world;
  for (const TriangleMesh& one : scene.obstacles) world = Joined(world, one);
  const FclSurfaces fcl(scene.robot, world);
  for (const RigidMotionKind kind :
       {RigidMotionKind::kRandom, RigidMotionKind::kContact,
        RigidMotionKind::kGrazing}) {
    const std::vector<RigidMotionEnds> motions =
        MakeRigidMotions(scene, judge, kind, count, seed);
    if (prints_ends) {
      PrintEnds(scene, judge, kind, motions);
      continue;
    }
    std::vector<std::optional<bool>> proved;
    for (const RigidMotionEnds& ends : motions) {
      proved.push_back(Certified(judge, ends));
    }
    for (const Method& method : Methods(scene, judge, fcl, refined == 0)) {
      nlohmann::ordered_json row = {
          {"scene", scene.name},
          {"robot_triangles", scene.robot.triangles.size()},
          {"world_triangles", world.triangles.size()},
          {"kind", ToString(kind)}};
      AddJudged(method, motions, proved, &row);
      row["seed"] = seed;
      std::cout << row.dump() << std::endl;
    }
  }
  return 0;
}

}  // namespace phongpd::bench
