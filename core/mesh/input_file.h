// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace phongpd {

// The bytes of an input file, whole.  Every file that a person names is read
// by this function, so that all of them are refused alike:
//  - missing or unreadable files, directories, devices and sockets, at once;
//  - more than `max_bytes` bytes, before any is read where the size is known;
//  - a pipe that nobody has opened for writing within a second.
// A pipe with a writer, such as a shell's <(command), is read to its end
// however long its writer takes.  Links are followed.
//
// Throws InputError "PATH: expected KIND, found ...; how to mend it"; `kind`
// is, for example, "a mesh file".
std::string ReadInputFile(const std::string& path, const char* kind,
                          std::uintmax_t max_bytes);

}  // namespace phongpd
