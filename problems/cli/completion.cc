// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/completion.h"

#include <algorithm>

namespace phongpd::cli {
namespace {

// The first line of a help text, cut at a word's end: shells show one line
// beside a name.
std::string Shortened(const std::string& help) {
  constexpr std::size_t kLength = 60;
  std::string line = help.substr(0, help.find('\n'));
  if (line.size() <= kLength) return line;
  const std::size_t end = line.rfind(' ', kLength);
  line.resize(end == std::string::npos ? kLength : end);
  while (!line.empty() &&
         std::string(" ,;:.(").find(line.back()) != std::string::npos) {
    line.pop_back();
  }
  return line + " ...";
}

// The word that is being typed, and what decides what it may be.
struct Place {
  const CommandNode* command = nullptr;
  std::string word;
  std::string before;  // the flag whose value it is, if it is one
  std::string head;    // "--flag=", which the word begins with
  bool is_after_dashes = false;
};

Place PlaceOf(const CommandNode& program,
              const std::vector<std::string>& words) {
  Place place;
  place.command = &program;
  const std::size_t count = words.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    place.is_after_dashes = place.is_after_dashes || words[i] == "--";
    for (const CommandNode& below : place.command->commands) {
      if (below.path.back() != words[i]) continue;
      place.command = &below;
      break;
    }
  }
  if (count > 0) place.word = words[count - 1];
  if (count > 1) place.before = words[count - 2];
  const std::size_t equals = place.word.find('=');
  if (place.word == "=") {
    place.word.clear();
  } else if (place.before == "=" && count > 2) {
    place.before = words[count - 3];
  } else if (place.word.compare(0, 2, "--") == 0 &&
             equals != std::string::npos) {
    place.before = place.word.substr(0, equals);
    place.head = place.word.substr(0, equals + 1);
  }
  return place;
}

void OfferValues(const Argument& argument,
                 const std::vector<std::string>& families,
                 const std::string& head, Offers* offers) {
  const bool is_scene = argument.kind == ValueKind::kScene;
  for (const std::string& value : is_scene ? families : argument.choices) {
    offers->words.push_back({head + value, ""});
  }
  if (is_scene || argument.kind == ValueKind::kFile) {
    offers->names = ValueKind::kFile;
  } else if (argument.kind == ValueKind::kFolder &&
             offers->names == ValueKind::kNone) {
    offers->names = ValueKind::kFolder;
  }
}

void OfferFlags(const CommandNode& command, Offers* offers) {
  for (const Argument& flag : command.flags) {
    for (const std::string& name : flag.names) {
      offers->words.push_back({name, Shortened(flag.help)});
    }
  }
}

}  // namespace

Offers OffersFor(const CommandNode& program,
                 const std::vector<std::string>& families,
                 const std::vector<std::string>& words) {
  const Place place = PlaceOf(program, words);
  const CommandNode& command = *place.command;
  Offers offers;
  if (place.is_after_dashes) {
    offers.names = ValueKind::kFile;
    return offers;
  }
  for (const Argument& flag : command.flags) {
    if (flag.kind == ValueKind::kNone ||
        std::find(flag.names.begin(), flag.names.end(), place.before) ==
            flag.names.end()) {
      continue;
    }
    OfferValues(flag, families, place.head, &offers);
    return offers;
  }
  if (!place.head.empty()) return offers;
  if (place.word.compare(0, 1, "-") != 0) {
    for (const CommandNode& below : command.commands) {
      offers.words.push_back({below.path.back(), Shortened(below.summary)});
    }
    for (const Argument& argument : command.positionals) {
      OfferValues(argument, families, "", &offers);
    }
    if (!offers.words.empty() || offers.names != ValueKind::kNone) {
      return offers;
    }
  }
  OfferFlags(command, &offers);
  return offers;
}

}  // namespace phongpd::cli
