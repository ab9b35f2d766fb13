# SPDX-License-Identifier: GPL-3.0-or-later
# phongpd_add_wasm(NAME SOURCES...): NAME.wasm, of sources that need neither
# threads nor exceptions, for the pages of the viewer, by clang as WebAssembly.
# Sets PHONGPD_<NAME>_WASM to the file that a build makes, or to nothing where
# the compiler for it is absent: pages then do without.
find_program(PHONGPD_WASM_CLANG NAMES clang++ clang++-14)
set(PHONGPD_WASM_FLAGS
    --target=wasm32-wasi
    -std=c++17
    -O2
    -DNDEBUG
    # There is no unwinding: page_failure.cc tells the page what was thrown.
    -fignore-exceptions
    -fno-rtti
    # Numbers as those of the program, which fuses nothing either.
    -ffp-contract=off
    # For std::clock.
    -D_WASI_EMULATED_PROCESS_CLOCKS
    -ffunction-sections
    -fdata-sections)
set(PHONGPD_WASM_LINK -mexec-model=reactor -Wl,--gc-sections
                      -Wl,-z,stack-size=1048576 -Wl,--strip-all
                      -lwasi-emulated-process-clocks)
if(PHONGPD_WASM_CLANG AND NOT DEFINED PHONGPD_HAS_WASM)
  set(trial ${CMAKE_CURRENT_BINARY_DIR}/wasm_trial)
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
                 "wasm32: what pages ask and solve by themselves")
endif()

function(phongpd_add_wasm name)
  string(TOUPPER ${name} result)
  set(result PHONGPD_${result}_WASM)
  set(${result} "" PARENT_SCOPE)
  if(NOT PHONGPD_HAS_WASM)
    return()
  endif()
  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  set(sources ${ARGN})
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name})
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
    get_filename_component(stem ${source} NAME_WE)
    set(object ${folder}/${stem}.o)
    add_custom_command(
      OUTPUT ${object}
      COMMAND
        ${CMAKE_CXX_COMPILER_LAUNCHER} ${PHONGPD_WASM_CLANG}
        ${PHONGPD_WASM_FLAGS} -I${PROJECT_SOURCE_DIR} -isystem ${eigen} -MD -MF
        ${object}.d -c ${source} -o ${object}
      DEPENDS ${source}
      DEPFILE ${object}.d
      COMMENT "Building WebAssembly of ${name}, ${stem}"
      VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set(wasm ${CMAKE_CURRENT_BINARY_DIR}/${name}.wasm)
  set(${result} ${wasm} PARENT_SCOPE)
  add_custom_command(
    OUTPUT ${wasm}
    COMMAND ${PHONGPD_WASM_CLANG} ${PHONGPD_WASM_FLAGS} ${objects}
            ${PHONGPD_WASM_LINK} -o ${wasm}
    DEPENDS ${objects}
    COMMENT "Linking ${name}.wasm"
    VERBATIM)
endfunction()
