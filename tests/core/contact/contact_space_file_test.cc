// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/contact/contact_space_bytes.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

class ContactSpaceFile : public testing::TemporaryFolder {
 protected:
  // Inside out, so that the report has something to say.
  const ContactSpace built_ = BuildContactSpace(
      Reversed(MakeBox({-0.1, -0.1, -0.1}, {0.3, 0.4, 0.5})), MakeL(3, 1, 1));
};

// What ParseContactSpace says of `bytes`; empty: nothing.  One line that names
// the file first.
std::string Refusal(const std::string& bytes) {
  try {
    ParseContactSpace(bytes, "C.pcs");
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("C.pcs: ", 0), 0U) << what;
    EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 0) << what;
    return what;
  }
  return "";
}

bool Says(const std::string& refusal, const std::string& word) {
  return refusal.find(word) != std::string::npos;
}

// A file whose seal is right, with content that was changed.
std::string Resealed(std::string bytes, std::size_t header,
                     const std::function<void(std::string*)>& change) {
  std::string content = bytes.substr(header);
  change(&content);
  return bytes.substr(0, header - internal::kSealBytes) +
         internal::Seal(content) + content;
}

// The text, the machine and the version stand before the seal.
constexpr std::size_t kVersionAt = 22 + 8;
constexpr std::size_t kHeader = kVersionAt + 4 + internal::kSealBytes;

TEST_F(ContactSpaceFile, KeepsPlanesKindsAndReportBitForBit) {
  const std::string path = At("c.pcs");
  WriteContactSpace(built_, path);
  const ContactSpace read = ReadContactSpace(path);
  EXPECT_EQ(read.mesh().vertices, built_.mesh().vertices);
  EXPECT_EQ(read.mesh().triangles, built_.mesh().triangles);
  ASSERT_EQ(read.plane().size(), built_.mesh().triangles.size());
  EXPECT_EQ(read.plane(), built_.plane());
  EXPECT_EQ(read.kind(), built_.kind());
  EXPECT_FALSE(read.report().warnings.empty());
  EXPECT_EQ(read.report().warnings, built_.report().warnings);
  EXPECT_EQ(read.report().seconds, built_.report().seconds);
  EXPECT_EQ(read.report().robot.inverted_components, 1);
  // All fields, as ToBytes does not compile when one is missing.
  EXPECT_EQ(internal::ToBytes(read.parts()), internal::ToBytes(built_.parts()));
  EXPECT_EQ(ContactSpaceContent(read), Content("c.pcs"));
}

TEST_F(ContactSpaceFile, KeepsTheLengthOnlyWhereItWasGiven) {
  const auto again = [](const ContactSpace& space) {
    return ParseContactSpace(ContactSpaceContent(space), "C.pcs");
  };
  EXPECT_FALSE(again(built_).HasOwnLength());
  EXPECT_EQ(again(built_).length(), built_.length());
  const ContactSpace own = again(built_.WithLength(0.1));
  EXPECT_TRUE(own.HasOwnLength());
  EXPECT_EQ(own.length(), 0.1);
}

TEST_F(ContactSpaceFile, AnswersQueriesAsTheBuiltOneDoes) {
  const ContactSpace space = built_.WithLength(2.0);
  const ContactSpace read =
      ParseContactSpace(ContactSpaceContent(space), "C.pcs");
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.1;
  const PhongMetric phong(space, options), phong_read(read, options);
  const EuclideanMetric euclidean(space), euclidean_read(read);
  int inside = 0;
  for (int i = 0; i < 64; ++i) {
    const Eigen::Vector3d q(0.4 * (i % 4), 0.3 * (i / 4 % 4), 0.2 * (i / 16));
    for (const auto& [a, b] : {std::pair<PenetrationResult, PenetrationResult>(
                                   phong.Query(q), phong_read.Query(q)),
                               {euclidean.Query(q), euclidean_read.Query(q)}}) {
      EXPECT_EQ(a.signed_distance, b.signed_distance);
      EXPECT_EQ(a.contact, b.contact);
      EXPECT_EQ(a.direction, b.direction);
      EXPECT_EQ(a.gradient, b.gradient);
      EXPECT_EQ(a.triangle, b.triangle);
      inside += a.inside ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 20);
}

TEST_F(ContactSpaceFile, OfAMeshThatWasTakenHasNoPlanes) {
  const ContactSpace taken = TakeAsContactSpace(built_.mesh());
  const ContactSpace read =
      ParseContactSpace(ContactSpaceContent(taken), "C.pcs");
  EXPECT_TRUE(read.plane().empty());
  EXPECT_TRUE(read.kind().empty());
  EXPECT_EQ(read.report().method, "taken from a mesh");
}

TEST_F(ContactSpaceFile, CutOffAtAnyByteIsRefused) {
  const std::string good = ContactSpaceContent(built_);
  ASSERT_GT(good.size(), 1000U);
  for (std::size_t size = 0; size < good.size(); ++size) {
    ASSERT_FALSE(Refusal(good.substr(0, size)).empty()) << size;
  }
  EXPECT_TRUE(Says(Refusal(good.substr(0, 21)), "another beginning"));
  EXPECT_TRUE(Says(Refusal(good.substr(0, kHeader - 1)), "cut off"));
  EXPECT_TRUE(Says(Refusal(good.substr(0, good.size() - 1)), "cut off"));
  EXPECT_TRUE(Says(Refusal(good + '\0'), "something follows"));
}

TEST_F(ContactSpaceFile, WithAnyByteChangedIsRefused) {
  const std::string good = ContactSpaceContent(built_);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    ASSERT_FALSE(Refusal(bad).empty()) << i;
  }
  std::string bad = good;
  bad[kHeader + 40] = static_cast<char>(bad[kHeader + 40] ^ 1);
  EXPECT_TRUE(Says(Refusal(bad), "damaged"));
}

TEST_F(ContactSpaceFile, OfAnotherVersionMachineOrKindIsRefusedByName) {
  const std::string good = ContactSpaceContent(built_);
  std::string other = good;
  other[kVersionAt] = 7;
  EXPECT_TRUE(Says(Refusal(other), "expected version 1 of the format, found 7"))
      << Refusal(other);
  other = good;
  std::reverse(other.begin() + 22, other.begin() + kVersionAt);
  EXPECT_TRUE(Says(Refusal(other), "byte order")) << Refusal(other);
  EXPECT_TRUE(
      Says(Refusal(MeshContent(built_.mesh(), "c.off")), "another beginning"));
  EXPECT_TRUE(Says(Refusal(""), "another beginning"));
}

// Behind a checksum that is right, contents are checked as a mesh is.
TEST_F(ContactSpaceFile, ForgedContentsAreChecked) {
  const std::string good = ContactSpaceContent(built_);
  EXPECT_EQ(Refusal(Resealed(good, kHeader, [](std::string*) {})), "");
  const auto put = [](auto value, std::size_t at) {
    return [=](std::string* content) {
      std::memcpy(content->data() + at, &value, sizeof value);
    };
  };
  // D; then the number of vertices, and these.
  for (const double length : {-1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(Refusal(Resealed(good, kHeader, put(length, 0))), "");
  }
  EXPECT_NE(Refusal(Resealed(good, kHeader, put(std::size_t{1} << 60, 8))), "");
  EXPECT_NE(
      Refusal(Resealed(good, kHeader,
                       put(std::numeric_limits<double>::quiet_NaN(), 16))),
      "");
  const std::size_t triangles = 16 + 24 * built_.mesh().vertices.size() + 8;
  EXPECT_NE(Refusal(Resealed(good, kHeader, put(1 << 30, triangles))), "");
  // An index that is valid, but leaves a hole.
  const Triangle& t = built_.mesh().triangles[0];
  EXPECT_TRUE(Says(Refusal(Resealed(good, kHeader, put(t[1], triangles))),
                   "closed, edge-manifold"));
}

// As the first version wrote them: names, and no file of another one.
TEST_F(ContactSpaceFile, HoldsKindsOfApproximationsByTheirNames) {
  ContactSpaceOptions options;
  options.robot_hull = true;
  const std::string bytes = ContactSpaceContent(
      BuildContactSpace(MakeL(1, 0.3, 0.3), MakeL(3, 1, 1), options));
  EXPECT_EQ(KindsOf(ParseContactSpace(bytes, "C.pcs").report().approximation),
            "robot-hull");
  const std::string name = "robot-hull";
  std::size_t count = 0;
  for (std::size_t at = bytes.find(name); at != std::string::npos;
       at = bytes.find(name, at + 1)) {
    ++count;
  }
  EXPECT_EQ(count, 2U);  // of the step, and of all of them
  EXPECT_NE(Refusal(Resealed(bytes, kHeader,
                             [&](std::string* content) {
                               (*content)[content->rfind(name)] = 'R';
                             })),
            "");
}

// A file that this test did not write: a cube of side 2 and one of side 0.5.
// When it is refused, the bytes have changed and need another version.
TEST_F(ContactSpaceFile, OfTheFirstVersionIsRead) {
  const ContactSpace box =
      ReadContactSpace(std::string(PHONGPD_TEST_DATA) + "/box.pcs");
  EXPECT_EQ(box.mesh().triangles.size(), 12U);
  EXPECT_EQ(box.report().volume, 2.5 * 2.5 * 2.5);
  EXPECT_EQ(std::count(box.kind().begin(), box.kind().end(),
                       ContactKind::kObstacleFacet),
            12);
}

TEST_F(ContactSpaceFile, IsNamedByItsExtension) {
  EXPECT_TRUE(NamesContactSpaceFile("a/b.pcs"));
  EXPECT_TRUE(NamesContactSpaceFile("B.PCS"));
  EXPECT_FALSE(NamesContactSpaceFile("pcs"));
  EXPECT_FALSE(NamesContactSpaceFile("a.pcs.off"));
  EXPECT_THROW(ReadContactSpace(At("missing.pcs")), InputError);
  EXPECT_THROW(WriteContactSpace(built_, At("no/folder.pcs")), InputError);
}

}  // namespace
}  // namespace phongpd
