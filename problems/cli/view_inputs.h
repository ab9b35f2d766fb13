// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "problems/cli/scene_solver.h"
#include "viewer/view.h"

namespace phongpd::cli {

struct ViewRequest {
  std::vector<std::string> things;  // files, or families with knobs
  std::string robot;  // mesh that moves, for files without a scene
  std::optional<Eigen::Vector3d> from, to;  // of a motion's table
  std::string root;                         // of mesh files of scenes
  std::string repair = "reject";            // of those
  bool build = false;  // build contact spaces of scenes, or take them kept
  bool no_cache = false;
};

// Everything that was asked for in one view: meshes, contact spaces, scenes,
// runs, plans, motions and depths, recognised by extension and content.  Runs
// whose scene is a family with knobs bring it along.  Throws InputError for
// what is none of them, and for things of different scenes.  `scene`: that
// which is shown, if it is at hand.
View ReadThings(const ViewRequest& request, std::optional<ServedScene>* scene);

}  // namespace phongpd::cli
