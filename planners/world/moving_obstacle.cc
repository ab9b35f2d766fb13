// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/moving_obstacle.h"

#include <memory>
#include <set>

#include "constraints/motion_oracle.h"
#include "core/contact/content_hash.h"
#include "core/contact/convolution_model.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/world/world.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The same for the same mesh.
std::string TagOf(const TriangleMesh& mesh) {
  std::string bytes;
  const auto add = [&](const auto& items) {
    bytes += std::to_string(items.size()) + ' ';
    bytes.append(reinterpret_cast<const char*>(items.data()),
                 items.size() * sizeof(items[0]));
  };
  add(mesh.vertices);
  add(mesh.triangles);
  return internal::ToHex(internal::HashContent(bytes));
}

// Which of them the robot at q touches at the beginning or the end; null: none.
const MovingObstacle* Touched(const World& world,
                              const std::vector<MovingObstacle>& moving,
                              const Vector3d& q, bool is_at_end) {
  for (const MovingObstacle& one : moving) {
    const auto& pieces = one.motion.pieces();
    const Vector3d& place =
        is_at_end ? pieces.back().back() : pieces.front().front();
    if (MotionOracle(world.workspace().robot, one.solid).Collides(q - place)) {
      return &one;
    }
  }
  return nullptr;
}

}  // namespace

void RequireMoving(const World& world,
                   const std::vector<MovingObstacle>& moving) {
  std::set<std::string> names;
  for (const Solid& obstacle : world.workspace().obstacles) {
    names.insert(obstacle.name());
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const std::string which = "moving " + std::to_string(i);
    RequireNotEmpty(moving[i].solid, which);
    const std::string& name = moving[i].solid.name();
    if (moving[i].motion.empty()) {
      throw InputError(which + " (" + name +
                       "): expected a motion, found an empty one");
    }
    if (!names.insert(name).second) {
      throw InputError(which + ": expected a name of its own, found \"" + name +
                       "\", which another obstacle has");
    }
  }
}

std::vector<MovingBody> MovingBodies(
    const World& world, const std::vector<MovingObstacle>& moving) {
  RequireMoving(world, moving);
  std::vector<MovingBody> bodies;
  for (const MovingObstacle& one : moving) {
    auto space = world.Kept<FreeSpace>("moving " + TagOf(one.solid), [&] {
      return FreeSpace::OfConvolutions(
          {ConvolutionModel(world.workspace().robot, one.solid)});
    });
    bodies.push_back({one.solid.name(), std::move(space), one.motion});
  }
  return bodies;
}

std::string MovingAtStart(const World& world,
                          const std::vector<MovingObstacle>& moving,
                          const Vector3d& q, const std::string& which) {
  const MovingObstacle* touched = Touched(world, moving, q, false);
  if (touched == nullptr) return "";
  return which + " (" + FormatPoint(q) + "): the moving obstacle \"" +
         touched->solid.name() + "\" is there at t = 0";
}

std::string MovingAtEnd(const World& world,
                        const std::vector<MovingObstacle>& moving,
                        const Vector3d& q, const std::string& which) {
  const MovingObstacle* touched = Touched(world, moving, q, true);
  if (touched == nullptr) return "";
  return which + " (" + FormatPoint(q) + "): the moving obstacle \"" +
         touched->solid.name() + "\" comes to rest there, at t = " +
         Rounded(touched->motion.duration(), 6);
}

}  // namespace phongpd
