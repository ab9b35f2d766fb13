# SPDX-License-Identifier: GPL-3.0-or-later
# Checked here: scripts/release.sh --check (it parses, its switches are those of
# CMakeLists.txt).  Not checked: that it builds under vcpkg.
vcpkg_from_git(
  OUT_SOURCE_PATH SOURCE_PATH
  # Of the release; they are known when there is one.
  URL https://example.invalid/phongpd.git
  REF 0000000000000000000000000000000000000000)

vcpkg_check_features(
  OUT_FEATURE_OPTIONS FEATURE_OPTIONS
  FEATURES
  oracle PHONGPD_BUILD_ORACLE
  ipopt PHONGPD_BUILD_IPOPT
  ompl PHONGPD_BUILD_OMPL
  problems PHONGPD_BUILD_PROBLEMS
  tools PHONGPD_BUILD_STUDIES
  tools PHONGPD_BUILD_VIEWER
  tools PHONGPD_BUILD_PROGRAM)

vcpkg_cmake_configure(
  SOURCE_PATH ${SOURCE_PATH}
  OPTIONS
  ${FEATURE_OPTIONS}
  -DPHONGPD_BUILD_EXAMPLES=OFF
  -DPHONGPD_BUILD_RESULTS=OFF
  -DPHONGPD_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME PhongPD CONFIG_PATH lib/cmake/PhongPD)
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES phongpd AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include"
     "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE
                                  ${SOURCE_PATH}/LICENSE-EXCEPTION)
