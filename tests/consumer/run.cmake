# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D BUILD=... -D SOURCE=... -P run.cmake: installs the built library,
# builds this folder against it as an outsider would, and runs the results.
cmake_minimum_required(VERSION 3.23)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(work ${BUILD}/consumer)
set(prefix ${BUILD}/install)
file(REMOVE_RECURSE ${prefix} ${work} ${work}-all ${work}-tree
     ${work}-missing)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component
    development)
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*.h)
if(NOT "phongpd/core/mesh/triangle_mesh.h" IN_LIST headers
   OR "phongpd/core/minkowski/convolution/convolution.h" IN_LIST headers)
  message(FATAL_ERROR "installed headers are not the public ones: ${headers}")
endif()

foreach(file LICENSE LICENSE-EXCEPTION)
  if(NOT EXISTS ${prefix}/share/licenses/phongpd/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()

# The core asks for none of the other components' libraries.
set(configure ${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer -D
              PHONGPD_SOURCE=${SOURCE} -D CMAKE_PREFIX_PATH=${prefix})
run(${configure} -B ${work} -D COMPONENTS=core -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work})
file(
  WRITE ${work}/box.off
  "OFF\n8 12 0\n-1 -1 -1\n1 -1 -1\n-1 1 -1\n1 1 -1\n-1 -1 1\n1 -1 1\n-1 1 1\n\
1 1 1\n3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n\
3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n")
execute_process(
  COMMAND ${work}/use_core ${work}/box.off ${work}/box.off
  OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
# Two boxes of side 2: C_obj is the box of side 4, so the last point lies on
# its surface and the middle one is up to 2 units inside, and no less than 1.8.
if(NOT output MATCHES "\n2: 0\n$" OR NOT output MATCHES "\n0: -(1\\.[89]|2)")
  message(FATAL_ERROR "unexpected answer of the consumer:\n${output}")
endif()

# The same by pkg-config, without CMake, where that is.
find_program(pkg_config pkg-config)
file(GLOB_RECURSE pc ${prefix}/phongpd-core.pc)
if(NOT pc)
  message(FATAL_ERROR "not installed: phongpd-core.pc")
endif()
if(pkg_config)
  cmake_path(GET pc PARENT_PATH pc_folder)
  execute_process(
    COMMAND
      sh -ec "export PKG_CONFIG_PATH='${pc_folder}'
      c++ -std=c++17 '${SOURCE}/tests/consumer/core.cc' -o use_pc \
        $(pkg-config --cflags --libs phongpd-core)
      LD_LIBRARY_PATH=$(pkg-config --variable=libdir phongpd-core) \
        ./use_pc box.off box.off"
    WORKING_DIRECTORY ${work}
    OUTPUT_VARIABLE by_pc COMMAND_ERROR_IS_FATAL ANY)
  if(NOT by_pc STREQUAL output)
    message(FATAL_ERROR "by pkg-config another answer:\n${by_pc}")
  endif()
endif()

# -DPHONGPD_BUILD=core configures that alone, and a word that is none is said.
file(REMOVE_RECURSE ${work}-only)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${work}-only -D PHONGPD_BUILD=core)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${work}-only --target help
                OUTPUT_VARIABLE targets COMMAND_ERROR_IS_FATAL ANY)
if(NOT targets MATCHES "phongpd_core"
   OR targets MATCHES "constraints|phongpd_planners|[.]{3} phongpd\n|_test")
  message(FATAL_ERROR "PHONGPD_BUILD=core configures more:\n${targets}")
endif()
# A part that the core does without is none of it, and who asks for it is told.
file(GLOB_RECURSE exported ${work}-only/PhongPD*Targets.cmake)
list(TRANSFORM exported REPLACE "^.*/PhongPD(.*)Targets\\.cmake$" "\\1")
list(SORT exported)
if(NOT exported STREQUAL "core;files")
  message(FATAL_ERROR "PHONGPD_BUILD=core installs more: ${exported}")
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${work}-only -D PHONGPD_BUILD=cores
  RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE error)
if(code EQUAL 0 OR NOT error MATCHES "found[ \n]+'cores'")
  message(FATAL_ERROR "PHONGPD_BUILD=cores: ${error}")
endif()

# Nobody who wants planners or worlds needs FCL.
run(${configure} -B ${work}-all -D COMPONENTS=planners,problems -D
    CMAKE_DISABLE_FIND_PACKAGE_fcl=ON)
# All components that were built: each header on its own, and the planners.
file(GLOB_RECURSE components ${prefix}/*/PhongPD*Targets.cmake)
list(TRANSFORM components REPLACE "^.*/PhongPD(.*)Targets\\.cmake$" "\\1")
list(JOIN components "," listed)
file(REMOVE_RECURSE ${work}-all)
run(${configure} -B ${work}-all -D COMPONENTS=${listed} -D
    HEADERS=${prefix}/include)
run(${CMAKE_COMMAND} --build ${work}-all --parallel 2)
foreach(component ipopt ompl solve problems)
  if(component IN_LIST components)
    run(${work}-all/use_${component})
  endif()
endforeach()

# The same of the tree as a part of the project; libraries are not built again.
run(${configure} -B ${work}-tree -D COMPONENTS=core,planners,problems -D
    WAY=subdirectory -D COMPILE_ONLY=ON -D HEADERS=${prefix}/include)
run(${CMAKE_COMMAND} --build ${work}-tree --parallel 2 --target own_last
    use_core headers_of_core headers_of_planners headers_of_problems)

execute_process(
  COMMAND ${configure} -B ${work}-missing -D COMPONENTS=nonsense
  RESULT_VARIABLE result
  OUTPUT_QUIET
  ERROR_VARIABLE error)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "built without the component 'nonsense'")
  message(FATAL_ERROR "a missing component is not named: ${error}")
endif()
