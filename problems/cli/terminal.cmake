# SPDX-License-Identifier: GPL-3.0-or-later
# The manual page and the completions, which the program writes itself, and where
# man and the shells look for them.
set(PHONGPD_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
    CACHE STRING "Where zsh finds completions")
set(PHONGPD_FISH_DIR ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    CACHE STRING "Where fish finds completions")

if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(STATUS "Not built, the program does not run here: manual page and "
                 "completions")
  return()
endif()

set(terminal ${PROJECT_BINARY_DIR}/terminal)
file(MAKE_DIRECTORY ${terminal})
set(terminal_files "")
# Writes FILE by the program and installs it into FOLDER.
function(phongpd_terminal_file file folder)
  add_custom_command(
    OUTPUT ${terminal}/${file}
    COMMAND phongpd ${ARGN} > ${terminal}/${file}
    DEPENDS phongpd
    VERBATIM)
  if(PHONGPD_GZIP AND file MATCHES "[.]1$")
    # As man keeps its pages.
    add_custom_command(
      OUTPUT ${terminal}/${file}.gz
      COMMAND ${PHONGPD_GZIP} -9nc ${terminal}/${file} > ${terminal}/${file}.gz
      DEPENDS ${terminal}/${file}
      VERBATIM)
    string(APPEND file .gz)
  endif()
  set(terminal_files ${terminal_files} ${terminal}/${file} PARENT_SCOPE)
  if(PHONGPD_INSTALL)
    install(FILES ${terminal}/${file} DESTINATION ${folder} COMPONENT program)
  endif()
endfunction()

find_program(PHONGPD_GZIP gzip)
phongpd_terminal_file(phongpd.1 ${CMAKE_INSTALL_MANDIR}/man1 man)
phongpd_terminal_file(
  phongpd ${CMAKE_INSTALL_DATADIR}/bash-completion/completions completion bash)
phongpd_terminal_file(_phongpd ${PHONGPD_ZSH_DIR} completion zsh)
phongpd_terminal_file(phongpd.fish ${PHONGPD_FISH_DIR} completion fish)
add_custom_target(phongpd_terminal ALL DEPENDS ${terminal_files})
