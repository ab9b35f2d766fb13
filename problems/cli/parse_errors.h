// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

// What is wrong with a command line, in the words of all other errors:
// expected, found, and the nearest name there is.
namespace phongpd::cli {

// Throws InputError for commands and flags that there are none of: said before
// what is missing.  `arguments` are in reverse.
void RefuseUnknownNames(const CLI::App& app,
                        const std::vector<std::string>& arguments);

// Of what CLI11 found in those arguments; one line.
std::string Explained(const CLI::ParseError& error, const CLI::App& app,
                      const std::vector<std::string>& arguments);

}  // namespace phongpd::cli
