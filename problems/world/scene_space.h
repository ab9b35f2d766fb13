// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_cache.h"
#include "planners/exact/free_space.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// How the obstacles of a scene become contact spaces.
enum class SpaceLayout {
  kMerged,       // one, of all of them
  kPerObstacle,  // one each; they may overlap
  kSealed,       // one, of all of them and the bounds: what planners need
};

// The contact spaces of a scene, as optimisers and planners need them; only
// what the robot can touch within the bounds is built.
struct SceneSpace {
  // D, the diagonal of ContactBounds(scene): the length that margins and
  // smoothing lengths are fractions of, whatever the layout.
  double diagonal = 0.0;
  // Each of length D; bounds in it: kSealed only.
  std::vector<ContactSpace> contact_spaces;
  // All obstacles and the bounds in one: free cells end at the bounds.  Equal
  // to contact_spaces[0] where there are no bounds and all is merged.
  std::optional<ContactSpace> sealed;
  std::shared_ptr<const FreeSpace> free_space;  // of contact_spaces and bounds
  std::size_t triangles = 0;                    // of contact_spaces
  double seconds = 0.0;                         // building, or reading a cache
  bool from_cache = false;                      // at least one of them
  std::vector<std::string> warnings;
};

// Builds them one after the other (each build is parallel), or takes them from
// the cache.  Throws InputError, starting with the scene's name, if there is
// nothing to collide with.
SceneSpace BuildSceneSpace(const Scene& scene,
                           SpaceLayout layout = SpaceLayout::kMerged,
                           const ContactSpaceCache& cache = {});

// One sentence for a start or goal (`which`) that is not free: how deep in
// which obstacle, or that it is beyond the bounds.  Euclidean depth.
std::string EndInCollision(const Scene& scene, const SceneSpace& space,
                           const Eigen::Vector3d& q, const std::string& which);

}  // namespace phongpd
