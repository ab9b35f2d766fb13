# SPDX-License-Identifier: GPL-3.0-or-later
# phongpd_build_only(COMPONENT...) switches off whatever none of them stands on,
# tests, examples, benchmarks and the Python package among it.  Included before
# the options are declared, which leave variables as they find them.
set(PHONGPD_NEEDED_BY_core "")
set(PHONGPD_NEEDED_BY_approximations core)
set(PHONGPD_NEEDED_BY_constraints core)
set(PHONGPD_NEEDED_BY_oracle constraints)
set(PHONGPD_NEEDED_BY_planners constraints)
set(PHONGPD_NEEDED_BY_ipopt planners)
set(PHONGPD_NEEDED_BY_ompl planners)
set(PHONGPD_NEEDED_BY_solve approximations ipopt ompl)
set(PHONGPD_NEEDED_BY_shapes core)
set(PHONGPD_NEEDED_BY_problems approximations shapes planners)
set(PHONGPD_NEEDED_BY_studies problems oracle solve)
set(PHONGPD_NEEDED_BY_viewer problems solve)
set(PHONGPD_NEEDED_BY_program studies viewer assimp)
set(PHONGPD_NEEDED_BY_assimp problems)

macro(phongpd_build_only)
  set(needed ${ARGN})
  set(all
      core
      approximations
      constraints
      oracle
      planners
      ipopt
      ompl
      solve
      shapes
      problems
      assimp
      studies
      viewer
      program)
  set(rest ${needed})
  while(rest)
    list(POP_FRONT rest component)
    if(NOT component IN_LIST all)
      string(JOIN ", " names ${all})
      message(FATAL_ERROR "PHONGPD_BUILD: expected some of ${names}, found "
                          "'${component}'")
    endif()
    list(APPEND needed ${PHONGPD_NEEDED_BY_${component}})
    list(APPEND rest ${PHONGPD_NEEDED_BY_${component}})
  endwhile()
  foreach(component IN LISTS all)
    string(TOUPPER ${component} switch)
    if(component IN_LIST needed)
      set(PHONGPD_BUILD_${switch} ON)
    else()
      set(PHONGPD_BUILD_${switch} OFF)
    endif()
  endforeach()
  foreach(switch TESTS EXAMPLES RESULTS PYTHON)
    set(PHONGPD_BUILD_${switch} OFF)
  endforeach()
endmacro()
