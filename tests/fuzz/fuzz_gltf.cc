// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "problems/meshes/any_mesh.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/promise.h"

namespace phongpd::fuzz {
namespace {

namespace fs = std::filesystem;

// root/ with ok.bin for the file's buffer, and ways out of it: link.bin and d/
// lead to a buffer of other sizes beside root/, fifo.bin never ends.
class StrangersFolder {
 public:
  StrangersFolder() {
    std::string name = (fs::temp_directory_path() / "phongpd_XXXXXX").string();
    Promise(mkdtemp(name.data()) != nullptr, "there is a temporary folder");
    folder_ = name;
    fs::create_directories(folder_ / "root");
    fs::create_directories(folder_ / "secret");
    fs::create_symlink("../secret", folder_ / "root/d");
    fs::create_symlink("../secret/data.bin", folder_ / "root/link.bin");
    mkfifo((folder_ / "root/fifo.bin").c_str(), 0600);
    Put("root/ok.bin", Corners(1.0F));
    Put("secret/data.bin", Corners(kSecret));
  }
  ~StrangersFolder() { fs::remove_all(folder_); }

  static constexpr float kSecret = 7654321.0F;

  void Put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::string At(const std::string& name) const { return folder_ / name; }

 private:
  // Of one triangle.
  static std::string Corners(float size) {
    const float x[9] = {0, 0, 0, size, 0, 0, 0, size, 0};
    return std::string(reinterpret_cast<const char*>(x), sizeof x);
  }

  fs::path folder_;
};

}  // namespace

void Gltf(const std::uint8_t* data, std::size_t size) {
  static const StrangersFolder folder;
  folder.Put("root/a.gltf",
             std::string(reinterpret_cast<const char*>(data), size));
  const std::string file = folder.At("root/a.gltf");
  try {
    const TriangleMesh mesh = ReadAnyMesh(file, nullptr, folder.At("root"));
    Promise(!mesh.triangles.empty(), "a mesh has triangles");
    for (const Eigen::Vector3d& v : mesh.vertices) {
      Promise(v.allFinite(), "coordinates are finite");
      Promise(v.maxCoeff() != StrangersFolder::kSecret,
              "no file outside the root is read");
    }
  } catch (const InputError& error) {
    PromiseReadable(error, file);
    // Its end, as others quote what is in the file.
    const std::string what = error.what(), waited = "takes too long to read";
    Promise(
        what.size() < waited.size() || what.compare(what.size() - waited.size(),
                                                    waited.size(), waited) != 0,
        "nothing is waited for");
  }
}

}  // namespace phongpd::fuzz
