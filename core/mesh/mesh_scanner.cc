// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_scanner.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "core/mesh/mesh_error.h"

namespace phongpd::internal {
namespace {

bool IsBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// from_chars knows no plus.
std::string_view WithoutPlus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return word.substr(has_plus ? 1 : 0);
}

}  // namespace

std::string_view TakeWord(std::string_view* text) {
  std::size_t first = 0;
  while (first < text->size() && IsBlank((*text)[first])) ++first;
  std::size_t last = first;
  while (last < text->size() && !IsBlank((*text)[last])) ++last;
  const std::string_view word = text->substr(first, last - first);
  text->remove_prefix(last);
  return word;
}

std::string_view TakeLine(std::string_view* text) {
  const std::size_t end = text->find('\n');
  std::string_view line = text->substr(0, end);
  text->remove_prefix(end == std::string_view::npos ? text->size() : end + 1);
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool ParseInteger(std::string_view word, long long* value) {
  const std::string_view digits = WithoutPlus(word);
  const char* const end = digits.data() + digits.size();
  const std::from_chars_result read =
      std::from_chars(digits.data(), end, *value);
  return read.ec == std::errc() && read.ptr == end;
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c == '\x7f') c = '?';
  }
  return '"' + text + (word.size() > kLongest ? "...\"" : "\"");
}

void MeshScanner::Refuse(const std::string& what) const {
  throw InputError(file_ + ": " + what);
}

void MeshScanner::RefuseContent() const {
  Refuse(std::string("unreadable; expected a complete ") + format_ +
         " file, found other or truncated content; export it again");
}

void MeshScanner::RequireRoom(unsigned long long count, std::size_t least,
                              const std::string& name) const {
  // The last thing of a text may lack the line's end it is counted with.
  if (count <= (bytes_.size() + 1) / least) return;
  Refuse("declares " + std::to_string(count) + " " + name +
         "; expected no more than the " + std::to_string(bytes_.size()) +
         " bytes that are left can hold; the file is truncated or damaged");
}

double MeshScanner::Real(std::string_view word,
                         const std::string& place) const {
  const std::string_view digits = WithoutPlus(word);
  const char* const end = digits.data() + digits.size();
  double value = 0.0;
  const std::from_chars_result read =
      std::from_chars(digits.data(), end, value);
  if (read.ptr != end || digits.empty()) {
    Refuse(place + "; expected a number, found " +
           (word.empty() ? "no more" : Quoted(word)) + "; export it again");
  }
  if (read.ec == std::errc::result_out_of_range) {
    // from_chars does not say whether it is too large or too small.
    value = std::strtod(std::string(digits).c_str(), nullptr);
    if (std::isinf(value)) {
      Refuse(place +
             "; expected a number that a double holds, below 1.8e308, "
             "found " +
             Quoted(word) + "; use another unit");
    }
  }
  return value;
}

}  // namespace phongpd::internal
