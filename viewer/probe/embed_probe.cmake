# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D WASM=probe.wasm -D OUTPUT=probe_module.cc -P embed_probe.cmake: a
# source of the module's bytes.  Without WASM there are none.
cmake_minimum_required(VERSION 3.23)

set(bytes "")
if(WASM)
  file(READ ${WASM} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
endif()
file(
  WRITE ${OUTPUT}
  "// Made by embed_probe.cmake.\n"
  "#include \"viewer/probe/probe_module.h\"\n\n"
  "namespace phongpd::internal {\nnamespace {\n\n"
  "constexpr unsigned char kModule[] = {${bytes}0};\n\n}  // namespace\n\n"
  "std::string_view ProbeModule() {\n"
  "  return {reinterpret_cast<const char*>(kModule), sizeof kModule - 1};\n}\n\n"
  "}  // namespace phongpd::internal\n")
