// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/world/scene_space.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "core/stopwatch.h"
#include "planners/exact/exact_solution.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

// Builds contact spaces of one robot and adds up what they cost.
class Builder {
 public:
  Builder(const Scene& scene, const ContactSpaceCache& cache, SceneSpace* space)
      : scene_(scene), cache_(cache), space_(space) {}

  ContactSpace Build(const TriangleMesh& obstacle, const std::string& name) {
    ContactSpaceOptions options;
    options.robot_name = scene_.name + ": robot";
    options.obstacle_name = scene_.name + ": " + name;
    ContactSpace built = BuildContactSpaceCached(scene_.workspace.robot,
                                                 obstacle, options, cache_);
    space_->from_cache = space_->from_cache || built.report().from_cache;
    for (const std::string& warning : built.report().warnings) {
      space_->warnings.push_back(warning);
    }
    return built.WithLength(space_->diagonal);
  }

  void Keep(const ContactSpace& built) {
    space_->triangles += built.mesh().triangles.size();
    space_->contact_spaces.push_back(built);
  }

 private:
  const Scene& scene_;
  const ContactSpaceCache& cache_;
  SceneSpace* space_;
};

}  // namespace

SceneSpace BuildSceneSpace(const Scene& scene, SpaceLayout layout,
                           const ContactSpaceCache& cache) {
  const Stopwatch stopwatch;
  SceneSpace space;
  space.diagonal = ContactBounds(scene.workspace).Diagonal();
  const std::vector<int> reachable = ReachableObstacles(scene.workspace);
  if (reachable.empty() && scene.workspace.bounds.IsEmpty()) {
    throw InputError(scene.name +
                     ": expected an obstacle or bounds, found neither");
  }
  Builder builder(scene, cache, &space);
  const bool is_sealed = !scene.workspace.bounds.IsEmpty();
  if (layout == SpaceLayout::kPerObstacle) {
    for (const int i : reachable) {
      const Obstacle& obstacle =
          scene.workspace.obstacles[static_cast<std::size_t>(i)];
      builder.Keep(builder.Build(obstacle.mesh, obstacle.id));
    }
  } else if (layout == SpaceLayout::kMerged && !reachable.empty()) {
    const ContactSpace merged =
        builder.Build(JoinedObstacle(scene.workspace), "obstacles");
    if (!is_sealed) space.sealed = merged;
    builder.Keep(merged);
  }
  if (!space.sealed) {
    space.sealed =
        builder.Build(MergedObstacle(scene.workspace),
                      is_sealed ? "obstacles and bounds" : "obstacles");
    if (layout == SpaceLayout::kSealed) builder.Keep(*space.sealed);
  }
  // Bounds that are part of the mesh need no second test.
  space.free_space = std::make_shared<FreeSpace>(space.contact_spaces,
                                                 layout == SpaceLayout::kSealed
                                                     ? FreeSpace::NoBounds()
                                                     : scene.workspace.bounds);
  space.seconds = stopwatch.Seconds();
  return space;
}

std::string EndInCollision(const Scene& scene, const SceneSpace& space,
                           const Eigen::Vector3d& q, const std::string& which) {
  const bool is_within =
      scene.workspace.bounds.IsEmpty() ||
      ((q.array() > scene.workspace.bounds.min.array()).all() &&
       (q.array() < scene.workspace.bounds.max.array()).all());
  const std::string text = which + " (" + FormatPoint(q) + ") ";
  if (!is_within) return text + "is not strictly within the bounds";
  const std::string names = NameObstacles(scene.workspace, q);
  if (names.empty()) return text + "touches an obstacle or the bounds";
  // A sealed mesh measures the way out of obstacles and bounds together.
  const bool is_sealed =
      space.free_space->bounds().IsEmpty() && !scene.workspace.bounds.IsEmpty();
  std::vector<ContactSpace> joined;
  if (is_sealed) {
    joined.push_back(BuildContactSpace(scene.workspace.robot,
                                       JoinedObstacle(scene.workspace)));
  }
  double depth = 0.0;
  for (const ContactSpace& one : is_sealed ? joined : space.contact_spaces) {
    const PenetrationResult result = EuclideanMetric(one).Query(q);
    if (result.inside) depth = std::max(depth, -result.signed_distance);
  }
  if (depth == 0.0) return text + "touches " + names;
  return text + "is " + Rounded(depth) + " deep in " + names;
}

}  // namespace phongpd
