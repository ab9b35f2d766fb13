// SPDX-License-Identifier: GPL-3.0-or-later
#include <string_view>

#include "core/mesh/polygon_soup.h"
#include "problems/output/points_csv.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/promise.h"

namespace phongpd::fuzz {
namespace {

std::string_view View(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

void ReadMeshAs(internal::MeshFormat format, std::string_view bytes) {
  try {
    const TriangleMesh mesh = internal::ReadMeshBytes(format, bytes, "fuzz");
    Promise(!mesh.triangles.empty(), "a mesh has triangles");
    for (const Eigen::Vector3d& v : mesh.vertices) {
      Promise(v.allFinite(), "coordinates are finite");
    }
    const int vertices = static_cast<int>(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
      for (const int v : t) Promise(0 <= v && v < vertices, "indices exist");
    }
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
