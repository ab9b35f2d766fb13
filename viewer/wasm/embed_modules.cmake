# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D PROBE=probe.wasm -D SOLVER=solver.wasm -D OUTPUT=page_modules.cc -P
# embed_modules.cmake: a source of the modules' bytes.  Of one that is not given
# there are none.
cmake_minimum_required(VERSION 3.23)

file(WRITE ${OUTPUT} "// Made by embed_modules.cmake.\n"
                     "#include \"viewer/wasm/page_modules.h\"\n\n"
                     "namespace phongpd::internal {\n")
foreach(module IN ITEMS Probe Solver)
  string(TOUPPER ${module} name)
  set(bytes "")
  if(${name})
    file(READ ${${name}} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  endif()
  file(
    APPEND ${OUTPUT}
    "namespace {\nconstexpr unsigned char k${module}[] = {${bytes}0};\n}\n"
    "std::string_view ${module}Module() {\n"
    "  return {reinterpret_cast<const char*>(k${module}), sizeof k${module} - 1};\n"
    "}\n")
endforeach()
file(APPEND ${OUTPUT} "}  // namespace phongpd::internal\n")
