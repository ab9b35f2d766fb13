# SPDX-License-Identifier: GPL-3.0-or-later
# The tests that Python runs: with the interpreter alone, and with the package.
# Included by CMakeLists.txt, where the program is built.

# Pages in a real browser, where there is one.
find_package(Python3 3.8 QUIET COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
  add_test(
    NAME ViewerInBrowser
    COMMAND
      ${Python3_EXECUTABLE}
      ${CMAKE_CURRENT_SOURCE_DIR}/viewer/viewer_browser_test.py
      $<TARGET_FILE:phongpd> ${PROJECT_BINARY_DIR}/tests/viewer)
  add_test(
    NAME ViewerServedInBrowser
    COMMAND
      ${Python3_EXECUTABLE}
      ${CMAKE_CURRENT_SOURCE_DIR}/viewer/viewer_browser_test.py
      $<TARGET_FILE:phongpd> ${PROJECT_BINARY_DIR}/tests/viewer_served --served)
  # They take longest, so they begin first.
  set_tests_properties(
    ViewerInBrowser ViewerServedInBrowser
    PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1800 COST 1000)
  add_test(
    NAME ViewServed
    COMMAND
      ${Python3_EXECUTABLE} -B
      ${CMAKE_CURRENT_SOURCE_DIR}/viewer/view_serve_test.py
      $<TARGET_FILE:phongpd> ${PROJECT_BINARY_DIR}/tests/served)
  set_tests_properties(ViewServed PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
  add_test(
    NAME ViewServedKinds
    COMMAND
      ${Python3_EXECUTABLE} -B
      ${CMAKE_CURRENT_SOURCE_DIR}/viewer/view_serve_kinds_test.py
      $<TARGET_FILE:phongpd> ${PROJECT_BINARY_DIR}/tests/served_kinds)
  set_tests_properties(ViewServedKinds PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT
                                                  600)
  add_test(
    NAME MetricColors
    COMMAND
      ${Python3_EXECUTABLE} -B
      ${CMAKE_CURRENT_SOURCE_DIR}/viewer/metric_colors_test.py
      ${PROJECT_SOURCE_DIR})
  add_test(
    NAME CheckTrajectory
    COMMAND
      ${Python3_EXECUTABLE} -B
      ${CMAKE_CURRENT_SOURCE_DIR}/examples/check_trajectory_test.py
      $<TARGET_FILE:phongpd> ${PROJECT_SOURCE_DIR}/examples/check_trajectory.py
      ${PROJECT_BINARY_DIR}/tests/check_trajectory)
  set_tests_properties(
    CheckTrajectory
    PROPERTIES TIMEOUT 300 ENVIRONMENT
               PHONGPD_CACHE_DIR=${PROJECT_BINARY_DIR}/tests/cache)
  add_test(
    NAME Links
    COMMAND ${Python3_EXECUTABLE}
            ${CMAKE_CURRENT_SOURCE_DIR}/packaging/links_test.py
            ${PROJECT_SOURCE_DIR}/scripts/links.py)
  add_test(NAME LinksOfPages
           COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/links.py
                   --markdown ${PROJECT_SOURCE_DIR})
  if(PHONGPD_HAS_RESULTS)
    add_test(NAME RigidBenchmark
             COMMAND ${Python3_EXECUTABLE} -B
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/rigid_report_test.py)
    add_test(
      NAME RigidOptimizeReport
      COMMAND ${Python3_EXECUTABLE} -B
              ${CMAKE_CURRENT_SOURCE_DIR}/results/rigid_optimize_report_test.py)
    add_test(NAME WrenchReport
             COMMAND ${Python3_EXECUTABLE} -B
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/wrench_report_test.py)
    add_test(
      NAME Claims
      COMMAND ${Python3_EXECUTABLE} -B
              ${CMAKE_CURRENT_SOURCE_DIR}/results/claims_test.py
              $<TARGET_FILE:phongpd>)
    add_test(NAME Reports
             COMMAND ${Python3_EXECUTABLE} -B
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/reports_test.py)
  endif()
  # The C++ of README and docs, for scripts/readme.sh.
  file(GLOB documents RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/docs/*.md)
  list(PREPEND documents README.md python/README.md core/README.md)
  list(TRANSFORM documents PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE
                                                          inputs)
  set(script ${PROJECT_SOURCE_DIR}/scripts/doc_blocks.py)
  add_custom_command(
    OUTPUT documented_cpp.cc
    COMMAND ${Python3_EXECUTABLE} ${script} cpp
            ${CMAKE_CURRENT_BINARY_DIR}/documented_cpp.cc ${documents}
    DEPENDS ${inputs} ${script}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    VERBATIM)
  add_executable(documented_cpp EXCLUDE_FROM_ALL
                                ${CMAKE_CURRENT_BINARY_DIR}/documented_cpp.cc)
  set_target_properties(
    documented_cpp PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(documented_cpp PRIVATE phongpd::problems phongpd::solve)
  add_test(
    NAME DemoSentences
    COMMAND ${Python3_EXECUTABLE}
            ${CMAKE_CURRENT_SOURCE_DIR}/packaging/demo_sentences_test.py
            ${PROJECT_SOURCE_DIR}/scripts/demo_sentences.py)
  add_test(
    NAME EigenModules
    COMMAND
      ${Python3_EXECUTABLE}
      ${CMAKE_CURRENT_SOURCE_DIR}/packaging/eigen_modules_test.py
      ${PROJECT_SOURCE_DIR})
  add_test(
    NAME OptionFields
    COMMAND
      ${Python3_EXECUTABLE}
      ${CMAKE_CURRENT_SOURCE_DIR}/packaging/option_fields_test.py
      ${PROJECT_SOURCE_DIR})
  add_test(
    NAME UserHeaders
    COMMAND
      ${Python3_EXECUTABLE}
      ${CMAKE_CURRENT_SOURCE_DIR}/packaging/user_headers_test.py
      ${PROJECT_SOURCE_DIR})
  add_test(
    NAME CoreScript
    COMMAND
      ${Python3_EXECUTABLE}
      ${CMAKE_CURRENT_SOURCE_DIR}/packaging/core_script_test.py
      ${PROJECT_SOURCE_DIR})
else()
  message(STATUS "Not tested for want of the package python3: pages in a "
                 "browser, the checks of links, figures and option fields")
endif()

if(PHONGPD_HAS_PYTHON)
  # Sweeps on a cluster start and kill processes, and wait for them: a test of
  # their own, beside which others can run.
  set(python_tests ${PHONGPD_PYTHON} -m pytest -q -p no:cacheprovider
                   ${CMAKE_CURRENT_SOURCE_DIR}/python)
  add_test(NAME Python COMMAND ${python_tests} -k "not test_cluster")
  add_test(NAME PythonCluster COMMAND ${python_tests} -k test_cluster)
  set_tests_properties(
    Python PythonCluster
    PROPERTIES
      TIMEOUT 900
      ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PHONGPD_PROGRAM=$<TARGET_FILE:phongpd>;PYTHONDONTWRITEBYTECODE=1;PHONGPD_CACHE_DIR=${PROJECT_BINARY_DIR}/tests/cache"
  )
  if(PHONGPD_HAS_RESULTS)
    add_test(NAME DirectionStudy
             COMMAND ${PHONGPD_PYTHON} -B -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/study_test.py)
    add_test(NAME StudyModels
             COMMAND ${PHONGPD_PYTHON} -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/study_models_test.py)
    add_test(NAME StudyPower
             COMMAND ${PHONGPD_PYTHON} -B -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/study_power_test.py)
    add_test(NAME StudySlice
             COMMAND ${PHONGPD_PYTHON} -B -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/study_slice_test.py)
    add_test(NAME StudySolvers
             COMMAND ${PHONGPD_PYTHON} -B -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/study_solvers_test.py)
    add_test(NAME StudyTimes
             COMMAND ${PHONGPD_PYTHON} -B -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/study_times_test.py)
    add_test(NAME TrajectoriesBenchmark
             COMMAND ${PHONGPD_PYTHON} -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/trajectories_test.py)
    add_test(NAME ReportStatistics
             COMMAND ${PHONGPD_PYTHON} -B -m pytest -q -p no:cacheprovider
                     ${CMAKE_CURRENT_SOURCE_DIR}/results/statistics_test.py)
    set_tests_properties(
      StudyModels StudySlice StudySolvers StudyTimes TrajectoriesBenchmark
      PROPERTIES
        TIMEOUT 300
        ENVIRONMENT
        "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;PHONGPD_CACHE_DIR=${PROJECT_BINARY_DIR}/tests/cache"
    )
  endif()
  # Executed notebooks, and the pictures in them, stay in build/notebooks.
  add_test(
    NAME Notebooks
    COMMAND ${PHONGPD_PYTHON} -m pytest -q -p no:cacheprovider
            ${CMAKE_CURRENT_SOURCE_DIR}/notebooks)
  set_tests_properties(
    Notebooks
    PROPERTIES
      TIMEOUT 600
      ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;PHONGPD_CACHE_DIR=${PROJECT_BINARY_DIR}/tests/cache;PHONGPD_NOTEBOOKS=${PROJECT_BINARY_DIR}/notebooks"
  )
  add_test(
    NAME PythonTypes
    COMMAND ${PHONGPD_PYTHON} -m mypy --cache-dir
            ${PROJECT_BINARY_DIR}/mypy
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endif()
