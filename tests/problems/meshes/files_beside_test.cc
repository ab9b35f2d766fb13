// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of somebody else may name: files below the root, and nothing
// that is none.
#include "problems/meshes/files_beside.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "problems/meshes/any_mesh.h"
#include "tests/problems/meshes/mesh_files.h"
#include "tests/problems/meshes/watched_folder.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

class FilesOfStrangers : public testing::WatchedFolder {
 protected:
  // What reading it says, or "read".
  std::string Outcome(const std::string& name, const std::string& root) {
    const std::string what =
        testing::ErrorOf([&] { ReadAnyMesh(At(name), nullptr, root); }, "read");
    EXPECT_FALSE(WasEntered()) << name << ": " << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }

  // With a root and, where that is to make no difference, without.
  void ExpectRefused(const std::string& name, const std::string& word,
                     bool only_below_root = false) {
    for (const std::string& root : {At("root"), std::string()}) {
      if (only_below_root && root.empty()) continue;
      const std::string what = Outcome(name, root);
      EXPECT_NE(what.find("expected "), std::string::npos) << what;
      EXPECT_NE(what.find(word), std::string::npos)
          << "no '" << word << "' in " << what;
    }
  }

  const std::vector<std::string> ways_out_ = {"../secret/data.bin",
                                              "d/data.bin",
                                              "./d/data.bin",
                                              "link.bin",
                                              "sub/../ok.bin",
                                              "%2e%2e/secret/data.bin",
                                              "..\\\\secret\\\\data.bin",
                                              "fifo.bin",
                                              "zero.bin",
                                              "folder.bin",
                                              "none.bin",
                                              "file:///etc/passwd",
                                              "/etc/passwd",
                                              "/dev/zero",
                                              "/proc/self/environ"};
};

TEST_F(FilesOfStrangers, OfGlTFAreBesideOrBelowItAndRegular) {
  for (const std::string good : {"ok.bin", "sub/ok.bin", "./ok.bin"}) {
    Put("root/a.gltf", Gltf(good));
    EXPECT_EQ(Outcome("root/a.gltf", At("root")), "read") << good;
    EXPECT_EQ(Outcome("root/a.gltf", ""), "read") << good;
  }
  for (const std::string& bad : ways_out_) {
    Put("root/a.gltf", Gltf(bad));
    ExpectRefused("root/a.gltf", "a.gltf: '");
    const std::string expected = "expected a file beside or below it";
    ExpectRefused("root/a.gltf", expected);
    EXPECT_NE(
        Outcome("root/a.gltf", At("root"))
            .find(expected + ", below the root " + At("root") + ", found "),
        std::string::npos);
    EXPECT_NE(Outcome("root/a.gltf", "").find(expected + ", found "),
              std::string::npos);
  }
  Put("root/a.gltf", Gltf("d/data.bin"));
  ExpectRefused("root/a.gltf", "'d/data.bin'");
}

// Two parsers take one key each: there may be one.
TEST_F(FilesOfStrangers, OfGlTFAreNotHiddenBehindAKeyThatComesTwice) {
  const std::string out = "../secret/data.bin";
  for (const auto& [first, second] :
       {std::pair(out, std::string("ok.bin")), {"ok.bin", out}}) {
    Put("root/a.gltf", Gltf(first + "\",\"uri\":\"" + second));
    ExpectRefused("root/a.gltf", "uri");
    std::string twice = Gltf(first);
    twice.insert(
        1, "\"buffers\":[{\"uri\":\"" + second + "\",\"byteLength\":240}],");
    Put("root/a.gltf", twice);
    ExpectRefused("root/a.gltf", "buffers");
  }
}

TEST_F(FilesOfStrangers, OfGlTFOneAreTheSame) {
  for (const std::string& bad : ways_out_) {
    Put("root/a.gltf",
        R"({"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":)"
        R"(["n"]}},"nodes":{"n":{"meshes":["m"]}},"meshes":{"m":{"primitives":)"
        R"([{"attributes":{"POSITION":"p"},"mode":4}]}},"accessors":{"p":)"
        R"({"bufferView":"v","byteOffset":0,"componentType":5126,"count":6,)"
        R"("type":"VEC3"}},"bufferViews":{"v":{"buffer":"b","byteOffset":0,)"
        R"("byteLength":72}},"buffers":{"b":{"byteLength":72,"uri":")" +
            bad + R"("}}})");
    ExpectRefused("root/a.gltf", "found");
  }
}

TEST_F(FilesOfStrangers, OfMeshesNamedByNameAreBelowTheRootAndRegular) {
  for (const char* name : {"root/link.off", "root/d/data.off",
                           "root/../secret/data.off", "secret/data.off"}) {
    ExpectRefused(name, "below the root", true);
  }
  ExpectRefused("root/fifo.off", "a pipe");
  EXPECT_EQ(Outcome("root/ok.off", At("root")), "read");
  EXPECT_EQ(Outcome("root/sub/../ok.off", At("root")), "read");
  // Whoever does go there is seen.
  ReadAnyMesh(At("root/link.off"));
  EXPECT_TRUE(WasEntered());
}

TEST_F(FilesOfStrangers, OfRobotsAreTheSame) {
  for (const std::string kind : {"root/a.urdf", "root/a.sdf"}) {
    const auto put = [&](const std::string& file) {
      Put(kind, kind == "root/a.sdf" ? Sdf(file) : Urdf(file));
    };
    put("sub/ok.off");
    EXPECT_EQ(Outcome(kind, At("root")), "read");
    for (const std::string& bad :
         {std::string("../secret/data.off"), std::string("d/data.off"),
          std::string("link.off"), "file://" + At("secret/data.off"),
          At("secret/data.off"), std::string("package://secret/data.off"),
          std::string("model://secret/data.off")}) {
      put(bad);
      ExpectRefused(kind, "below the root", true);
    }
    put("fifo.off");
    ExpectRefused(kind, "a pipe");
    put("out.gltf");
    ExpectRefused(kind, "expected a file beside or below it");
    ExpectRefused(kind, "below the root " + At("root"), true);
  }
}

// They name pictures and materials, which nobody needs.
TEST_F(FilesOfStrangers, OfOtherFormatsAreNotOpened) {
  Put("root/a.dae",
      ColladaWith(Image("../secret/data.bin") + Image("fifo.bin")));
  EXPECT_EQ(Outcome("root/a.dae", At("root")), "read");
  Put("root/a.obj",
      "mtllib fifo.bin\nmtllib ../secret/data.bin\nv 0 0 0\n"
      "v 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(Outcome("root/a.obj", At("root")), "read");
  std::string mf = testing::ThreeMf(Block());
  const std::string target = "/3D/3dmodel.model", other = "../../secret/data";
  mf.replace(mf.find("Target=\"") + 8, target.size(), other);
  Put("root/a.3mf", mf);
  EXPECT_NE(Outcome("root/a.3mf", At("root")), "read");
}

}  // namespace
}  // namespace phongpd
