// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "problems/scenes/fleet_scene.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/turning_scene.h"

namespace phongpd {

// Where a command's scene comes from: a scene file, a problem of OMPL.app
// (ompl_app_problem.h), or a family of
// scene_library.h with knobs, "plate:thickness=0.02,offset=1000", or one of
// turning_families.h, "alpha:gap=1.2" or "alpha:1.2".
class SceneSource {
 public:
  // Throws InputError if `text` names neither a file nor a family, or a knob
  // is not key=number.  A file is read here, once, as it may be a pipe; throws
  // what ReadInputFile refuses.  `root` and `repair`: see ReadScene.
  explicit SceneSource(const std::string& text, const std::string& root = "",
                       Repair repair = Repair::kReject);

  // As the user wrote it, for tables: a file without folder and extension.
  const std::string& label() const { return label_; }
  // A family has a scene for every seed (knob `seed`); a file is one scene.
  bool is_family() const { return !is_file_; }

  // Parses or makes it.  A seed is ignored by a file, and overrides the knob of
  // a family.  Throws InputError like ReadScene and MakeScene.
  Scene Load(std::optional<std::uint64_t> seed = std::nullopt) const;

  // Of a file of several robots, which Load refuses: is it one, and the same.
  bool has_robots() const { return has_robots_; }
  FleetScene LoadFleet() const;
  // Of a file or family whose robot turns, which Load refuses, too.
  bool turns() const { return turns_; }
  TurningScene LoadTurning() const;

  // 32 hexadecimal digits that change with the scene: with its file or knobs,
  // and with the solids they give.  Throws like Load.
  std::string Digest() const;

 private:
  std::string text_;
  std::string root_;
  Repair repair_ = Repair::kReject;
  std::string label_;
  bool is_file_ = false;
  bool has_robots_ = false;
  bool turns_ = false;
  bool is_ompl_app_ = false;
  std::string content_;  // of the file
  std::string family_;
  std::map<std::string, double> knobs_;
};

}  // namespace phongpd
