# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D SOURCE=<tree> -P versions_test.cmake: the version in CMakeLists.txt is
# the one that all other files tell, and the recipes are in themselves consistent.
cmake_minimum_required(VERSION 3.23)

file(READ ${SOURCE}/CMakeLists.txt lists)
if(NOT lists MATCHES "\n  VERSION ([0-9]+\\.[0-9]+\\.[0-9]+)\n")
  message(FATAL_ERROR "CMakeLists.txt: expected the line '  VERSION x.y.z'")
endif()
set(version ${CMAKE_MATCH_1})

# FILE must have PATTERN, whose first group is the version.
function(expect file pattern)
  file(READ ${SOURCE}/${file} text)
  if(NOT text MATCHES "${pattern}")
    message(SEND_ERROR "${file}: expected a version, as in ${pattern}")
  elseif(NOT CMAKE_MATCH_1 STREQUAL version)
    message(SEND_ERROR "${file}: expected version ${version} (that of "
                       "CMakeLists.txt), found ${CMAKE_MATCH_1}")
  endif()
endfunction()
expect(CITATION.cff "\nversion: ([^\n]*)\n")
# Below what is not released yet.
expect(CHANGELOG.md "\n## [^0-9\n]*([0-9.]+)")
expect(packaging/conda/recipe.yaml "\n  version: \"([^\"]*)\"\n")
expect(packaging/vcpkg/phongpd/vcpkg.json "\"version\": \"([^\"]*)\"")
# Those that read it themselves must find it.
foreach(reader pyproject.toml docs/conf.py)
  file(READ ${SOURCE}/${reader} text)
  string(FIND "${text}" "\"${version}\"" at)
  if(NOT at EQUAL -1)
    message(SEND_ERROR "${reader}: expected to read the version from "
                       "CMakeLists.txt, found a copy of it")
  endif()
endforeach()

# The port: its features are those of vcpkg.json, its switches those of
# CMakeLists.txt, and it calls what vcpkg has, with arguments it has.
set(port ${SOURCE}/packaging/vcpkg/phongpd)
file(READ ${port}/vcpkg.json manifest)
function(vcpkg_from_git)
  set(SOURCE_PATH ${SOURCE} PARENT_SCOPE)
endfunction()
function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES")
  while(arg_FEATURES)
    list(POP_FRONT arg_FEATURES feature switch)
    string(JSON type ERROR_VARIABLE error TYPE "${manifest}" features ${feature})
    if(error)
      message(SEND_ERROR "portfile.cmake: no feature '${feature}' in vcpkg.json")
    endif()
    if(NOT lists MATCHES "option\\(${switch} ")
      message(SEND_ERROR "portfile.cmake: no option ${switch} in CMakeLists.txt")
    endif()
    list(APPEND options -D${switch}=ON)
  endwhile()
  set(${arg_OUT_FEATURE_OPTIONS} ${options} PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  foreach(option IN LISTS arg_OPTIONS)
    string(REGEX REPLACE "^-D([A-Z_]+)=(ON|OFF)$" "\\1" switch "${option}")
    if(NOT lists MATCHES "option\\(${switch}[ \n]")
      message(SEND_ERROR "portfile.cmake: no option '${option}' in "
                         "CMakeLists.txt")
    endif()
  endforeach()
endfunction()
foreach(name cmake_install cmake_config_fixup copy_tools install_copyright)
  cmake_language(EVAL CODE "function(vcpkg_${name})\nendfunction()")
endforeach()
set(FEATURES core tools)
set(CURRENT_PACKAGES_DIR /nonexistent)
include(${port}/portfile.cmake)
