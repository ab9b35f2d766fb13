// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

// A command of phongpd with all it reads, as one JSON document that repeats it
// elsewhere:
//
//   format       "phongpd reproduction 1"
//   arguments    as given, files by the names they have below
//   files        name, encoding (text or base64) and content of each input
//   versions     of PhongPD, its libraries and the compiler
//   environment  kind of machine, threads, which PHONGPD_* variables are set
//   run          null, or exit_code, signal, seconds, stdout and stderr
//
// No folder, user or host is named: inputs become inputs/N/FILE, outputs
// outputs/FILE, what does not exist missing/FILE.
namespace phongpd {

// What running it gave.
struct CommandOutcome {
  int exit_code = -1;  // −1: ended by `signal`
  int signal = 0;
  double seconds = 0.0;
  std::string out, err;
};

// Packs a command line without running it (`run` is null).  Inputs are the
// arguments that name regular files, and the meshes of those that are scene
// files; what follows --output, --report, --html, --svg, --glb, --png,
// --ompl-log and --meshes is an output.  Meshes that a scene names by an
// absolute path or with ".." are renamed in it.  Throws InputError for a file
// that cannot be read, and where they are more than 512 MiB together.
nlohmann::ordered_json PackCommand(const std::vector<std::string>& arguments);

// Checks a document and returns its arguments.  Throws InputError starting
// with `name`: another format, names that are not below the folder, arguments
// that are absolute paths or hold "..".
std::vector<std::string> PackedArguments(const nlohmann::ordered_json& document,
                                         const std::string& name);

// Writes its files below `folder`, which exists and is empty.  Throws like
// PackedArguments.
void UnpackCommand(const nlohmann::ordered_json& document,
                   const std::string& name, const std::string& folder);

// Runs this very program with `arguments` in `folder`, no input; what it says,
// and a cache of its own, go to the folder `scratch`.  Both are absolute paths.
// Throws InputError where it cannot be started.
CommandOutcome RunCommand(const std::vector<std::string>& arguments,
                          const std::string& folder,
                          const std::string& scratch);

}  // namespace phongpd
