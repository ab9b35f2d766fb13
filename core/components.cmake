# SPDX-License-Identifier: GPL-3.0-or-later
# How a component phongpd::NAME is made: its switch PHONGPD_BUILD_<NAME>, its
# library, its public headers, its place in the installed package.

# Can NAME be built?  Sets PHONGPD_HAS_<NAME>, and says in one sentence what is
# missing where its switch is on but
#   STANDS_ON  components are not built
#   FINDS      variable and package to install, in turn: the variable is false
# WHAT names it to people, phongpd::NAME by default.
function(phongpd_can_build name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "WHAT" "STANDS_ON;FINDS")
  string(TOUPPER ${name} switch)
  set(missing "")
  foreach(below IN LISTS arg_STANDS_ON)
    if(NOT TARGET phongpd::${below})
      list(APPEND missing phongpd::${below})
    endif()
  endforeach()
  while(arg_FINDS)
    list(POP_FRONT arg_FINDS found package)
    if(NOT ${found})
      list(APPEND missing "the package ${package}")
    endif()
  endwhile()
  if(NOT arg_WHAT)
    set(arg_WHAT phongpd::${name})
  endif()
  if(PHONGPD_BUILD_${switch} AND missing)
    list(JOIN missing ", " missing)
    message(STATUS "Not built for want of ${missing}: ${arg_WHAT}")
  endif()
  if(PHONGPD_BUILD_${switch} AND NOT missing)
    set(PHONGPD_HAS_${switch} TRUE PARENT_SCOPE)
  else()
    set(PHONGPD_HAS_${switch} FALSE PARENT_SCOPE)
  endif()
endfunction()

# What most sources include, parsed once for all of a target's.  Sources name
# what they use all the same: with CMAKE_DISABLE_PRECOMPILE_HEADERS, as in the
# preset clang, or a cache of objects, which needs options of its own for such
# headers, they compile without.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
# Several sources of a target are compiled as one, which parses the headers and
# instantiates the templates they share once.  A cache of objects does better by
# single sources: it recompiles only those that an edit has changed.
set(PHONGPD_UNITY_BUILD_DEFAULT ON)
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(PHONGPD_UNITY_BUILD_DEFAULT OFF)
endif()
option(PHONGPD_UNITY_BUILD "Compile several sources at once"
       ${PHONGPD_UNITY_BUILD_DEFAULT})
set(PHONGPD_COMMON_HEADERS <Eigen/Core> <algorithm> <functional> <map> <memory>
                           <string> <vector>)

# The library, without sources; shared where BUILD_SHARED_LIBS says so, of the same
# objects.  Until 1.0 a minor version may break what was compiled against the one
# before it.
function(phongpd_add_component component)
  set(target phongpd_${component})
  add_library(${target})
  set_target_properties(
    ${target}
    PROPERTIES VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
               DEFINE_SYMBOL "")
  add_library(phongpd::${component} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:phongpd_flags>)
  # When this folder and those below it have added their sources.
  cmake_language(EVAL CODE
                 "cmake_language(DEFER CALL phongpd_unite ${target} 10)")
endfunction()

# Compiles the target's sources in groups of about SIZE neighbours: an edit
# compiles one group anew.  Those that a folder has put into a UNITY_GROUP of its
# own, as it does with what is slow to parse, stay there; generated ones are
# data, and stay alone.
function(phongpd_unite target size)
  if(NOT PHONGPD_UNITY_BUILD)
    return()
  endif()
  # Headers are parsed so seldom that to precompile them takes longer.
  set_target_properties(
    ${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP
                         DISABLE_PRECOMPILE_HEADERS ON)
  # Of gcc: members of types that only this file knows are a fault in a header,
  # for which it takes a source that another one includes.
  target_compile_options(
    ${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  # Groups are large: a compiler that collects its own garbage less often takes a
  # fourteenth less time for a fourth more memory (2.2 GB at most).
  target_compile_options(
    ${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-expand=300 \
--param ggc-min-heapsize=1000000>")
  get_target_property(all ${target} SOURCES)
  set(sources "")
  foreach(source IN LISTS all)
    get_source_file_property(group ${source} TARGET_DIRECTORY ${target}
                             UNITY_GROUP)
    get_source_file_property(is_generated ${source} TARGET_DIRECTORY ${target}
                             GENERATED)
    get_source_file_property(is_single ${source} TARGET_DIRECTORY ${target}
                             SKIP_UNITY_BUILD_INCLUSION)
    if(source MATCHES "\\.cc$"
       AND NOT (group OR is_single OR is_generated))
      list(APPEND sources ${source})
    endif()
  endforeach()
  # Who builds some components alone edits none of them: what they share is
  # parsed as seldom as keeps two processors at work.
  if(PHONGPD_BUILD)
    math(EXPR size "4 * ${size}")
  endif()
  list(LENGTH sources count)
  math(EXPR groups "(${count} + ${size} - 1) / ${size}")
  set(number 0)
  foreach(source IN LISTS sources)
    math(EXPR group "${number} * ${groups} / ${count} + 1")
    set_source_files_properties(
      ${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
    math(EXPR number "${number} + 1")
  endforeach()
endfunction()

# Copies a public header to <build>/include/phongpd, where outsiders find it in
# the tree, and from where it is installed.  Sources include each other as
# "core/...", from the root of the tree; a project that has a file of that name
# must not meet it in ours, nor ours in its own, so there it is <phongpd/core/...>.
# An edit of it configures anew.  RESULT: the copy.
function(phongpd_public_header header result)
  cmake_path(ABSOLUTE_PATH header NORMALIZE)
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
             OUTPUT_VARIABLE name)
  set(copy ${PROJECT_BINARY_DIR}/include/phongpd/${name})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  file(READ ${header} text)
  string(REGEX REPLACE "(#include )\"([a-z]+/[^\"\n]*)\"" "\\1<phongpd/\\2>"
                       text "${text}")
  if(text MATCHES "#include \"[^\n]*")
    message(FATAL_ERROR "${name}: expected paths from the root of the tree, "
                        "found ${CMAKE_MATCH_0}")
  endif()
  set(before "")
  if(EXISTS ${copy})
    file(READ ${copy} before)
  endif()
  # As it was, it keeps its date, and nothing is compiled.
  if(NOT text STREQUAL before)
    file(WRITE ${copy} "${text}")
  endif()
  set(${result} ${copy} PARENT_SCOPE)
endfunction()

# Sources and public headers, relative to the folder that calls it: HEADERS users
# include by name, SUPPORT those include, and nobody else need know them.
function(phongpd_component_sources component)
  cmake_parse_arguments(PARSE_ARGV 1 files "" "" "SOURCES;HEADERS;SUPPORT")
  target_sources(phongpd_${component} PRIVATE ${files_SOURCES})
  set(copies "")
  foreach(header IN LISTS files_HEADERS files_SUPPORT)
    phongpd_public_header(${header} copy)
    list(APPEND copies ${copy})
  endforeach()
  target_sources(phongpd_${component} PUBLIC FILE_SET HEADERS BASE_DIRS
                 ${PROJECT_BINARY_DIR}/include FILES ${copies})
endfunction()

# Installs it as PhongPD<component>Targets, by which the package config knows
# that it is there.
function(phongpd_install_component component)
  if(NOT PHONGPD_INSTALL)
    return()
  endif()
  install(
    TARGETS phongpd_${component}
    EXPORT PhongPD${component}Targets
    ARCHIVE COMPONENT development
    LIBRARY COMPONENT development
    FILE_SET HEADERS
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    COMPONENT development)
  install(
    EXPORT PhongPD${component}Targets
    NAMESPACE phongpd::
    DESTINATION ${PHONGPD_PACKAGE_DIR}
    COMPONENT development)
endfunction()
