# SPDX-License-Identifier: GPL-3.0-or-later
# Below PHONGPD_PYTHON_DIR: the module, and unless scikit-build-core makes a
# wheel, which brings them itself, the Python files and what tells pip and
# importlib.metadata that the package is there.
set(PHONGPD_PYTHON_DIR . CACHE STRING "Folder that Python imports from")
install(TARGETS phongpd_python
        LIBRARY DESTINATION ${PHONGPD_PYTHON_DIR}/phongpd COMPONENT python)
if(SKBUILD)
  return()
endif()
install(FILES ${python_files} DESTINATION ${PHONGPD_PYTHON_DIR}/phongpd
        COMPONENT python)
set(info phongpd-${PROJECT_VERSION}.dist-info)
file(
  WRITE ${CMAKE_CURRENT_BINARY_DIR}/${info}/METADATA
  "Metadata-Version: 2.1\nName: phongpd\nVersion: ${PROJECT_VERSION}\n\
Summary: ${PROJECT_DESCRIPTION}\nLicense: GPL-3.0-or-later\n\
Requires-Dist: numpy>=1.22\n")
install(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${info}
        DESTINATION ${PHONGPD_PYTHON_DIR} COMPONENT python)
