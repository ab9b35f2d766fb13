// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/meshes/any_mesh.h"
#include "tests/problems/meshes/mesh_files.h"
#include "tests/problems/meshes/mutated.h"
#include "tests/support/temporary_folder.h"

// Files of which some bytes are others: each is read, or refused in one line,
// and nothing else happens.
namespace phongpd {
namespace {

using testing::Block;
using testing::Mutated;

// Of this process and those that it has waited for, seconds.
double ProcessorTime() {
  double sum = 0.0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage;
    getrusage(who, &usage);
    for (const timeval& t : {usage.ru_utime, usage.ru_stime}) {
      sum +=
          static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    }
  }
  return sum;
}

class BrokenFiles : public testing::TemporaryFolder {
 protected:
  // Reads `count` mutations of a file under that name; `part` is what of it is
  // asked for.
  void Read(const std::string& bytes, const std::string& name, int count,
            const std::string& part = "") {
    std::mt19937_64 random(14);
    int read = 0, refused = 0;
    for (int i = 0; i < count; ++i) {
      Put(name, Mutated(bytes, &random));
      const std::set<std::string> before = Names();
      const double start = ProcessorTime();
      try {
        const TriangleMesh mesh = ReadAnyMesh(At(name) + part);
        ++read;
        ExpectPromises(mesh);
      } catch (const InputError& error) {
        ++refused;
        const std::string what = error.what();
        EXPECT_EQ(what.rfind(At(""), 0), 0u) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_LT(what.size(), 2000u) << what;
      }
      EXPECT_LT(ProcessorTime() - start, 10.0) << "mutation " << i;
      EXPECT_EQ(Names(), before);
      // What made it fail stays for whoever looks.
      if (HasFailure()) FAIL() << "mutation " << i << ":\n" << Content(name);
    }
    // Both do happen: the mutations are neither harmless nor hopeless.
    EXPECT_GT(read, 0) << name;
    EXPECT_GT(refused, 0) << name;
  }

 private:
  static void ExpectPromises(const TriangleMesh& mesh) {
    EXPECT_FALSE(mesh.triangles.empty());
    for (const Eigen::Vector3d& v : mesh.vertices) EXPECT_TRUE(v.allFinite());
    const int vertices = static_cast<int>(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
      for (const int v : t) {
        EXPECT_GE(v, 0);
        EXPECT_LT(v, vertices);
      }
    }
  }
};

constexpr int kByAssimp = 500;  // a process each
constexpr int kByUs = 2000;

TEST_F(BrokenFiles, OfCOLLADAAreReadOrRefused) {
  Read(testing::Collada(Block(), "<unit meter=\"0.01\"/>"), "a.dae", kByAssimp);
}

TEST_F(BrokenFiles, OfGlTFAreReadOrRefused) {
  Put("a.bin", testing::GltfBuffer(Block()));
  Read(testing::GltfJson(Block(), "\"uri\":\"a.bin\","), "a.gltf", kByAssimp);
}

TEST_F(BrokenFiles, OfGLBAreReadOrRefused) {
  Read(testing::Glb(Block()), "a.glb", kByAssimp);
}

TEST_F(BrokenFiles, OfThreeMFAreReadOrRefused) {
  Read(testing::ThreeMf(Block()), "a.3mf", kByAssimp);
}

constexpr char kTwoLinks[] =
    "<robot name='r'><link name='a'><collision><origin xyz='1 2 3' "
    "rpy='0 1 0'/><geometry><box size='1 2 3'/></geometry></collision></link>"
    "<link name='b'><collision><geometry><cylinder radius='0.5' length='2'/>"
    "</geometry></collision></link><joint name='j' type='revolute'>"
    "<parent link='a'/><child link='b'/><origin xyz='0 0 1'/>"
    "<axis xyz='0 1 0'/><limit lower='-1' upper='1'/></joint></robot>";

TEST_F(BrokenFiles, OfURDFAreReadOrRefused) {
  Read(kTwoLinks, "a.urdf", kByUs, "#b");
  Read(kTwoLinks, "b.urdf", kByUs, "@j=0.5");
}

TEST_F(BrokenFiles, OfSDFAreReadOrRefused) {
  Read(
      "<sdf version='1.6'><model name='m'><link name='a'><collision name='c'>"
      "<pose>1 0 0 0 0 0</pose><geometry><sphere><radius>2</radius></sphere>"
      "</geometry></collision></link></model></sdf>",
      "a.sdf", kByUs);
}

}  // namespace
}  // namespace phongpd
