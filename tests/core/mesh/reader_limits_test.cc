// SPDX-License-Identifier: GPL-3.0-or-later
// Files that claim what they do not hold, and paths that are no files.  The
// measure is the memory: what readers allocate stays in proportion to the
// bytes that are there.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "core/mesh/input_file.h"
#include "core/mesh/mesh_io.h"
#include "core/mesh/mesh_scanner.h"
#include "core/mesh/polygon_soup.h"
#include "tests/support/expect_refused.h"

namespace {

// Bytes that the process holds now, and held at most since the last reset.
std::atomic<std::size_t> held{0}, most{0};

}  // namespace

// Not inline: gcc would see a malloc that operator delete ends.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t now = held += malloc_usable_size(memory);
  if (now > most) most = now;
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  held -= malloc_usable_size(memory);
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  held -= malloc_usable_size(memory);
  std::free(memory);
}

namespace phongpd {
namespace {

using internal::MeshFormat;

// Of messages and what does not depend on the file.
constexpr std::size_t kBase = 1 << 14;

void ExpectRefused(MeshFormat format, const std::string& bytes,
                   const std::string& part) {
  const std::size_t before = held;
  most = before;
  const std::string what = testing::ErrorOf(
      [&] { internal::ReadMeshBytes(format, bytes, "file"); }, "accepted");
  EXPECT_LT(most - before, kBase + 100 * bytes.size()) << what;
  EXPECT_EQ(what.rfind("file: ", 0), 0u) << what;
  EXPECT_NE(what.find(part), std::string::npos) << what << "\n" << part;
}

template <typename T>
std::string Bytes(T value, bool is_big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return is_big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string Ply(const std::string& format, const std::string& faces,
                const std::string& more = "") {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\n" +
         more + "element face " + faces +
         "\nproperty list uint int vertex_indices\nend_header\n";
}
const char kTextVertices[] = "0 0 0\n1 0 0\n0 1 0\n";

TEST(ReaderLimits, TheFileWhoseListClaimsTwoThousandMillionCorners) {
  const std::string path = PHONGPD_TEST_DATA "/faults/list_count.ply";
  const std::string bytes = ReadInputFile(path, "a mesh", 1000);
  ASSERT_EQ(bytes.size(), 188u);
  ExpectRefused(MeshFormat::kPly, bytes, "declares 2000000000 values");
}

TEST(ReaderLimits, PlyListsClaimNoMoreThanTheFileHolds) {
  ExpectRefused(MeshFormat::kPly,
                Ply("ascii", "1") + kTextVertices + "4294967295 0 1 2\n",
                "declares 4294967295 values");
  ExpectRefused(MeshFormat::kPly,
                Ply("ascii", "1") + kTextVertices + "-3 0 1 2\n", "found -3");
  ExpectRefused(MeshFormat::kPly,
                Ply("ascii", "1") + kTextVertices + "3.5 0 1 2\n", "found 3.5");
  ExpectRefused(MeshFormat::kPly,
                Ply("ascii", "1") + kTextVertices + "nan 0 1 2\n", "found nan");
  for (const bool big : {false, true}) {
    const std::string format =
        std::string("binary_") + (big ? "big" : "little") + "_endian";
    std::string file = Ply(format, "1");
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) {
      file += Bytes(x, big);
    }
    for (const std::uint32_t count : {4u, 500'000'000u, 4'294'967'295u}) {
      std::string claim = file + Bytes(count, big);
      for (const int v : {0, 1, 2}) claim += Bytes(v, big);
      ExpectRefused(MeshFormat::kPly, claim,
                    "declares " + std::to_string(count) + " values");
    }
  }
}

TEST(ReaderLimits, PlyListsNobodyAskedForAreCheckedToo) {
  const std::string list = "property list uint double weights\n";
  ExpectRefused(
      MeshFormat::kPly,
      Ply("ascii", "1", list) + "0 0 0 2000000000 1 1 0 0 0 0\n1 0 0 0\n",
      "declares 2000000000 values");
  ExpectRefused(MeshFormat::kPly,
                Ply("binary_little_endian", "1", list) + std::string(12, '\0') +
                    Bytes(2'000'000'000u) + std::string(100, '\0'),
                "declares 2000000000 values");
}

TEST(ReaderLimits, CountsOfElementsFitTheBytesThatAreLeft) {
  // Also of elements that are skipped, and in their own size: 20 bytes are
  // enough for five of four bytes, not for two of twelve.
  ExpectRefused(MeshFormat::kPly, Ply("ascii", "2000000000") + kTextVertices,
                "declares 2000000000 face");
  ExpectRefused(MeshFormat::kPly,
                Ply("ascii", "18446744073709551615") + kTextVertices, "count");
  ExpectRefused(MeshFormat::kPly,
                Ply("ascii", "9223372036854775807") + kTextVertices,
                "declares 9223372036854775807 face");
  ExpectRefused(MeshFormat::kPly,
                "ply\nformat binary_big_endian 1.0\nelement skipped 99999999\n"
                "property double a\nelement vertex 2\nproperty float x\n"
                "property float y\nproperty float z\nend_header\n" +
                    std::string(100, '\0'),
                "declares 99999999 \"skipped\"");
  ExpectRefused(MeshFormat::kOff, "OFF\n3 9999999999 0\n0 0 0\n1 0 0\n0 1 0\n",
                "declares 9999999999 faces");
  ExpectRefused(MeshFormat::kOff, "OFF\n99999999 1 0\n0 0 0\n",
                "declares 99999999 vertices");
  ExpectRefused(MeshFormat::kOff,
                "OFF BINARY\n" + Bytes(3, true) + Bytes(0x7fffffff, true) +
                    Bytes(0, true) + std::string(40, '\0'),
                "declares 2147483647 faces");
  ExpectRefused(MeshFormat::kOff,
                "OFF BINARY\n" + Bytes(3, true) + Bytes(1, true) +
                    Bytes(0, true) + std::string(36, '\0') +
                    Bytes(0x7fffffff, true) + std::string(12, '\0'),
                "declares 2147483647 corners");
  ExpectRefused(
      MeshFormat::kStl,
      std::string(80, ' ') + Bytes(0xffffffffu) + std::string(500, '\0'),
      "declares 4294967295 triangles");
  ExpectRefused(MeshFormat::kStl,
                std::string(80, ' ') + Bytes(11u) + std::string(500, '\0'),
                "declares 11 triangles");
}

// An element without properties takes no bytes, so any number of it is there.
TEST(ReaderLimits, ElementsWithoutPropertiesTakeNoTime) {
  ExpectRefused(MeshFormat::kPly,
                "ply\nformat ascii 1.0\nelement nothing 9223372036854775807\n"
                "element vertex 1\nproperty float x\nproperty float y\n"
                "property float z\nend_header\n0 0 0\n",
                "no face");
}

// Touched as it is, a signalling NaN would be an invalid operation; as bits it
// shows.
template <typename Real, typename Bits>
void ExpectQuiet(const std::vector<Bits>& nans, Bits quiet_bit) {
  for (const bool big : {false, true}) {
    for (const Bits nan : nans) {
      const std::string bytes = Bytes(nan, big), file = "file";
      internal::MeshScanner scanner(bytes, "PLY", file);
      const Real x = scanner.Binary<Real>(big);
      Bits found = 0;
      std::memcpy(&found, &x, sizeof found);
      EXPECT_TRUE(std::isnan(x)) << nan;
      EXPECT_EQ(found & quiet_bit, quiet_bit) << nan;
    }
    for (const Real kept :
         {Real{0}, -Real{0}, Real{-1.5}, std::numeric_limits<Real>::max(),
          -std::numeric_limits<Real>::denorm_min(),
          std::numeric_limits<Real>::infinity(),
          -std::numeric_limits<Real>::infinity()}) {
      const std::string bytes = Bytes(kept, big), file = "file";
      internal::MeshScanner scanner(bytes, "PLY", file);
      const Real x = scanner.Binary<Real>(big);
      EXPECT_EQ(Bytes(x), Bytes(kept)) << kept;
    }
  }
}

TEST(MeshScanner, GivesQuietNansAndEveryOtherNumberAsItIs) {
  ExpectQuiet<float, std::uint32_t>(
      {0x7f800001u, 0xff800001u, 0x7fbfffffu, 0x7fc00000u, 0xffffffffu},
      0x00400000u);
  ExpectQuiet<double, std::uint64_t>(
      {0x7ff0000000000001u, 0xfff0000000000001u, 0x7ff7ffffffffffffu,
       0x7ff8000000000000u, 0xffffffffffffffffu},
      0x0008000000000000u);
}

// The points are the first three coordinates over the fourth.
TEST(ReaderLimits, OffPointsOverNothingOrInfinityAreRefused) {
  const std::string begin = "4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n";
  const std::string face = "3 0 1 2\n";
  EXPECT_EQ(internal::ReadMeshBytes(MeshFormat::kOff,
                                    begin + "0 3 0 3\n" + face, "file")
                .vertices[2],
            Eigen::Vector3d(0, 1, 0));
  for (const char* vertex :
       {"0 1 0 0", "0 0 0 0", "0 0 0 -0", "inf 0 0 0", "nan 0 0 0"}) {
    ExpectRefused(MeshFormat::kOff, begin + vertex + "\n" + face,
                  "vertex 3; expected a finite fourth coordinate other than "
                  "0, found 0");
  }
  for (const char* vertex :
       {"0 1 0 inf", "inf 0 0 inf", "0 0 0 -inf", "0 0 0 nan"}) {
    ExpectRefused(MeshFormat::kOff, begin + vertex + "\n" + face,
                  "found NaN or infinity");
  }
  std::string binary =
      "4OFF BINARY\n" + Bytes(1, true) + Bytes(1, true) + Bytes(0, true);
  for (int k = 0; k < 3; ++k) binary += Bytes(0x7f800001u, true);
  ExpectRefused(MeshFormat::kOff,
                binary + Bytes(0.0f, true) + Bytes(0, true) + Bytes(0, true),
                "vertex 1; expected a finite fourth");
}

TEST(ReaderLimits, ObjIndicesAreBounded) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* index : {"2147483648", "-2147483649", "1e3", "0x1", "--1",
                            "99999999999999999999", "1-", "+"}) {
    ExpectRefused(MeshFormat::kObj, v + "f 1 2 " + index + "\n",
                  std::string("found \"") + index + "\"");
  }
  for (const char* index : {"2147483647", "-2147483648", "0", "-4", "4"}) {
    ExpectRefused(MeshFormat::kObj, v + "f 1 2 " + index + "\n",
                  "1 faces with an index out of range");
  }
  std::string many = v + "f";
  for (int i = 0; i < 100'000; ++i) many += " -1 -2 -3";
  ExpectRefused(MeshFormat::kObj, many + " 4\n", "1 faces with an index");
  std::string continued = v + "f 1 2 \\\n";
  for (int i = 0; i < 100'000; ++i) continued += "\\\n";
  ExpectRefused(MeshFormat::kObj, continued + "9\n", "1 faces with an index");
}

TEST(ReaderLimits, NumbersThatNoDoubleHoldsAreNamed) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 ";
  for (const char* number : {"1e400", "-1e400", "+9e308", "1e99999999999"}) {
    const std::string found = std::string("found \"") + number + "\"";
    const std::string vertex =
        "0 0 0\n1 0 0\n0 " + std::string(number) + " 0\n";
    ExpectRefused(MeshFormat::kOff, "OFF\n3 1 0\n" + vertex + "3 0 1 2\n",
                  found);
    ExpectRefused(MeshFormat::kObj, "v 0 0 " + std::string(number) + "\n",
                  found);
    ExpectRefused(MeshFormat::kPly, Ply("ascii", "1") + vertex + "3 0 1 2\n",
                  found);
    ExpectRefused(
        MeshFormat::kStl,
        "solid a\nfacet normal 0 0 0\nvertex 0 0 " + std::string(number) + "\n",
        found);
  }
  // Too small for a double is 0, as everywhere in C++.
  EXPECT_EQ(internal::ReadMeshBytes(MeshFormat::kOff,
                                    off + "1e-400 0\n3 0 1 2\n", "file")
                .vertices[2]
                .y(),
            0.0);
}

TEST(ReaderLimits, WhatIsReadTakesMemoryInProportion) {
  std::string text = "OFF\n3 30000 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < 30'000; ++i) text += "3 0 1 2\n";
  const std::size_t before = held;
  most = before;
  internal::ReadMeshBytes(MeshFormat::kOff, text, "file");
  EXPECT_LT(most - before, kBase + 100 * text.size());
}

std::string TestPath(const std::string& file) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string path = ::testing::TempDir() + test->name() + "_" + file;
  std::filesystem::remove_all(path);
  return path;
}

std::string Refusal(const std::string& path, std::uintmax_t max_bytes) {
  return testing::ErrorOf(
      [&] { ReadInputFile(path, "a mesh file", max_bytes); }, "accepted");
}

TEST(InputFile, RefusesWhatIsNoFile) {
  EXPECT_EQ(Refusal("/dev/zero", 100),
            "/dev/zero: expected a mesh file, found a device; name a file");
  EXPECT_EQ(Refusal("/dev/null", 100),
            "/dev/null: expected a mesh file, found a device; name a file");
  EXPECT_NE(Refusal(::testing::TempDir(), 100).find("found a directory"),
            std::string::npos);
  EXPECT_NE(Refusal(TestPath("missing"), 100).find("found nothing"),
            std::string::npos);
}

TEST(InputFile, RefusesAPipeThatNobodyWritesTo) {
  const std::string path = TestPath("pipe.off");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_NE(Refusal(path, 100).find("found a pipe that nobody writes to"),
            std::string::npos);
  EXPECT_THROW(ReadMesh(path), InputError);
}

TEST(InputFile, ReadsAPipeToItsEndHoweverSlowItsWriter) {
  const std::string path = TestPath("pipe.off");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  const std::vector<std::string> parts = {"OFF\n3 1 0\n0 0 0\n1 0 0\n",
                                          "0 1 0\n3 0 1 2\n"};
  std::thread writer([&] {
    std::ofstream pipe(path);  // waits for a reader
    for (const std::string& part : parts) {
      pipe << part << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(1200));
    }
  });
  EXPECT_EQ(ReadMesh(path).triangles.size(), 1u);
  writer.join();
}

TEST(InputFile, RefusesMoreThanItsLimit) {
  const std::string path = TestPath("file");
  std::ofstream(path) << std::string(101, 'x');
  EXPECT_NE(Refusal(path, 100).find("101 bytes or more, of 100 allowed"),
            std::string::npos);
  EXPECT_EQ(Refusal(path, 101), "accepted");
  // Sparse: nothing is read or allocated of it.
  std::filesystem::resize_file(path, kMaxMeshBytes + 1);
  const std::size_t before = held;
  most = before;
  EXPECT_NE(Refusal(path, kMaxMeshBytes).find("2147483649 bytes"),
            std::string::npos);
  EXPECT_LT(most - before, kBase);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace phongpd
