# SPDX-License-Identifier: GPL-3.0-or-later
# debian/changelog.gz in the build tree: the newest part of CHANGELOG.md in
# Debian's form.
file(READ ${PROJECT_SOURCE_DIR}/CHANGELOG.md changes)
# What CMake's lists would split at.
string(REGEX REPLACE "[][;]" " " changes "${changes}")
string(REGEX REPLACE "^[^#]*# Changes\n+## [^\n]*\n" "" changes "${changes}")
string(REGEX REPLACE "\n## .*" "" changes "${changes}")
string(REGEX REPLACE "\n  +" "\n    " changes "\n${changes}")
string(REGEX REPLACE "\n- " "\n  * " changes "${changes}")
string(STRIP "${changes}" changes)
set(date "${PHONGPD_CHANGELOG_DATE}")
if(NOT date)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
set(folder ${PROJECT_BINARY_DIR}/debian)
file(
  WRITE ${folder}/changelog
  "phongpd (${PROJECT_VERSION}) unstable; urgency=medium\n\n  ${changes}\n\n \
-- ${PHONGPD_MAINTAINER}  ${date}\n")
execute_process(
  COMMAND gzip -9nc ${folder}/changelog
  OUTPUT_FILE ${folder}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
