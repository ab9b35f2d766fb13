// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/passages.h"

#include <nlohmann/json.hpp>

#include "core/contact/contact_space.h"
#include "planners/world/workspace.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/shapes.h"

namespace phongpd::testing {

Passage MakePassage(const std::string& family, double delta,
                    int rotation_seed) {
  return MakePassage(family,
                     {{"delta", delta}, {"rotation_seed", rotation_seed}});
}

Passage MakePassage(const std::string& family,
                    const std::map<std::string, double>& knobs) {
  Passage passage;
  passage.scene = ParseScene(MakeScene(family, knobs), family);
  const Workspace& workspace = passage.scene.workspace;
  const TriangleMesh contact =
      BuildContactSpace(workspace.robot, MergedObstacle(workspace)).mesh();
  const Scene& scene = passage.scene;
  passage.model = std::make_shared<const ContactModel>(
      std::vector<ContactSpace>{TakeAsContactSpace(contact)},
      workspace.bounds.IsEmpty()
          ? SamplingRegion(TakeAsContactSpace(contact), scene.start, scene.goal)
          : workspace.bounds);
  return passage;
}

std::shared_ptr<const ContactModel> BoxModel() {
  const Eigen::Vector3d one = Eigen::Vector3d::Ones();
  return std::make_shared<const ContactModel>(
      std::vector<ContactSpace>{TakeAsContactSpace(MakeBox(-one, one))},
      BoundingBox{-2.0 * one, 2.0 * one});
}

}  // namespace phongpd::testing
