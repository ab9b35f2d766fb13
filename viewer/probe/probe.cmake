# SPDX-License-Identifier: GPL-3.0-or-later
# probe.wasm: the queries of core for the pages of the viewer, by clang as
# WebAssembly.  Sets PHONGPD_PROBE_WASM to the file that a build makes, or to
# nothing where the compiler for it is absent: pages then have no live probe.
set(PHONGPD_PROBE_WASM "")
find_program(PHONGPD_WASM_CLANG NAMES clang++ clang++-14)
set(PHONGPD_WASM_FLAGS
    --target=wasm32-wasi
    -std=c++17
    -O2
    -DNDEBUG
    # There is no unwinding: probe.cc tells the page what was thrown.
    -fignore-exceptions
    -fno-rtti
    # Numbers as those of the program, which fuses nothing either.
    -ffp-contract=off
    -ffunction-sections
    -fdata-sections)
set(PHONGPD_WASM_LINK -mexec-model=reactor -Wl,--gc-sections
                      -Wl,-z,stack-size=1048576 -Wl,--strip-all)
if(PHONGPD_WASM_CLANG AND NOT DEFINED PHONGPD_HAS_WASM)
  set(trial ${CMAKE_CURRENT_BINARY_DIR}/probe_trial)
  file(WRITE ${trial}.cc
       "#include <vector>\nextern \"C\" int one() "
       "{ return std::vector<int>(1).size(); }\n")
  execute_process(
    COMMAND ${PHONGPD_WASM_CLANG} ${PHONGPD_WASM_FLAGS} ${PHONGPD_WASM_LINK}
            ${trial}.cc -o ${trial}.wasm
    RESULT_VARIABLE failed
    OUTPUT_QUIET ERROR_QUIET)
  if(failed EQUAL 0)
    set(PHONGPD_HAS_WASM ON CACHE INTERNAL "clang compiles for WebAssembly")
  endif()
endif()
if(NOT PHONGPD_HAS_WASM)
  message(STATUS "Not built for want of clang, lld, wasi-libc and libc++ for "
                 "wasm32: the live probe of the pages")
  return()
endif()

get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/bvh/*.cc
     ${PROJECT_SOURCE_DIR}/core/projection/*.cc)
list(FILTER sources EXCLUDE REGEX "query_batch|explored_surface|window_metric|window_phong|window_smoothed|to_depth")  # threads
list(APPEND sources ${PROJECT_SOURCE_DIR}/core/contact/contact_space.cc
     ${PROJECT_SOURCE_DIR}/core/mesh/mesh_error.cc
     ${PROJECT_SOURCE_DIR}/core/mesh/edge_sides.cc
     ${PROJECT_SOURCE_DIR}/core/mesh/sorted_mesh.cc
     ${PROJECT_SOURCE_DIR}/core/mesh/triangle_mesh.cc
     ${CMAKE_CURRENT_LIST_DIR}/probe.cc)
set(folder ${CMAKE_CURRENT_BINARY_DIR}/probe)
file(MAKE_DIRECTORY ${folder})
# By itself each source parses what it shares with the others.
if(PHONGPD_UNITY_BUILD)
  list(LENGTH sources count)
  math(EXPR half "${count} / 2")
  set(units "")
  foreach(number RANGE 1)
    math(EXPR first "${number} * ${half}")
    set(length ${half})
    if(number EQUAL 1)
      set(length -1)
    endif()
    list(SUBLIST sources ${first} ${length} part)
    list(TRANSFORM part REPLACE "(.+)" "#include \"\\1\"\n")
    string(CONCAT text ${part})
    file(CONFIGURE OUTPUT ${folder}/unity_${number}.cc CONTENT "${text}" @ONLY)
    list(APPEND units ${folder}/unity_${number}.cc)
  endforeach()
  set(sources ${units})
endif()
set(objects "")
foreach(source IN LISTS sources)
  get_filename_component(name ${source} NAME_WE)
  set(object ${folder}/${name}.o)
  add_custom_command(
    OUTPUT ${object}
    COMMAND
      ${CMAKE_CXX_COMPILER_LAUNCHER} ${PHONGPD_WASM_CLANG}
      ${PHONGPD_WASM_FLAGS} -I${PROJECT_SOURCE_DIR} -isystem ${eigen}
      -MD -MF ${object}.d -c ${source} -o ${object}
    DEPENDS ${source}
    DEPFILE ${object}.d
    COMMENT "Building WebAssembly of ${name}"
    VERBATIM)
  list(APPEND objects ${object})
endforeach()
set(PHONGPD_PROBE_WASM ${CMAKE_CURRENT_BINARY_DIR}/probe.wasm)
add_custom_command(
  OUTPUT ${PHONGPD_PROBE_WASM}
  COMMAND ${PHONGPD_WASM_CLANG} ${PHONGPD_WASM_FLAGS} ${PHONGPD_WASM_LINK}
          ${objects} -o ${PHONGPD_PROBE_WASM}
  DEPENDS ${objects}
  COMMENT "Linking probe.wasm"
  VERBATIM)
