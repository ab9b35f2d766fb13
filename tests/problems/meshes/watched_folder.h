// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/mesh/mesh_io.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/meshes/mesh_files.h"
#include "tests/support/temporary_folder.h"

namespace phongpd::testing {

// A folder root/ for the files of a stranger, and beside it secret/, of which
// the kernel tells whenever anybody opens or reads a file in it.  In root/
// there are a block to be read, ok.off, sub/ok.off, and the buffers of such a
// glTF, ok.bin, sub/ok.bin; ways that lead to secret/data.bin and data.off: d
// (a link to the folder), link.bin, link.off and out.gltf; and things that are
// no files: fifo.bin, fifo.off, zero.bin (a link to a device), folder.bin.
class WatchedFolder : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    namespace fs = std::filesystem;
    fs::create_directories(folder_ / "root/sub");
    fs::create_directory(folder_ / "root/folder.bin");
    fs::create_directory(folder_ / "secret");
    fs::create_symlink("../secret", folder_ / "root/d");
    for (const std::string extension : {".bin", ".off"}) {
      fs::create_symlink("../secret/data" + extension,
                         folder_ / ("root/link" + extension));
      ASSERT_EQ(mkfifo(At("root/fifo" + extension).c_str(), 0600), 0);
    }
    fs::create_symlink("/dev/zero", folder_ / "root/zero.bin");
    for (const std::string name : {"root/ok", "root/sub/ok", "secret/data"}) {
      Put(name + ".bin", GltfBuffer(Block()));
      WriteMesh(Block(), At(name + ".off"));
    }
    Put("secret/data.gltf", Gltf("data.bin"));
    Put("root/out.gltf", Gltf("d/data.bin"));
    watch_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    ASSERT_GE(watch_, 0);
    ASSERT_GE(
        inotify_add_watch(watch_, At("secret").c_str(), IN_OPEN | IN_ACCESS),
        0);
  }
  void TearDown() override {
    if (watch_ >= 0) close(watch_);
    TemporaryFolder::TearDown();
  }

  static TriangleMesh Block() { return MakeBox({0, 0, 0}, {1, 2, 3}); }

  // Files that name another one.
  static std::string Gltf(const std::string& uri) {
    return GltfJson(Block(), "\"uri\":\"" + uri + "\",");
  }
  static std::string Urdf(const std::string& mesh) {
    return "<robot name='r'><link name='a'><collision><geometry><mesh "
           "filename='" +
           mesh + "'/></geometry></collision></link></robot>";
  }
  static std::string Sdf(const std::string& mesh) {
    return "<sdf version='1.6'><model name='m'><link name='a'><collision "
           "name='c'><geometry><mesh><uri>" +
           mesh + "</uri></mesh></geometry></collision></link></model></sdf>";
  }
  // A COLLADA file whose pictures are others.
  static std::string ColladaWith(const std::string& images) {
    std::string bytes = Collada(Block(), "");
    bytes.insert(bytes.find("<library_geometries>"),
                 "<library_images>" + images + "</library_images>");
    return bytes;
  }
  static std::string Image(const std::string& file) {
    return "<image id='" + file + "'><init_from>" + file +
           "</init_from></image>";
  }

  // Has anybody been in secret/ since it was last asked?
  bool WasEntered() const {
    char buffer[4096];
    bool was = false;
    while (read(watch_, buffer, sizeof buffer) > 0) was = true;
    return was;
  }

 private:
  int watch_ = -1;
};

}  // namespace phongpd::testing
