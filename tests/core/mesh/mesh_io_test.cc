// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/temporary_folder.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

class MeshIo : public testing::TemporaryFolder {
 protected:
  TriangleMesh ReadText(const std::string& file,
                        const std::string& content) const {
    Put(file, content);
    return ReadMesh(At(file));
  }
};

// `value` as the bytes of a T, in either order.
template <typename T>
std::string Bytes(double value, bool is_big_endian = false) {
  const T typed = static_cast<T>(value);
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &typed, sizeof(T));
  if (is_big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string WithLineEnds(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

bool HasSameBits(const Vector3d& a, const Vector3d& b) {
  return std::memcmp(a.data(), b.data(), sizeof(Vector3d)) == 0;
}

// Corners of all triangles in order, whatever the sharing.
std::vector<Vector3d> Corners(const TriangleMesh& mesh) {
  std::vector<Vector3d> corners;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) corners.push_back(mesh.vertices[v]);
  }
  return corners;
}

const char kTetrahedronObj[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const char kCubeOff[] =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const char kTetrahedronPly[] =
    "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty double x\n"
    "property double y\nproperty double z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

double SolidVolume(const TriangleMesh& mesh) {
  MeshReport report;
  MakeSolid(mesh, "mesh", &report);
  EXPECT_EQ(report.inverted_components, 0);
  return report.volume;
}

TEST_F(MeshIo, ReadsBackTheSameDoubles) {
  TriangleMesh mesh = Rotated(MakeStar(0.1, 1.0 / 3.0), GenericRotation());
  mesh.vertices[0] = {5e-324, -1e-300, 1.7976931348623157e308};
  mesh.vertices[1] = {0.1, -0.0, 1.000000001};
  mesh.vertices[2] = {1e-9, 123456789.123456789, -1e6 - 1e-6};
  for (const char* file : {"m.off", "m.obj", "m.ply"}) {
    WriteMesh(mesh, At(file));
    const TriangleMesh read = ReadMesh(At(file));
    ASSERT_EQ(read.vertices.size(), mesh.vertices.size()) << file;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      EXPECT_TRUE(HasSameBits(read.vertices[v], mesh.vertices[v])) << file;
    }
    EXPECT_EQ(read.triangles, mesh.triangles) << file;
  }
  WriteMesh(mesh, At("m.stl"));
  const TriangleMesh read = ReadMesh(At("m.stl"));
  EXPECT_EQ(read.vertices.size(), mesh.vertices.size());
  const std::vector<Vector3d> expected = Corners(mesh), found = Corners(read);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(HasSameBits(found[i], expected[i]));
  }
}

TEST_F(MeshIo, WritesTheSameBytesAgain) {
  const TriangleMesh mesh = Rotated(MakeWrench(), GenericRotation());
  for (const char* file : {"m.off", "m.obj", "m.ply", "m.stl"}) {
    std::string bytes[2];
    for (std::string& content : bytes) {
      WriteMesh(mesh, At(file));
      content = Content(file);
    }
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_GT(bytes[0].size(), 386u * 20);
  }
}

TEST_F(MeshIo, ReadsExtensionsInAnyCase) {
  EXPECT_EQ(ReadText("a.OBJ", kTetrahedronObj).triangles.size(), 4u);
  EXPECT_EQ(ReadText("a.Off", kCubeOff).triangles.size(), 12u);
  EXPECT_EQ(ReadText("a.b.pLy", kTetrahedronPly).triangles.size(), 4u);
}

TEST_F(MeshIo, ReadsLinesThatEndInCrLf) {
  EXPECT_NEAR(
      SolidVolume(ReadText("a.obj", WithLineEnds(kTetrahedronObj, "\r\n"))),
      1.0 / 6, 1e-16);
  EXPECT_NEAR(
      SolidVolume(ReadText("a.ply", WithLineEnds(kTetrahedronPly, "\r\n"))),
      1.0 / 6, 1e-16);
  EXPECT_EQ(SolidVolume(ReadText("a.off", WithLineEnds(kCubeOff, "\r\n"))), 1);
  WriteMesh(MakeStar(1, 2), At("star.stl"));
  const std::string stl = WithLineEnds(Content("star.stl"), "\r\n");
  EXPECT_EQ(ReadText("a.stl", stl).vertices.size(), 32u);
}

TEST_F(MeshIo, ReadsBinaryStl) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 4});
  // Some writers say solid.
  for (const std::string start : {"", "solid ", "solid of facet normal\n"}) {
    std::string stl = start + std::string(80 - start.size(), ' ');
    stl += Bytes<std::uint32_t>(12);
    for (std::size_t t = 0; t < 12; ++t) {
      stl += std::string(12, '\0');
      for (const int v : box.triangles[t]) {
        for (const double x : box.vertices[v]) stl += Bytes<float>(x);
      }
      stl += std::string(2, '\0');
    }
    const TriangleMesh read = ReadText("box.stl", stl);
    EXPECT_EQ(read.vertices.size(), 8u);
    EXPECT_EQ(SolidVolume(read), 8.0);
  }
}

TEST_F(MeshIo, ReadsBinaryPlyInBothByteOrders) {
  const TriangleMesh star = Rotated(MakeStar(1, 2), GenericRotation());
  for (const bool is_big_endian : {false, true}) {
    std::string ply = std::string("ply\nformat binary_") +
                      (is_big_endian ? "big" : "little") +
                      "_endian 1.0\nelement vertex 32\nproperty double x\n"
                      "property double y\nproperty double z\n"
                      "property uchar red\nelement face 60\n"
                      "property list uchar uint vertex_index\nend_header\n";
    for (const Vector3d& v : star.vertices) {
      for (const double x : v) ply += Bytes<double>(x, is_big_endian);
      ply += '\n';  // a colour
    }
    for (const Triangle& t : star.triangles) {
      ply += '\3';
      for (const int v : t) ply += Bytes<std::uint32_t>(v, is_big_endian);
    }
    const TriangleMesh read = ReadText("star.ply", ply);
    EXPECT_EQ(read.triangles, star.triangles);
    for (std::size_t v = 0; v < 32; ++v) {
      EXPECT_TRUE(HasSameBits(read.vertices[v], star.vertices[v]));
    }
  }
}

TEST_F(MeshIo, ReadsTheStatementsOfObjThatOthersWrite) {
  const TriangleMesh mesh = ReadText(
      "a.obj",
      "# a comment\nmtllib a.mtl\no part\ng  side one\nusemtl Red Paint\n"
      "v\t0 0 0 0.5 0.5 0.5\n  v 1.0e0\t0   0\nvt 0 0\nvn 0 0 1\nmg 1 2\n"
      "v 0 1 0 1.0\nv 0 0 \\\n1\ns off\nl 1 2 3\np 1\ncall other.obj\n"
      "f 1/1/1 3//1\t2/1\nf -4 -3 -1\nf 1/1 \\\r\n4/1 3/1 # end\nf 2 3 4");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_NEAR(SolidVolume(mesh), 1.0 / 6, 1e-16);
}

TEST_F(MeshIo, ReadsTheHeadersOfOffThatOthersWrite) {
  const std::string body(kCubeOff + 4);
  for (const std::string head :
       {"OFF ", "# made by\n# hand\nOFF\n", "COFF\n", "OFF\n\n\n"}) {
    EXPECT_EQ(SolidVolume(ReadText("a.off", head + body)), 1.0) << head;
  }
  // Colours on some vertices and some faces only.
  std::string colored = kCubeOff;
  colored.replace(colored.find("1 0 0\n"), 6, "1 0 0 255 0 0 255\n");
  colored.replace(colored.find("4 4 5 6 7\n"), 10,
                  "4 4 5 6 7 0.5 0.25 1 # c\n");
  colored.replace(0, 3, "COFF");
  EXPECT_EQ(SolidVolume(ReadText("a.off", colored)), 1.0);
}

TEST_F(MeshIo, ReadsBinaryOff) {
  std::string off = "OFF BINARY\n";
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 4});
  for (const int count : {8, 12, 0}) off += Bytes<std::int32_t>(count, true);
  for (const Vector3d& v : box.vertices) {
    for (const double x : v) off += Bytes<float>(x, true);
  }
  for (const Triangle& t : box.triangles) {
    off += Bytes<std::int32_t>(3, true);
    for (const int v : t) off += Bytes<std::int32_t>(v, true);
    off += Bytes<std::int32_t>(0, true);  // colour components
  }
  EXPECT_EQ(SolidVolume(ReadText("box.off", off)), 8.0);
}

TEST_F(MeshIo, TriangulatesPolygonsThatAreNotConvex) {
  // A U-shaped prism of two octagons and eight quads; the fan around the
  // first corner of an octagon would leave it.
  const double u[8][2] = {{1, 2}, {2, 2}, {2, 3}, {0, 3},
                          {0, 0}, {2, 0}, {2, 1}, {1, 1}};
  for (int first = 0; first < 8; ++first) {
    std::string off = "OFF\n16 10 0\n";
    for (const char* z : {" -1\n", " 1.5\n"}) {
      for (const auto& p : u) {
        off += std::to_string(p[0]) + " " + std::to_string(p[1]) + z;
      }
    }
    const auto at = [first](int i) { return (i + first) % 8; };
    std::string bottom = "8", top = "8";
    for (int i = 0; i < 8; ++i) {
      bottom += " " + std::to_string(at(8 - i));
      top += " " + std::to_string(at(i) + 8);
    }
    off += bottom + "\n" + top + "\n";
    for (int i = 0; i < 8; ++i) {
      const int j = (i + 1) % 8;
      off += "4 " + std::to_string(i) + " " + std::to_string(j) + " " +
             std::to_string(j + 8) + " " + std::to_string(i + 8) + "\n";
    }
    const TriangleMesh mesh = ReadText("u.off", off);
    EXPECT_EQ(mesh.triangles.size(), 28u);
    EXPECT_NEAR(SolidVolume(mesh), 5 * 2.5, 1e-14);
  }
}

TEST_F(MeshIo, SkipsFacesWithFewerThanThreeCorners) {
  const TriangleMesh mesh =
      ReadText("a.obj", std::string(kTetrahedronObj) + "f 1 2\nf 1\nf\n");
  EXPECT_EQ(mesh.triangles.size(), 4u);
}

TEST_F(MeshIo, KeepsVerticesApartExceptInStl) {
  TriangleMesh two =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({0, 0, 0}, {1, 1, 1}));
  two.vertices.emplace_back(5, 5, 5);  // unused
  for (const char* file : {"m.off", "m.obj", "m.ply"}) {
    WriteMesh(two, At(file));
    EXPECT_EQ(ReadMesh(At(file)).vertices.size(), 17u) << file;
  }
  WriteMesh(two, At("m.stl"));
  EXPECT_EQ(ReadMesh(At("m.stl")).vertices.size(), 8u);
}

}  // namespace
}  // namespace phongpd
