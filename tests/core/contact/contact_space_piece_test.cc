// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the whole build, which knows no walls.
#include "core/contact/contact_space_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/contact_space_file.h"
#include "core/contact/piece_data.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/expect_refused.h"
#include "tests/support/random_pairs.h"
#include "tests/support/same_space.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using testing::Cube;
using testing::DifferenceOf;

std::vector<ContactSpacePiece> AllPieces(const SolidPair& pair, int count,
                                         std::size_t facets_of_box,
                                         const ContactSpaceOptions& options) {
  std::vector<ContactSpacePiece> pieces;
  for (int i = count - 1; i >= 0; --i) {
    pieces.push_back(internal::BuildPiece(pair.robot, pair.obstacle, options,
                                          {i, count}, facets_of_box));
  }
  return pieces;
}

bool AreSame(const ContactSpace& a, const ContactSpace& b) {
  return DifferenceOf(a, b).empty();
}

// Does the message of the InputError hold all `words`?
template <typename Action>
void ExpectRefused(const Action& action,
                   const std::vector<std::string>& words) {
  const std::string text = testing::ErrorOf([&] { action(); });
  EXPECT_EQ(text.find('\n'), std::string::npos);
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << text << " / " << word;
  }
}

// What joining says where a cell cannot be judged.
constexpr char kDoNotFit[] = ": expected pieces that fit together";

// Case i of the random pairs: builds it whole and by pieces; what differs.
std::string CompareCase(PairKind kind, std::uint64_t seed, long i,
                        std::size_t* boxes) {
  const SolidPair pair = MakeRandomPair(kind, seed);
  ContactSpaceOptions options;
  options.outer_shell_only = i % 3 == 0;
  const ContactSpace whole =
      BuildContactSpace(pair.robot, pair.obstacle, options);
  const int count = 1 + static_cast<int>(i % 4);
  const std::size_t facets_of_box =
      std::max<std::size_t>(16, whole.report().convolution_triangles / 20);
  try {
    // By way of files, which are checked when they are read.
    std::vector<ContactSpacePiece> pieces;
    for (const auto& piece : AllPieces(pair, count, facets_of_box, options)) {
      pieces.push_back(ParsePiece(PieceContent(piece), "a file"));
      *boxes += piece.boxes();
    }
    return DifferenceOf(JoinContactSpace(pieces), whole);
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(ContactSpacePiecesCampaign, JoinedAreTheWholeBuildOfRandomPairs) {
  const auto& kinds = AllPairKinds();
  const long cases = testing::CampaignCases(150, 2500);
  testing::CampaignRow row;
  row.item = "pieces";
  std::size_t boxes = 0;
  long refused = 0;
  for (long i = 0; i < cases; ++i) {
    const PairKind kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const auto seed = static_cast<std::uint64_t>(i) / kinds.size();
    if (kind == PairKind::kManyBoxes && !testing::IsLongCampaign() &&
        seed > 1) {
      continue;  // seconds each
    }
    const std::string difference = CompareCase(kind, seed, i, &boxes);
    ++row.cases;
    if (difference.find(kDoNotFit) != std::string::npos) {
      ++refused;
      continue;
    }
    EXPECT_EQ(difference, "") << Name(kind) << ", seed " << seed;
    row.failures += difference.empty() ? 0 : 1;
  }
  row.subject = "joined pieces against the whole build, bit for bit; " +
                std::to_string(refused) + " refused by name";
  // A few in a thousand, or of few cases one.
  EXPECT_LE(refused, std::max(1L, row.cases / 200));
  EXPECT_GT(boxes, 5 * static_cast<std::size_t>(row.cases));
  testing::ReportCampaign(row);
}

// Cells so thin beside a wall that no point in them can be judged are said, or
// judged by their neighbours; never is a surface returned that is another.
TEST(ContactSpacePieces, FormerFailures) {
  std::size_t boxes = 0;
  for (const auto& [kind, seed, i] :
       {std::tuple{PairKind::kJittered, 5, 54L},
        std::tuple{PairKind::kJittered, 24, 244L},
        std::tuple{PairKind::kManyBoxes, 4, 49L}}) {
    const std::string difference =
        CompareCase(kind, static_cast<std::uint64_t>(seed), i, &boxes);
    EXPECT_TRUE(difference.empty() ||
                difference.find(kDoNotFit) != std::string::npos)
        << difference;
  }
}

struct PieceCase {
  const char* name;
  SolidPair pair;
};

SolidPair PairOf(TriangleMesh robot, TriangleMesh obstacle) {
  SolidPair pair;
  pair.robot = std::move(robot);
  pair.obstacle = std::move(obstacle);
  return pair;
}

// Surfaces that touch themselves, nested shells, cavities; and where slopes of
// one half put edges and vertices of C_cont into the walls themselves.
TEST(ContactSpacePieces, JoinedAreTheWholeBuildWhereItIsDegenerate) {
  TriangleMesh diamond;
  diamond.vertices = {{3, 0, 0},  {-3, 0, 0}, {0, 3, 0},
                      {0, -3, 0}, {0, 0, 3},  {0, 0, -3}};
  diamond.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const TriangleMesh shells =
      Joined(MakeVessel(12, 10, 0), MakeVessel(6, 4, 0));
  const std::vector<PieceCase> pairs = {
      {"cube and shell", PairOf(Cube(1), MakeVessel(4, 3, 0))},
      {"cube in nested shells", PairOf(Cube(1), shells)},
      {"diamond and diamonds",
       PairOf(diamond, Joined(Translated(diamond, {7, 0, 0}),
                              Translated(diamond, {0, 12, 1})))},
      {"diamond and shell", PairOf(diamond, MakeVessel(20, 16, 0))},
      {"peg and its hole", PairOf(MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}),
                                  MakePlateWithHole(4, 1, 1))},
      {"cubes on their corners",
       PairOf(Cube(2), Joined(Cube(1), Translated(Cube(1), {3, 3, 3})))},
      {"cubes on their edges",
       PairOf(Cube(2), Joined(Cube(1), Translated(Cube(1), {3, 3, 0})))},
      {"ball and torus", PairOf(MakeIcoBall(1.0, 0), MakeTorus(2, 0.6, 12, 6))},
      {"star and torus", PairOf(MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 12, 6))},
  };
  for (const PieceCase& named : pairs) {
    for (const bool outer : {false, true}) {
      SCOPED_TRACE(std::string(named.name) + (outer ? ", outer shell" : ""));
      ContactSpaceOptions options;
      options.outer_shell_only = outer;
      const ContactSpace whole =
          BuildContactSpace(named.pair.robot, named.pair.obstacle, options);
      for (const std::size_t facets : {20, 60, 100000}) {
        const auto pieces = AllPieces(named.pair, 2, facets, options);
        EXPECT_TRUE(AreSame(JoinContactSpace(pieces), whole)) << facets;
      }
    }
  }
}

TEST(ContactSpacePieces, FilesJoinToTheSameWhateverTheirNumber) {
  const SolidPair pair = PairOf(MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 12, 6));
  const ContactSpaceOptions options;
  std::string first;
  for (const int count : {1, 7}) {
    std::vector<ContactSpacePiece> read;
    for (const auto& piece : AllPieces(pair, count, 60, options)) {
      const std::string bytes = PieceContent(piece);
      read.push_back(ParsePiece(bytes, "a file"));
      EXPECT_EQ(PieceContent(read.back()), bytes);
      EXPECT_EQ(read.back().number().index, piece.number().index);
    }
    const std::string bytes = ContactSpaceContent(JoinContactSpace(read));
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first);
    EXPECT_TRUE(AreSame(JoinContactSpace(read),
                        BuildContactSpace(pair.robot, pair.obstacle)));
  }
}

// Piece i of n of the pair below, in boxes of 60 facets.
ContactSpacePiece StarAndTorus(int i, int n) {
  return internal::BuildPiece(MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 12, 6), {},
                              {i, n}, 60);
}

TEST(ContactSpacePieces, HalvesStandForTheirWhole) {
  const ContactSpace whole =
      BuildContactSpace(MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 12, 6));
  for (const int n : {1, 3}) {
    for (int halved = 0; halved < n; halved += 2) {
      std::size_t boxes = 0;
      std::vector<ContactSpacePiece> pieces;
      for (int i = 0; i < n; ++i) {
        if (i != halved) pieces.push_back(StarAndTorus(i, n));
      }
      // One half as a whole, the other in halves again.
      for (const auto& [i, count] :
           {std::pair{4 * halved + 3, 4 * n}, std::pair{2 * halved, 2 * n},
            std::pair{4 * halved + 2, 4 * n}}) {
        pieces.push_back(StarAndTorus(i, count));
        boxes += pieces.back().boxes();
      }
      EXPECT_EQ(boxes, StarAndTorus(halved, n).boxes());
      EXPECT_TRUE(AreSame(JoinContactSpace(pieces), whole)) << n;
    }
  }
}

TEST(ContactSpacePieces, HalvesThatAreNoWholeAreNamed) {
  const auto join = [](const std::vector<PieceNumber>& numbers) {
    std::vector<ContactSpacePiece> pieces;
    for (const auto& [i, n] : numbers) {
      pieces.push_back(
          ParsePiece(PieceContent(StarAndTorus(i, n)),
                     std::to_string(i) + "of" + std::to_string(n)));
    }
    JoinContactSpace(pieces);
  };
  ExpectRefused(
      [&] {
        join({{0, 3}, {2, 6}, {2, 3}});
      },
      {"expected all 3 pieces, found 3; without 3/6"});
  ExpectRefused([&] { join({{5, 12}, {0, 3}}); }, {"without 4/12, 3/6, 2/3"});
  ExpectRefused(
      [&] {
        join({{0, 3}, {1, 3}, {3, 6}, {2, 3}});
      },
      {"3of6: expected every piece once, found what is in 3/6 in "
       "1of3, too, which is 1/3"});
  ExpectRefused(
      [&] {
        join({{0, 3}, {3, 9}, {4, 9}, {5, 9}, {2, 3}});
      },
      {"of3: expected a piece of the build",
       "or some of them in "
       "halves"});
  ExpectRefused([&] { join({{0, 20}}); }, {"without 1/20, ", ", 8/20, more"});
}

TEST(ContactSpacePieces, LostRepeatedForeignAndCutOnesAreNamed) {
  const SolidPair pair = PairOf(Cube(1), MakeVessel(4, 3, 0));
  const auto pieces = [&](int count, const ContactSpaceOptions& options) {
    std::vector<ContactSpacePiece> read;
    for (int i = 0; i < count; ++i) {
      read.push_back(
          ParsePiece(PieceContent(BuildContactSpacePiece(
                         pair.robot, pair.obstacle, options, {i, count})),
                     "file" + std::to_string(i)));
    }
    return read;
  };
  const ContactSpaceOptions options;
  const std::vector<ContactSpacePiece> good = pieces(3, options);
  EXPECT_EQ(JoinContactSpace(good).report().cavities, 1);
  ExpectRefused([&] { JoinContactSpace({}); }, {"join", "found none"});
  ExpectRefused(
      [&] {
        JoinContactSpace({good[0], good[2]});
      },
      {"expected all 3 pieces, found 2", "without 1/3"});
  ExpectRefused(
      [&] {
        JoinContactSpace({good[0], good[1], good[1], good[2]});
      },
      {"file1: expected every piece once", "1/3 in file1"});
  ContactSpaceOptions other = options;
  other.outer_shell_only = true;
  const auto foreign = pieces(3, other);
  ExpectRefused(
      [&] {
        JoinContactSpace({good[0], foreign[1], good[2]});
      },
      {"file1: expected a piece of the build that file0 is of"});
  ExpectRefused(
      [&] {
        JoinContactSpace({good[0], pieces(2, options)[1]});
      },
      {"file1: expected a piece of the build that file0 is of"});
  // Limits and names make no other build.
  other = options;
  other.max_seconds = 100.0;
  other.robot_name = "r.off";
  EXPECT_NO_THROW(JoinContactSpace({good[0], pieces(3, other)[1], good[2]}));

  const std::string bytes = PieceContent(good[0]);
  ExpectRefused([&] { ParsePiece(bytes.substr(0, bytes.size() - 1), "cut"); },
                {"cut: expected", "it was cut off", "--piece"});
  ExpectRefused([&] { ParsePiece(bytes.substr(0, 40), "cut"); },
                {"cut: cut off"});
  ExpectRefused([&] { ParsePiece(bytes + '\0', "long"); },
                {"long: expected", "something follows"});
  ExpectRefused([&] { ParsePiece("OFF\n", "mesh.off"); },
                {"mesh.off: expected a piece"});
  for (std::size_t at = 0; at < bytes.size(); at += 41) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_THROW(ParsePiece(changed, "changed"), InputError) << at;
  }
  for (const PieceNumber number :
       {PieceNumber{0, 0}, PieceNumber{3, 3}, PieceNumber{-1, 2}}) {
    ExpectRefused(
        [&] {
          BuildContactSpacePiece(pair.robot, pair.obstacle, options, number);
        },
        {"piece: expected i/n with 0 <= i < n"});
  }
  other = options;
  other.merge_coplanar = false;
  ExpectRefused([&] { pieces(1, other); }, {"merge_coplanar: expected true"});
}

}  // namespace
}  // namespace phongpd
