// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "problems/cli/command_tree.h"

namespace phongpd::cli {

// The manual page phongpd(1), in roff's man macros: what --help says of every
// command, in one place.  Plain ASCII, the same for the same tree and version.
std::string ManualPage(const CommandNode& program, const std::string& version);

// `text` so that roff prints it as it stands: its escapes, its control
// characters at a line's beginning, and what is no ASCII (UTF-8) spelt out.
std::string RoffEscaped(const std::string& text);

}  // namespace phongpd::cli
