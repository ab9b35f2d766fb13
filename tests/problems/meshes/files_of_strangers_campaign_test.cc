// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of strangers, mutated, that name files in every way that leads out of
// the root or to what is no file: each is read or refused in one line; nothing
// crashes, hangs or opens a file outside.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/meshes/any_mesh.h"
#include "problems/scenes/scene.h"
#include "tests/problems/meshes/mesh_files.h"
#include "tests/problems/meshes/mutated.h"
#include "tests/problems/meshes/watched_folder.h"
#include "tests/support/campaign.h"

namespace phongpd {
namespace {

constexpr std::uint64_t kSeed = 29;

class StrangersCampaign : public testing::WatchedFolder {
 protected:
  std::size_t Below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }

  // A way to a file with that extension, ".bin" or ".off".
  std::string Way(const std::string& extension) {
    const std::vector<std::string> ways = {
        "ok" + extension,
        "sub/ok" + extension,
        "../secret/data" + extension,
        "d/data" + extension,
        "link" + extension,
        "fifo" + extension,
        "sub/../../secret/data" + extension,
        "%2e%2e/secret/data" + extension,
        "./d/../d/data" + extension,
        At("secret/data" + extension),
        "file://" + At("secret/data" + extension),
        "package://secret/data" + extension,
        "model://d/data" + extension,
        "zero.bin",
        "folder.bin",
        "out.gltf",
        "../secret/data.gltf",
        "d/data.gltf",
        ""};
    return ways[Below(ways.size())];
  }

  // One file for root/, with its extension; some of its bytes are others.
  std::string Make(std::string* extension) {
    static const std::vector<std::string> kinds = {
        ".gltf", ".gltf", ".glb", ".3mf", ".urdf", ".sdf", ".dae", ".json"};
    *extension = kinds[Below(kinds.size())];
    std::string bytes;
    const std::string way = Way(".bin"), mesh = Way(".off");
    if (*extension == ".gltf") {
      bytes = Gltf(way + (Below(2) == 0 ? "\",\"uri\":\"ok.bin" : ""));
    } else if (*extension == ".glb") {
      bytes = testing::Glb(Block());
      // Of the same length, as chunks have one.
      const std::size_t at = bytes.find("\"byteLength\"");
      if (Below(2) == 0) bytes.replace(at, 20, "\"uri\":\"d/data.bin\", ");
    } else if (*extension == ".3mf") {
      bytes = testing::ThreeMf(Block());
    } else if (*extension == ".dae") {
      bytes = ColladaWith(Image(way));
    } else if (*extension == ".urdf") {
      bytes = Urdf(mesh);
    } else if (*extension == ".sdf") {
      bytes = Sdf(mesh);
    } else {
      bytes = R"({"robot":{"shape":{"type":"box","size":[1,1,1]}},)"
              R"("obstacles":[{"mesh":")" +
              mesh + R"("}],"start":[9,9,9],"goal":[9,9,8]})";
    }
    // Some are as they are: their names lead where they lead.
    return Below(3) == 0 ? bytes : testing::Mutated(bytes, &random_);
  }

  std::mt19937_64 random_{kSeed};
};

TEST_F(StrangersCampaign, ReadsOrRefusesAndStaysBelowTheRoot) {
  const long cases = testing::CampaignCases(400, 10'000);
  long read = 0, refused = 0, outside = 0, hangs = 0, contained = 0, wrong = 0;
  for (long i = 0; i < cases; ++i) {
    std::string extension, what;
    const std::string bytes = Make(&extension);
    const std::string name = "root/a" + extension;
    Put(name, bytes);
    try {
      if (extension == ".json") {
        ReadScene(At(name), At("root"));
      } else {
        ReadAnyMesh(At(name), nullptr, At("root"));
      }
      ++read;
    } catch (const InputError& error) {
      ++refused;
      what = error.what();
    }
    const auto says = [&](const char* word) {
      return what.find(word) != std::string::npos;
    };
    const bool is_outside = WasEntered(), is_hung = says("too long to read");
    // Assimp crashed in its sandbox: that is what it is for.
    contained += says("reader crashes on") ? 1 : 0;
    outside += is_outside ? 1 : 0;
    hangs += is_hung ? 1 : 0;
    const bool is_wrong = says("\n") || what.size() > 2000;
    wrong += is_wrong ? 1 : 0;
    EXPECT_FALSE(is_outside || is_hung || is_wrong)
        << "case " << i << ", " << name << ": " << what << '\n'
        << bytes;
  }
  EXPECT_GT(read, cases / 50);
  EXPECT_GT(refused, cases / 3);
  testing::ReportCampaign({"files of strangers",
                           "mutated glTF, GLB, 3MF, COLLADA, URDF, SDF, scenes",
                           cases, outside + hangs + wrong, 0.0, 0.0, "",
                           kSeed});
  RecordProperty("read", std::to_string(read));
  RecordProperty("refused", std::to_string(refused));
  RecordProperty("contained", std::to_string(contained));
}

}  // namespace
}  // namespace phongpd
