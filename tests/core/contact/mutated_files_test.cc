// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the library's own with other contents and a valid checksum, as
// somebody may make them: refused by name, or an answer.  What else they could
// do (crash, hang, any other exception) ends the test.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/contact/contact_space_cache.h"
#include "core/contact/contact_space_file.h"
#include "core/contact/contact_space_piece.h"
#include "core/contact/joined_contact_spaces.h"
#include "core/contact/piece_data.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/resealed.h"
#include "tests/support/campaign.h"
#include "tests/support/metrics.h"
#include "tests/support/mutated_bytes.h"
#include "tests/support/solid_tools.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using testing::Below;
using testing::Mutated;
using Random = std::mt19937_64;

// What a mutated file came to.
struct Counts {
  long refused = 0, answered = 0;
};

// `use` of a file's content, one that starts with `name` where it refuses.
void Try(const std::function<void()>& use, const std::string& name,
         Counts* counts) {
  try {
    use();
    ++counts->answered;
  } catch (const InputError& error) {
    fuzz::PromiseReadable(error, name);
    ++counts->refused;
  }
}

void UseSpace(const ContactSpace& space) {
  ASSERT_GT(space.mesh().triangles.size(), 0U);
  const Eigen::Vector3d q = space.bounds().Center();
  EuclideanMetric(space).Query(q + Eigen::Vector3d(0.1, 0.2, 0.3));
  testing::UnsmoothedPhong(space).Query(q);
  JoinedContactSpaces({space, space});
  const std::string written = ContactSpaceContent(space);
  EXPECT_EQ(ContactSpaceContent(ParseContactSpace(written, "again")), written);
}

struct Operands {
  TriangleMesh robot, obstacle;
  std::size_t facets_of_box;
};

const std::vector<Operands>& Seeds() {
  static const std::vector<Operands> seeds = {
      {testing::Cube(1), testing::Cube(2), 100000},
      {testing::Cube(1), testing::Cube(2), 6},
      {MakeCone(0.8, 1.6, 4), MakeVessel(4, 3, 0), 30},
      {MakeStar(0.5, 1.2), testing::Cube(3), 40}};
  return seeds;
}

void Report(const char* subject, long cases, const Counts& counts) {
  testing::CampaignRow row;
  row.item = "mutated files";
  row.subject = std::string(subject) + ": " + std::to_string(counts.refused) +
                " refused, " + std::to_string(counts.answered) + " answered";
  row.cases = cases;
  testing::ReportCampaign(row);
}

TEST(MutatedFilesCampaign, PiecesAreRefusedOrJoined) {
  Counts counts;
  const long cases = testing::CampaignCases(1500, 6000);
  Random random(29);
  std::vector<std::vector<std::string>> builds;
  for (const Operands& o : Seeds()) {
    for (const int count : {1, 2}) {
      builds.emplace_back();
      for (int i = 0; i < count; ++i) {
        builds.back().push_back(PieceContent(internal::BuildPiece(
            o.robot, o.obstacle, {}, {i, count}, o.facets_of_box)));
      }
    }
  }
  for (long i = 0; i < cases; ++i) {
    const std::vector<std::string>& build =
        builds[static_cast<std::size_t>(i) % builds.size()];
    const std::size_t changed = Below(build.size(), &random);
    const std::string bytes =
        fuzz::Resealed(build[changed],
                       Mutated(fuzz::ContentOfSealed(build[changed]), &random));
    SCOPED_TRACE(i);
    Try(
        [&] {
          std::vector<ContactSpacePiece> pieces;
          for (std::size_t k = 0; k < build.size(); ++k) {
            pieces.push_back(ParsePiece(k == changed ? bytes : build[k],
                                        "file" + std::to_string(k)));
          }
          UseSpace(JoinContactSpace(pieces));
        },
        "", &counts);
  }
  EXPECT_GT(counts.refused, cases / 2);
  EXPECT_GT(counts.answered, 0);
  Report("pieces", cases, counts);
}

TEST(MutatedFilesCampaign, SavedContactSpacesAreRefusedOrUsed) {
  Counts counts;
  const long cases = testing::CampaignCases(1500, 3000);
  Random random(30);
  std::vector<std::string> files;
  for (const Operands& o : Seeds()) {
    files.push_back(
        ContactSpaceContent(BuildContactSpace(o.robot, o.obstacle)));
  }
  for (long i = 0; i < cases; ++i) {
    const std::string& file = files[static_cast<std::size_t>(i) % files.size()];
    const std::string bytes =
        fuzz::Resealed(file, Mutated(fuzz::ContentOfSealed(file), &random));
    SCOPED_TRACE(i);
    Try([&] { UseSpace(ParseContactSpace(bytes, "a.pcs")); }, "a.pcs", &counts);
  }
  EXPECT_GT(counts.refused, cases / 4);
  EXPECT_GT(counts.answered, 0);
  Report("contact spaces", cases, counts);
}

class MutatedCache : public testing::TemporaryFolder {};

TEST_F(MutatedCache, IsNoErrorButBuiltAnewOrUsed) {
  Counts counts;
  const long cases = testing::CampaignCases(200, 1000);
  Random random(31);
  const Operands& o = Seeds()[0];
  ContactSpaceCache cache;
  cache.directory = At("cache");
  BuildContactSpaceCached(o.robot, o.obstacle, {}, cache);
  std::filesystem::path path;
  for (const auto& entry :
       std::filesystem::directory_iterator(cache.directory)) {
    path = entry.path();
  }
  std::ifstream in(path, std::ios::binary);
  const std::string file(std::istreambuf_iterator<char>(in), {});
  const ContactSpace built = BuildContactSpace(o.robot, o.obstacle);
  // The seconds differ, so the content's size is found by that of its bytes.
  const std::string content =
      fuzz::ContentOfSealed(ContactSpaceContent(built)).substr(sizeof(double));
  const std::size_t start = file.size() - content.size();
  for (long i = 0; i < cases; ++i) {
    const std::string changed = Mutated(file.substr(start), &random);
    std::ofstream(path, std::ios::binary)
        << file.substr(0, start - internal::kSealBytes)
        << internal::Seal(changed) << changed;
    SCOPED_TRACE(i);
    Try(
        [&] {
          UseSpace(BuildContactSpaceCached(o.robot, o.obstacle, {}, cache));
        },
        "", &counts);
  }
  EXPECT_EQ(counts.refused, 0);
  Report("caches", cases, counts);
}

}  // namespace
}  // namespace phongpd
