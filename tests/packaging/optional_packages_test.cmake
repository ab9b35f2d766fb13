# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D SOURCE=... -D BUILD=... -P optional_packages_test.cmake: who builds a
# component is asked for what it stands on, and for nothing else.
cmake_minimum_required(VERSION 3.23)
set(all CORE CONSTRAINTS ORACLE PLANNERS IPOPT OMPL SOLVE SHAPES PROBLEMS STUDIES
        VIEWER PROGRAM EXAMPLES TESTS RESULTS)

# Configures the components alone, as if no other package than the core's were
# there but those of WITH.
function(alone components with asked)
  set(options "")
  foreach(part IN LISTS all)
    if(NOT part IN_LIST components)
      list(APPEND options -DPHONGPD_BUILD_${part}=OFF)
    endif()
  endforeach()
  foreach(package fcl ompl CLI11 nlohmann_json GTest assimp tinyxml2 PkgConfig)
    if(NOT package IN_LIST with)
      list(APPEND options -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
    endif()
  endforeach()
  file(REMOVE_RECURSE ${BUILD}/optional_packages)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD}/optional_packages
            ${options}
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "Not built for want of [^\n]*" found "${output}")
  if(NOT "${found}" MATCHES "^${asked}$")
    message(FATAL_ERROR "${components} with '${with}': expected '${asked}', "
                        "found '${found}'")
  endif()
endfunction()

alone(CORE "" "")
alone("CORE;CONSTRAINTS;PLANNERS" "" "")
# Worlds and scenes need no FCL; what more they can read is said.
alone("CORE;SHAPES" "" "")
alone("CORE;CONSTRAINTS;PLANNERS;SHAPES;PROBLEMS" nlohmann_json
      "Not built for want of [^;]*libassimp-dev[^;]*: readers of [^;]*")
alone("CORE;CONSTRAINTS;PLANNERS;SHAPES;PROBLEMS" "nlohmann_json;assimp;tinyxml2" "")
