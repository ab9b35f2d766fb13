# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D THREE=three.min.js -D FOLDER=... -D OUTPUT=page_template.cc -P
# embed_page.cmake: makes one page of the files in FOLDER and three.js, and a
# source of it.  Without THREE the page is empty.
cmake_minimum_required(VERSION 3.23)

set(page "")
if(THREE)
  file(READ ${FOLDER}/viewer.html page)
  foreach(
    part IN
    ITEMS viewer.css
          dom.js
          colors.js
          geometry.js
          orbit.js
          solids.js
          overlays.js
          iterates.js
          crew.js
          stage.js
          framing.js
          dress.js
          page_module.js
          probe.js
          probe_panel.js
          color_key.js
          task_drag.js
          task_turn.js
          task_answer.js
          solver.js
          task_panel.js
          section_map.js
          surface_map.js
          chart.js
          embedded.js
          keys.js
          panel.js
          viewer.js
          draw.js
          start.js)
    file(READ ${FOLDER}/${part} content)
    string(REPLACE "@${part}@" "${content}" page "${page}")
  endforeach()
  file(READ ${THREE} content)
  # A closing tag in a string of it would end the element.
  string(REPLACE "</script" "<\\/script" content "${content}")
  string(REPLACE "@three.js@" "${content}" page "${page}")
endif()
file(WRITE ${OUTPUT}.html "${page}")
file(READ ${OUTPUT}.html bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file(
  WRITE ${OUTPUT}
  "// Made by embed_page.cmake.\n"
  "#include \"viewer/page_template.h\"\n\n"
  "namespace phongpd::internal {\nnamespace {\n\n"
  "constexpr unsigned char kPage[] = {${bytes}0};\n\n}  // namespace\n\n"
  "std::string_view PageTemplate() {\n"
  "  return {reinterpret_cast<const char*>(kPage), sizeof kPage - 1};\n}\n\n"
  "}  // namespace phongpd::internal\n")
