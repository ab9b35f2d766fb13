// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "problems/cli/command_tree.h"

// What a shell may offer where a word of a command is being typed: commands,
// flags, choices, names of scenes.
namespace phongpd::cli {

struct Offer {
  std::string word;
  std::string help;  // one line; empty: none
};

struct Offers {
  std::vector<Offer> words;
  // kFile, kFolder: such names are right as well, which shells know themselves.
  ValueKind names = ValueKind::kNone;
};

// `words` follow the program's name; the last one is being typed, perhaps still
// empty.  Offers are all that may stand there, whatever it begins with, but
// flags where it begins with '-' and nothing else there.  --flag=value is one
// word, or three, as bash has it.  `families` are names of scenes.
Offers OffersFor(const CommandNode& program,
                 const std::vector<std::string>& families,
                 const std::vector<std::string>& words);

}  // namespace phongpd::cli
