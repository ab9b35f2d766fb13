// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are no mesh: one line says why, nothing is printed, nothing dies.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "core/mesh/mesh_io.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

// One line that starts with the path, says `part`, and nothing on the streams.
void ExpectRefusal(const std::string& path, const std::string& part) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const std::string what =
      testing::ErrorOf([&] { ReadMesh(path); }, "accepted");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "") << path;
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << path;
  EXPECT_EQ(what.rfind(path + ": ", 0), 0u) << what;
  EXPECT_NE(what.find(part), std::string::npos) << what << "\n" << part;
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

class MeshReader : public testing::TemporaryFolder {
 protected:
  void ExpectRefused(const std::string& file, const std::string& content,
                     const std::string& part) const {
    Put(file, content);
    ExpectRefusal(At(file), part);
  }
};

using MeshWriter = testing::TemporaryFolder;

std::string PlyHeader(const std::string& coordinate, const std::string& count) {
  return "ply\nformat ascii 1.0\nelement vertex " + count + "\nproperty " +
         coordinate + " x\nproperty " + coordinate + " y\nproperty " +
         coordinate +
         " z\nelement face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n";
}

TEST_F(MeshReader, RefusesPathsThatAreNoMeshFile) {
  ExpectRefusal(At("missing.off"), "found nothing; check the path");
  ExpectRefusal(At("missing.xyz"), "found \".xyz\"");
  ExpectRefusal(At("noextension"), "found none");
  ExpectRefusal("", "unknown mesh format");
  std::filesystem::create_directories(At("folder.off"));
  ExpectRefusal(At("folder.off"), "found a directory");
  for (const char* file : {"e.off", "e.obj", "e.stl", "e.ply"}) {
    ExpectRefused(file, "", "found an empty file");
    ExpectRefused(file, "\n", "expected");
    ExpectRefused(file, "hello world\n", "expected");
    ExpectRefused(file, std::string(1000, '\0'), "expected");
    ExpectRefused(file, std::string(1000, '\xff'), "expected");
  }
}

TEST_F(MeshReader, RefusesFilesWithoutFaces) {
  ExpectRefused("a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no face");
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\n", "no face");
  ExpectRefused("a.stl", "solid a\nendsolid a\n", "no face");
  ExpectRefused("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                "property float y\nproperty float z\nend_header\n0 0 0\n",
                "no face");
}

TEST_F(MeshReader, RefusesIndicesOutOfRange) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  ExpectRefused("a.obj", v + "f 1 2 3\nf 1 2 4\n",
                "1 faces with an index out of range, the first is 1");
  ExpectRefused("a.obj", v + "f 0 1 2\n", "1 faces with an index");
  ExpectRefused("a.obj", v + "f -1 -2 -4\n", "1 faces with an index");
  ExpectRefused("a.obj", v + "f 1 2 99999999999\n", "32-bit integer");
  ExpectRefused("a.obj", v + "f 1 2 x\n", "found \"x\"");
  ExpectRefused("a.obj", v + "f 1 2 3.5\n", "found \"3.5\"");
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (const char* face : {"3 0 1 3\n", "3 0 1 -1\n", "3 0 1 9999999999\n",
                           "3 0 1\n", "-3 0 1 2\n", "99999999 0 1 2\n", ""}) {
    ExpectRefused("a.off", off + face, "face 1 of 1");
  }
  const std::string ply = PlyHeader("float", "3") + "0 0 0\n1 0 0\n0 1 0\n";
  ExpectRefused("a.ply", ply + "3 0 1 3\n", "1 faces with an index");
  ExpectRefused("a.ply", ply + "3 0 1 -1\n", "1 faces with an index");
}

TEST_F(MeshReader, RefusesCountsThatTheFileCannotHold) {
  ExpectRefused("a.off", "OFF\n2000000000 1 0\n0 0 0\n", "2000000000 vertices");
  ExpectRefused("a.off", "OFF\n1 2000000000 0\n0 0 0\n", "2000000000 faces");
  ExpectRefused("a.off", "OFF\n-1 1 0\n0 0 0\n", "expected");
  ExpectRefused("a.ply", PlyHeader("float", "9999999999999"),
                "9999999999999 vertex");
  ExpectRefused("a.ply", PlyHeader("float", "-3"), "vertex");
  ExpectRefused("a.ply", PlyHeader("float", "many"), "PLY");
}

TEST_F(MeshReader, RefusesPlyCoordinatesThatAreNotReal) {
  ExpectRefused("a.ply", PlyHeader("int", "3") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
                "expected float or double, found int");
  ExpectRefused("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                "end_header\n0\n1\n2\n",
                "found 1 of them");
}

TEST_F(MeshReader, RefusesNonFiniteCoordinatesWithTheirCount) {
  std::string stl(80, ' ');
  const std::uint32_t one = 1;
  stl.append(reinterpret_cast<const char*>(&one), 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  for (const float x :
       {0.f, 0.f, 1.f, nan, 0.f, 0.f, 1.f, inf, 0.f, 0.f, 1.f, 0.f}) {
    stl.append(reinterpret_cast<const char*>(&x), 4);
  }
  ExpectRefused("a.stl", stl + "  ",
                "2 vertices with NaN or infinity, the first is 0");
  ExpectRefused("a.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "expected");
  ExpectRefused("a.off", "OFF\n3 1 0\n1e999 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "expected");
  ExpectRefused("a.obj", "v inf 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "expected");
  ExpectRefused("a.ply",
                PlyHeader("double", "3") + "0 0 -inf\n1 0 0\n0 1 0\n3 0 1 2\n",
                "expected");
}

// The files that WriteMesh makes of one star, cut and damaged.
TEST_F(MeshReader, SurvivesEveryTruncation) {
  const TriangleMesh star = MakeStar(1, 2);
  for (const std::string file : {"s.off", "s.obj", "s.stl", "s.ply"}) {
    WriteMesh(star, At(file));
    const std::string whole = Content(file);
    std::size_t refused = 0, tried = 0;
    for (std::size_t size = 0; size < whole.size(); size += 31, ++tried) {
      Put(file, whole.substr(0, size));
      try {
        const TriangleMesh mesh = ReadMesh(At(file));
        // OBJ has no end mark, so a cut one may be a smaller mesh.
        EXPECT_TRUE(file == "s.obj" || size + 12 > whole.size()) << size;
        ExamineMesh(mesh);
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, tried / 2) << file;
  }
}

TEST_F(MeshReader, SurvivesDamagedBytes) {
  std::mt19937 random(7);
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 4});
  for (const std::string file : {"b.off", "b.obj", "b.stl", "b.ply"}) {
    WriteMesh(box, At(file));
    const std::string whole = Content(file);
    int read = 0;
    for (int run = 0; run < 400; ++run) {
      std::string damaged = whole;
      const std::string alphabet = "0123456789-.e #/\n\t\\\x7f\xff nan";
      damaged[random() % damaged.size()] = alphabet[random() % alphabet.size()];
      Put(file, damaged);
      try {
        const TriangleMesh mesh = ReadMesh(At(file));
        ++read;
        MakeSolid(mesh, file);
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
    EXPECT_GT(read, 20) << file;
  }
}

TEST_F(MeshWriter, RefusesBeforeItWrites) {
  TriangleMesh mesh = MakeBox({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(WriteMesh(mesh, At("a.step")), InputError);
  EXPECT_THROW(WriteMesh(mesh, At("no/such/folder/a.off")), InputError);
  mesh.vertices[7].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteMesh(mesh, At("a.off")), InputError);
  mesh = MakeBox({0, 0, 0}, {1, 1, 1});
  mesh.triangles[0][1] = 8;
  EXPECT_THROW(WriteMesh(mesh, At("a.off")), InputError);
  EXPECT_FALSE(std::filesystem::exists(At("a.step")));
  EXPECT_FALSE(std::filesystem::exists(At("a.off")));
}

}  // namespace
}  // namespace phongpd
