// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/piece_cover.h"

#include <algorithm>
#include <utility>

#include "core/contact/piece_data.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd::internal {
namespace {

using Data = ContactSpacePiece::Data;

// Of the missing ones.
constexpr std::size_t kMostNamed = 8;

void RequireOfJoin(bool is_met, const std::string& message) {
  if (!is_met) throw InputError(message);
}

// What a piece holds, [begin, end), in parts of the finest number there is.
struct Span {
  long begin, end;
  const Data* data;
};

bool IsPowerOfTwo(int n) { return n > 0 && (n & (n - 1)) == 0; }

void RequireOneBuild(const std::vector<ContactSpacePiece>& pieces, int finest) {
  const Data& first = pieces[0].data();
  for (const ContactSpacePiece& piece : pieces) {
    const Data& data = piece.data();
    const int count = data.number.count;
    RequireOfJoin(
        data.build == first.build && finest % count == 0 &&
            IsPowerOfTwo(finest / count),
        data.name + ": expected a piece of the build that " + first.name +
            " is of (" + std::to_string(first.number.count) +
            " pieces, or some of them in halves), found one of another");
    RequireOfJoin(HaveOneFrame(data.frame, first.frame) &&
                      data.outer_shell_only == first.outer_shell_only,
                  data.name + ": expected the grid and the shells of " +
                      first.name +
                      ", which is of the same build, found others; write both "
                      "anew by phongpd contact-space --piece");
  }
}

// Names pieces that would hold what is between two others, the largest there
// can be of a build of `coarsest`; stops at kMostNamed.
void NameBetween(long begin, long end, int coarsest, int finest,
                 std::vector<std::string>* names) {
  while (begin < end && names->size() < kMostNamed) {
    long size = finest / coarsest;
    while (begin % size != 0 || begin + size > end) size /= 2;
    names->push_back(ToText(
        {static_cast<int>(begin / size), static_cast<int>(finest / size)}));
    begin += size;
  }
  if (begin < end && names->size() == kMostNamed) names->push_back("more");
}

}  // namespace

std::string ToText(PieceNumber number) {
  return std::to_string(number.index) + '/' + std::to_string(number.count);
}

std::vector<const Data*> InOrder(const std::vector<ContactSpacePiece>& pieces) {
  RequireOfJoin(!pieces.empty(), "join: expected pieces, found none");
  int finest = 0, coarsest = pieces[0].number().count;
  for (const ContactSpacePiece& piece : pieces) {
    finest = std::max(finest, piece.number().count);
    coarsest = std::min(coarsest, piece.number().count);
  }
  RequireOneBuild(pieces, finest);
  std::vector<Span> spans;
  for (const ContactSpacePiece& piece : pieces) {
    const long size = finest / piece.number().count;
    const long begin = piece.number().index * size;
    spans.push_back({begin, begin + size, &piece.data()});
  }
  std::stable_sort(
      spans.begin(), spans.end(),
      [](const Span& a, const Span& b) { return a.begin < b.begin; });
  std::vector<const Data*> ordered;
  std::vector<std::string> missing;
  long end = 0;
  for (const Span& span : spans) {
    if (span.begin < end) {
      const Data& before = *ordered.back();
      throw InputError(span.data->name +
                       ": expected every piece once, found what is in " +
                       ToText(span.data->number) + " in " + before.name +
                       ", too, which is " + ToText(before.number));
    }
    NameBetween(end, span.begin, coarsest, finest, &missing);
    end = span.end;
    ordered.push_back(span.data);
  }
  NameBetween(end, finest, coarsest, finest, &missing);
  RequireOfJoin(missing.empty(),
                "join: expected all " + std::to_string(coarsest) +
                    " pieces, found " + std::to_string(pieces.size()) +
                    "; without " + Joined(missing));
  return ordered;
}

}  // namespace phongpd::internal
