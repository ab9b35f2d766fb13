# SPDX-License-Identifier: GPL-3.0-or-later
# After find_package(ompl): makes sure that the target ompl::ompl exists.
# OMPL 1.5 has variables only, and lists Boost libraries there that it may not
# bring along and that its users do not need.
if(NOT TARGET ompl::ompl)
  list(GET OMPL_LIBRARIES 0 _phongpd_ompl_library)
  list(GET OMPL_INCLUDE_DIRS 0 _phongpd_ompl_headers)
  add_library(ompl::ompl INTERFACE IMPORTED)
  set_target_properties(
    ompl::ompl
    PROPERTIES INTERFACE_LINK_LIBRARIES "${_phongpd_ompl_library}"
               INTERFACE_INCLUDE_DIRECTORIES "${_phongpd_ompl_headers}")
endif()
