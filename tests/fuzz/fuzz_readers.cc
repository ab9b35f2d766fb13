// SPDX-License-Identifier: GPL-3.0-or-later
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/polygon_soup.h"
#include "problems/meshes/robot_link.h"
#include "problems/output/points_csv.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/promise.h"

namespace phongpd::fuzz {
namespace {

std::string_view View(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

void PromiseMesh(const TriangleMesh& mesh) {
  Promise(!mesh.triangles.empty(), "a mesh has triangles");
  for (const Eigen::Vector3d& v : mesh.vertices) {
    Promise(v.allFinite(), "coordinates are finite");
  }
  const int vertices = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) Promise(0 <= v && v < vertices, "indices exist");
  }
}

void ReadMeshAs(internal::MeshFormat format, std::string_view bytes) {
  try {
    PromiseMesh(internal::ReadMeshBytes(format, bytes, "fuzz"));
  } catch (const InputError& error) {
    PromiseReadable(error, "fuzz");
  }
}

}  // namespace

void MeshOff(const std::uint8_t* data, std::size_t size) {
  ReadMeshAs(internal::MeshFormat::kOff, View(data, size));
}
void MeshObj(const std::uint8_t* data, std::size_t size) {
  ReadMeshAs(internal::MeshFormat::kObj, View(data, size));
}
void MeshStl(const std::uint8_t* data, std::size_t size) {
  ReadMeshAs(internal::MeshFormat::kStl, View(data, size));
}
void MeshPly(const std::uint8_t* data, std::size_t size) {
  ReadMeshAs(internal::MeshFormat::kPly, View(data, size));
}

#ifdef PHONGPD_FUZZES_ROBOTS
void Robot(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  constexpr const char* kParts[] = {"", "#a", "@", "@j=0.5", "@j=0.5,k=-1"};
  const std::string part = kParts[data[0] % std::size(kParts)];
  const std::string bytes(View(data + 1, size - 1));
  try {
    std::vector<std::string> notes;
    // Mesh files would have to lie below what is no folder.
    PromiseMesh(ParseRobot(bytes, "fuzz", part, "/dev/null", &notes));
  } catch (const InputError& error) {
    const bool is_root = std::string(error.what()).rfind("/dev/null", 0) == 0;
    if (!is_root) PromiseReadable(error, "fuzz");
  }
}
#endif

void PointsCsv(const std::uint8_t* data, std::size_t size) {
  try {
    for (const Eigen::Vector3d& p : ParsePointsCsv(View(data, size), "fuzz")) {
      Promise(p.allFinite(), "points are finite");
    }
  } catch (const InputError& error) {
    PromiseReadable(error, "fuzz");
  }
}

}  // namespace phongpd::fuzz
