// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "problems/cli/command_tree.h"

// What a shell is told of the program: commands, flags, choices, and where
// files, folders or `families` (names of scenes) go.
namespace phongpd::cli {

std::string BashCompletion(const CommandNode& program,
                           const std::vector<std::string>& families);
std::string ZshCompletion(const CommandNode& program,
                          const std::vector<std::string>& families);
std::string FishCompletion(const CommandNode& program,
                           const std::vector<std::string>& families);

// The first line of a help text, cut after `length` characters at a word's end:
// shells show one line beside a name.
std::string Shortened(const std::string& help, std::size_t length = 60);

}  // namespace phongpd::cli
