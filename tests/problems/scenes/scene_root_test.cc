// SPDX-License-Identifier: GPL-3.0-or-later
// Which mesh files a scene may name when it comes from somebody else.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/mesh/mesh_io.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

// inside/ (the root) holds box.off, sub/, and links; outside/ holds box.off.
class SceneRoot : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "scene_root_XXXXXX");
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    for (const char* sub : {"inside/sub", "outside", "inside_too"}) {
      fs::create_directories(folder_ / sub);
    }
    for (const char* file :
         {"inside/box.off", "outside/box.off", "inside_too/box.off"}) {
      WriteMesh(MakeBox({-1, -1, -1}, {1, 1, 1}), folder_ / file);
    }
    fs::create_symlink("../outside", folder_ / "inside/link");
    fs::create_symlink("../outside/box.off", folder_ / "inside/link.off");
    fs::create_symlink("../inside", folder_ / "outside/back");
    fs::create_symlink("inside", folder_ / "root_by_link");
  }
  void TearDown() override { fs::remove_all(folder_); }

  // What a scene in inside/ says that names `mesh`.
  std::string Outcome(const std::string& mesh, const std::string& root) const {
    const nlohmann::json scene = {
        {"robot", {{"mesh", mesh}}},
        {"obstacles", {{{"shape", {{"type", "box"}, {"size", {1, 1, 1}}}}}}},
        {"start", {0, 0, 5}},
        {"goal", {0, 5, 0}}};
    const std::string file = folder_ / "inside/scene.json";
    std::ofstream(file) << scene;
    return testing::ErrorOf([&] { ReadScene(file, root); }, "read");
  }

  fs::path folder_;
};

TEST_F(SceneRoot, HoldsWhatLiesBelowIt) {
  for (const char* root : {"inside", "inside/", "outside/../inside",
                           "outside/back", "root_by_link", ""}) {
    const std::string path = folder_ / root;
    for (const std::string mesh :
         {"box.off", "sub/../box.off", "./sub/.././box.off",
          "../outside/back/box.off", "link/back/box.off"}) {
      EXPECT_EQ(Outcome(mesh, path), "read") << root << ' ' << mesh;
    }
    EXPECT_EQ(Outcome(folder_ / "inside/box.off", path), "read");
  }
}

TEST_F(SceneRoot, RefusesWhatLeadsOutOfIt) {
  const std::string root = folder_ / "inside";
  for (const std::string mesh :
       {"../outside/box.off", "link/box.off", "link.off", "sub/../link.off",
        "../inside_too/box.off", "../box.off", "..", "/", "/etc/passwd",
        "../outside/missing.off", "/proc/self/cwd/box.off"}) {
    const std::string what = Outcome(mesh, root);
    EXPECT_NE(what.find("/robot/mesh: expected a mesh file below the root"),
              std::string::npos)
        << mesh << ": " << what;
    EXPECT_NE(what.find("; move it there"), std::string::npos) << what;
    // Nor does it tell where a link leads.
    EXPECT_EQ(what.find("outside/box.off", what.find("found") + 40),
              std::string::npos);
  }
  // Without a root they are read as ever.
  EXPECT_EQ(Outcome("../outside/box.off", ""), "read");
  EXPECT_EQ(Outcome("link.off", ""), "read");
}

TEST_F(SceneRoot, MustBeAFolder) {
  for (const char* root : {"none", "inside/box.off"}) {
    const std::string path = folder_ / root;
    EXPECT_EQ(Outcome("box.off", path),
              path + ": expected the root folder of mesh files, found none");
  }
}

TEST_F(SceneRoot, DoesNotHideWhatIsWrongWithAFileInside) {
  EXPECT_NE(Outcome("missing.off", folder_ / "inside").find("found nothing"),
            std::string::npos);
  const std::string pipe = folder_ / "inside/pipe.off";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(Outcome("pipe.off", folder_ / "inside").find("found a pipe"),
            std::string::npos);
}

TEST_F(SceneRoot, SceneFilesHaveALimit) {
  const std::string path = folder_ / "large.json";
  std::ofstream(path) << "{}";
  fs::resize_file(path, kMaxSceneBytes + 1);
  std::string what = testing::ErrorOf([&] { ReadScene(path); }, "read");
  EXPECT_NE(what.find("found 268435457 bytes or more, of 268435456 allowed"),
            std::string::npos)
      << what;
  std::ofstream(path) << std::string(1 << 20, '[');
  what = testing::ErrorOf([&] { ReadScene(path); });
  EXPECT_NE(what.find("nesting of at most 100 levels"), std::string::npos);
}

// Found by fuzzing: a text with a line's end in it was repeated whole.
TEST(SceneText, IsNotRepeatedWholeInARefusal) {
  for (const std::string& text : {"{\"" + std::string(10'000, 'a') + "\n\": 1}",
                                  "{\"a\": " + std::string(10'000, '1') + "x}",
                                  "{\"" + std::string(10'000, 'a') + "\" 1}"}) {
    const std::string what = testing::ErrorOf([&] { ParseJson(text, "file"); });
    EXPECT_EQ(what.rfind("file: expected JSON, found a ", 0), 0u);
    EXPECT_LT(what.size(), 400u);
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace phongpd
