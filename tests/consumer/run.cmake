# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D BUILD=... -D SOURCE=... -P run.cmake: installs the built library,
# builds this folder against it as an outsider would, and runs the result.
cmake_minimum_required(VERSION 3.23)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(work ${BUILD}/consumer)
file(REMOVE_RECURSE ${BUILD}/install ${work})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${BUILD}/install --component
    development)
file(GLOB_RECURSE headers RELATIVE ${BUILD}/install/include
     ${BUILD}/install/include/*.h)
if(NOT "phongpd/core/mesh/triangle_mesh.h" IN_LIST headers
   OR "phongpd/core/contact_space/convolution.h" IN_LIST headers)
  message(FATAL_ERROR "installed headers are not the public ones: ${headers}")
endif()

set(configure ${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer
              -D CMAKE_PREFIX_PATH=${BUILD}/install)
run(${configure} -B ${work} -D COMPONENT=core -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work})
file(
  WRITE ${work}/box.off
  "OFF\n8 12 0\n-1 -1 -1\n1 -1 -1\n-1 1 -1\n1 1 -1\n-1 -1 1\n1 -1 1\n-1 1 1\n\
1 1 1\n3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n\
3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n")
execute_process(
  COMMAND ${work}/consumer ${work}/box.off ${work}/box.off
  OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
# Two boxes of side 2: C_obj is the box of side 4, so the last point lies on
# its surface and the middle one is up to 2 units inside, and no less than 1.8.
if(NOT output MATCHES "\n2: 0\n$" OR NOT output MATCHES "\n0: -(1\\.[89]|2)")
  message(FATAL_ERROR "unexpected answer of the consumer:\n${output}")
endif()

if(EXISTS ${BUILD}/planners/ompl)
  run(${configure} -B ${work}-ompl -D COMPONENT=ompl -D
      CMAKE_BUILD_TYPE=Release)
  run(${CMAKE_COMMAND} --build ${work}-ompl)
endif()

execute_process(
  COMMAND ${configure} -B ${work}-missing -D COMPONENT=nonsense
  RESULT_VARIABLE result
  OUTPUT_QUIET
  ERROR_VARIABLE error)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "built without the component 'nonsense'")
  message(FATAL_ERROR "a missing component is not named: ${error}")
endif()
