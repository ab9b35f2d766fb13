// SPDX-License-Identifier: GPL-3.0-or-later
// A procedural scene, read as a file would be.
#include <phongpd/problems/scenes/scene.h>
#include <phongpd/problems/scenes/scene_library.h>

#include <iostream>
#include <nlohmann/json.hpp>

int main() {
  const phongpd::Scene scene =
      phongpd::ParseScene(phongpd::MakeScene("u_axis", {}), "u_axis");
  std::cout << scene.name << ", " << scene.workspace.obstacles.size()
            << " obstacles\n";
  return scene.workspace.obstacles.empty() ? 1 : 0;
}
