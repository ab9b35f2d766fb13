// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace phongpd {
namespace {

// Damerau-Levenshtein, each pair of neighbours swapped at most once.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<std::size_t>> d(n + 1,
                                          std::vector<std::size_t>(m + 1));
  for (std::size_t i = 0; i <= n; ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= m; ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= n; ++i) {
    for (std::size_t j = 1; j <= m; ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min(
          {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[n][m];
}

std::string Letters(const std::string& name) {
  std::string letters;
  for (const char c : name) {
    if (c == '-' || c == '_' || c == ' ') continue;
    letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return letters;
}

// The only name that begins with the letters; empty for none and for several.
std::string OnlyBeginning(const std::string& letters,
                          const std::vector<std::string>& names) {
  constexpr std::size_t kShortest = 3;  // fewer begin too much by chance
  std::string only;
  if (letters.size() < kShortest) return only;
  for (const std::string& name : names) {
    if (Letters(name).compare(0, letters.size(), letters) != 0) continue;
    if (!only.empty() && name != only) return "";
    only = name;
  }
  return only;
}

}  // namespace

std::string DidYouMean(const std::string& word,
                       const std::vector<std::string>& names) {
  // Nobody mistypes a name of hundreds of letters.
  constexpr std::size_t kLongest = 64;
  if (word.size() > kLongest) return "";
  const std::string letters = Letters(word);
  std::size_t least = letters.size() / 3 + 1;
  std::string nearest;
  for (const std::string& name : names) {
    const std::string other = Letters(name);
    const std::size_t distance = EditDistance(letters, other);
    const std::size_t longer = std::max(letters.size(), other.size());
    if (distance >= least || (distance > 1 && 4 * distance > longer)) continue;
    least = distance;
    nearest = name;
  }
  if (nearest.empty()) nearest = OnlyBeginning(letters, names);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace phongpd
