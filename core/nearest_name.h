// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// "; did you mean NAME?" with the name that takes the fewest insertions,
// removals, changes and swaps of neighbours (the first of several), if these
// are at most a third of the word, and where they are several a quarter of the
// longer one (strait: straight, but not palace: plate); else with the only name
// that begins with the word, of three letters or more (out: output); else
// empty.  Capitals and what stands between words count for nothing: RRTConnect
// is rrt-connect.
std::string DidYouMean(const std::string& word,
                       const std::vector<std::string>& names);

}  // namespace phongpd
