// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/versions.h"

#include <CGAL/version.h>
#include <fcl/config.h>
#include <oneapi/tbb/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "planners/ompl/ompl_planning.h"
#include "planners/trajectory/ipopt_solve.h"

namespace phongpd {
namespace {

std::string Dotted(int major, int minor, int patch) {
  return std::to_string(major) + '.' + std::to_string(minor) + '.' +
         std::to_string(patch);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Versions() {
  return {
      {"PhongPD", PHONGPD_VERSION},
      {"CGAL", CGAL_VERSION_STR},
      {"Eigen",
       Dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"TBB", TBB_VERSION_STRING},
      {"FCL", FCL_VERSION},
      {"Ipopt", IpoptVersion()},
      {"OMPL", OmplVersion()},
      {"CLI11", CLI11_VERSION},
      {"nlohmann-json",
       Dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
              NLOHMANN_JSON_VERSION_PATCH)},
      {"compiler", "GCC or compatible " __VERSION__},
  };
}

}  // namespace phongpd
