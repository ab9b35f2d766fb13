# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages by CPack, as scripts/deb.sh asks for them: libphongpd-dev,
# phongpd and python3-phongpd, one for each component of the installation.
# Libraries are static: nothing but headers and archives goes into the first, and
# the others need none of it.
set(PHONGPD_MAINTAINER "The authors of PhongPD <phongpd@phongpd.invalid>"
    CACHE STRING "Who makes the packages, and how to reach them")
set(PHONGPD_CHANGELOG_DATE "" CACHE STRING "Of the packages, as RFC 5322 has it")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME phongpd)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${PHONGPD_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL development program python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# What Debian asks for, and what it refers to.
set(date "${PHONGPD_CHANGELOG_DATE}")
if(NOT date)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
set(folder ${PROJECT_BINARY_DIR}/debian)
file(
  WRITE ${folder}/changelog
  "phongpd (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * What changed is \
told in CHANGELOG.md.gz beside this file.\n\n -- ${PHONGPD_MAINTAINER}  ${date}\n")
configure_file(CHANGELOG.md ${folder}/CHANGELOG.md COPYONLY)
set(changelogs "")
foreach(file changelog CHANGELOG.md)
  execute_process(COMMAND gzip -9nc ${folder}/${file}
                  OUTPUT_FILE ${folder}/${file}.gz COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND changelogs ${folder}/${file}.gz)
endforeach()

set(about
    "Penetration depth of triangle meshes whose direction turns continuously,\n\
on exact contact spaces; trajectories by Ipopt, planners for OMPL, and a\n\
complete planner that proves where no path exists.\n")
function(phongpd_deb component package section summary text)
  string(TOUPPER ${component} name)
  string(JOIN "\n" description "${summary}" "${about}.\n${text}")
  foreach(field IN ITEMS PACKAGE_NAME=${package} PACKAGE_SECTION=${section})
    string(REPLACE "=" ";" field "${field}")
    list(GET field 0 key)
    list(GET field 1 value)
    set(CPACK_DEBIAN_${name}_${key} ${value} PARENT_SCOPE)
  endforeach()
  set(CPACK_DEBIAN_${name}_DESCRIPTION "${description}" PARENT_SCOPE)

  # What every package of Debian's carries.
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES packaging/debian/copyright DESTINATION ${folder}
          COMPONENT ${component})
  install(FILES ${changelogs} DESTINATION ${folder} COMPONENT ${component})
endfunction()

phongpd_deb(
  development libphongpd-dev libdevel
  "exact contact spaces and continuous penetration depth (development)"
  "This package holds the headers, the static libraries and their CMake package.")
phongpd_deb(
  program phongpd science
  "exact contact spaces and continuous penetration depth (program)"
  "This package holds the command line.")
phongpd_deb(
  python python3-phongpd python
  "exact contact spaces and continuous penetration depth (Python 3)"
  "This package holds the module for Python 3.")

# Headers tell no dependencies: those of core and the components that need no
# more; find_package names what a further component misses.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libcgal-dev (>= 5.5), libeigen3-dev (>= 3.4), libtbb-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "coinor-libipopt-dev, libassimp-dev, libblas-dev, \
libboost-filesystem-dev, libboost-serialization-dev, libcli11-dev, \
libfcl-dev, liblapack-dev, libompl-dev, libtinyxml2-dev, \
nlohmann-json3-dev, pkg-config, zlib1g-dev")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "chromium, xdg-utils")
# The module is made for one version of Python.
if(PHONGPD_HAS_PYTHON)
  execute_process(
    COMMAND
      ${PHONGPD_PYTHON} -c
      "import sys; a, b = sys.version_info[:2]; print(a, b, b + 1)"
    OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "([0-9]+) ([0-9]+) ([0-9]+)\n"
                       "python3 (>= \\1.\\2), python3 (<< \\1.\\3)" version
                       "${version}")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${version}, python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/packaging/debian/postinst
    ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)

install(
  DIRECTORY examples/
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libphongpd-dev/examples
  COMPONENT development
  FILES_MATCHING
  PATTERN "*.cc"
  PATTERN "*.off"
  PATTERN "*.json"
  PATTERN "README.md")
install(FILES packaging/examples/CMakeLists.txt
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libphongpd-dev/examples
        COMPONENT development)

include(CPack)
