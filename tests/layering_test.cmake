# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D SOURCE=... -P layering_test.cmake: who may include whom.
#   files <- core <- constraints <- planners <- problems <- tests, results,
#     examples
#   core <- problems/shapes
#   problems/{scenes, output} <- viewer <- problems/cli
#   core <- constraints/oracle <- problems/studies
#   core: mesh <- bvh <- solid <- bounds <- minkowski <- contact
#     <- projection
#   core/minkowski: operands <- convolution <- arrangement <- cells <- windows
cmake_minimum_required(VERSION 3.23)

set(failures "")

# Complains about every file of `folder` that includes something matching
# `forbidden`.
function(forbid folder forbidden)
  file(GLOB_RECURSE files ${SOURCE}/${folder}/*.h ${SOURCE}/${folder}/*.cc)
  if(NOT files AND NOT folder MATCHES "^planners")
    message(FATAL_ERROR "no sources in ${folder}: is the list out of date?")
  endif()
  foreach(file IN LISTS files)
    file(STRINGS ${file} includes REGEX "^ *# *include")
    foreach(line IN LISTS includes)
      if(line MATCHES "[\"<](phongpd/)?(${forbidden})")
        list(APPEND failures "${file}: ${line}")
      endif()
    endforeach()
  endforeach()
  set(failures ${failures} PARENT_SCOPE)
endfunction()

forbid(files "(core|constraints|planners|problems|viewer|tests|results)/")
forbid(files "(CGAL|Eigen|boost|tbb|oneapi|fcl|ompl|CLI|nlohmann|coin)/")
forbid(core "(constraints|planners|problems|viewer|tests|results)/")
forbid(core "(fcl|ompl|CLI|nlohmann|coin)/|Ip[A-Z]")
set(floors mesh bvh solid bounds minkowski contact projection)
while(floors)
  list(POP_FRONT floors floor)
  list(JOIN floors "|" above)
  if(above)
    forbid(core/${floor} "core/(${above})/")
  endif()
endwhile()
set(stages operands convolution arrangement cells windows)
while(stages)
  list(POP_FRONT stages stage)
  list(JOIN stages "|" later)
  if(later)
    forbid(core/minkowski/${stage} "core/minkowski/(${later})/")
  endif()
endwhile()
forbid(constraints "(planners|problems|viewer|tests|results)/")
forbid(constraints/oracle "constraints/[a-z_]+\\.h")
# Planners and worlds, and who wants only these, do without FCL.
forbid(planners "constraints/oracle/")
foreach(folder meshes output scenes shapes)
  forbid(problems/${folder} "constraints/oracle/")
endforeach()
forbid(planners "(problems|viewer|tests|results)/")
forbid(problems/shapes "(constraints|planners)/|problems/[^s]|nlohmann/")
forbid(problems/shapes "problems/s[^h]")
foreach(folder meshes output scenes shapes studies)
  forbid(problems/${folder} "(viewer|problems/cli)/")
endforeach()
forbid(problems "(tests|results|examples)/")
forbid(viewer "(constraints/oracle|tests|results|examples)/")
forbid(viewer "problems/(cli|meshes|shapes|studies)/")
forbid(examples "(tests|results)/")

# Worlds are what planners plan in; each kind of planner is by itself, and solve
# is the door to all of them.
forbid(planners/world "planners/(exact|retraction|trajectory|ompl|solve)/")
forbid(planners/exact "planners/(retraction|trajectory|ompl|solve)/")
forbid(planners/retraction "planners/(trajectory|ompl|solve)/")
forbid(planners/rigid "planners/(ompl|solve)/")
forbid(planners/trajectory "planners/(retraction|ompl|solve)/")
forbid(planners/ompl "planners/(trajectory|solve)/")

# Heavy libraries stay out of what users include.
file(STRINGS ${SOURCE}/core/CMakeLists.txt public REGEX "^    [a-z_/]+\\.h")
if(NOT public)
  message(FATAL_ERROR "core/CMakeLists.txt lists no public header")
endif()
foreach(header IN LISTS public)
  string(REGEX REPLACE "[ )]" "" header ${header})
  file(STRINGS ${SOURCE}/core/${header} includes REGEX "^ *# *include")
  foreach(line IN LISTS includes)
    if(line MATCHES "<(CGAL|boost|tbb|oneapi)/")
      list(APPEND failures "core/${header}: ${line}")
    endif()
    if(line MATCHES "\"(core/([^\"]+))\"")
      set(included "${CMAKE_MATCH_2}")
      if(NOT "${public}" MATCHES "${included}")
        list(APPEND failures
             "core/${header} is public and includes the internal ${included}")
      endif()
    endif()
  endforeach()
endforeach()

# Worlds know nothing of files and flags, and what is installed of them nothing
# of how they find what they say.
forbid(planners/world "(nlohmann|CLI)/")
foreach(name diagnosis length preset world)
  file(STRINGS ${SOURCE}/planners/world/${name}.h includes
       REGEX "planners/world/(depth|obstacle)")
  if(includes)
    list(APPEND failures "${name}.h is installed without: ${includes}")
  endif()
endforeach()

# One file knows FCL; anybody may ask for its version.
file(GLOB_RECURSE files ${SOURCE}/constraints/* ${SOURCE}/problems/*
     ${SOURCE}/viewer/* ${SOURCE}/tests/*.cc ${SOURCE}/results/*.cc)
foreach(file IN LISTS files)
  if(NOT file MATCHES "\\.(h|cc)$" OR file MATCHES "/fcl_surfaces\\.cc$")
    continue()
  endif()
  file(STRINGS ${file} includes REGEX "^ *# *include <fcl/")
  list(REMOVE_ITEM includes "#include <fcl/config.h>")
  if(includes)
    list(APPEND failures "${file}: ${includes}")
  endif()
endforeach()

# Sources below `folders` other than those that match `knowers` must not include
# headers that match `pattern`.
function(known_to knowers pattern folders)
  list(TRANSFORM folders REPLACE "(.+)" "${SOURCE}/\\1/*.h;${SOURCE}/\\1/*.cc")
  file(GLOB_RECURSE files ${folders})
  list(FILTER files EXCLUDE REGEX ${knowers})
  foreach(file IN LISTS files)
    file(STRINGS ${file} includes REGEX "^ *# *include <${pattern}")
    if(includes)
      list(APPEND failures "${file}: ${includes}")
    endif()
  endforeach()
  set(failures ${failures} PARENT_SCOPE)
endfunction()

# What Assimp reads it reads in another process.
known_to("/assimp_mesh[.]cc$" "assimp/" "problems;viewer;tests;results")
# The options' test asks Ipopt itself which there are.
known_to("ipopt_(solve|options|options_test)[.]cc$" "Ip[A-Z]"
         "constraints;planners;problems;viewer;tests;results")
# OMPL belongs to planners/ompl; programs that measure may use it too.
foreach(folder constraints planners/world planners/exact planners/retraction
        planners/trajectory problems viewer)
  forbid(${folder} "ompl/")
endforeach()
file(STRINGS ${SOURCE}/planners/ompl/ompl_planning.h includes
     REGEX "include <ompl/")
if(includes)
  list(APPEND failures "ompl_planning.h promises no type of OMPL: ${includes}")
endif()

# Examples include what any other project can.
file(GLOB files ${SOURCE}/examples/*.cc)
foreach(file IN LISTS files)
  file(STRINGS ${file} includes REGEX "^ *# *include \"")
  if(includes)
    list(APPEND failures "${file}: ${includes}")
  endif()
endforeach()

# Every source names its licence.
foreach(folder files core constraints planners problems viewer tests results
        examples)
  file(GLOB_RECURSE files ${SOURCE}/${folder}/*.h ${SOURCE}/${folder}/*.cc)
  foreach(file IN LISTS files)
    file(STRINGS ${file} first LIMIT_COUNT 1)
    if(NOT first MATCHES "SPDX-License-Identifier: GPL-3.0-or-later")
      list(APPEND failures "${file}: the first line names no licence")
    endif()
  endforeach()
endforeach()

if(failures)
  list(JOIN failures "\n  " text)
  message(FATAL_ERROR "layering is broken:\n  ${text}")
endif()
