// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/contact/surface_description.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/unit_normal.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Counts half-edges without exactly one opposite.
std::size_t CountBadEdges(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  std::size_t bad = 0;
  for (const auto& [a, b] : edges) {
    const auto same =
        std::equal_range(edges.begin(), edges.end(), std::make_pair(a, b));
    const auto opposite =
        std::equal_range(edges.begin(), edges.end(), std::make_pair(b, a));
    if (same.second - same.first != 1 ||
        opposite.second - opposite.first != 1) {
      ++bad;
    }
  }
  return bad;
}

void CheckContactMesh(const TriangleMesh& mesh, const std::string& who) {
  const std::string name = who + ": ";
  if (mesh.triangles.empty()) throw InputError(name + "no triangle");
  const int size = static_cast<int>(mesh.vertices.size());
  std::size_t bad_indices = 0, bad_vertices = 0;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      const bool valid = v >= 0 && v < size;
      bad_indices += !valid;
      bad_vertices += valid && !IsFinite(mesh.vertices[v]);
    }
  }
  if (bad_indices > 0) {
    throw InputError(name + std::to_string(bad_indices) +
                     " vertex indices out of range");
  }
  if (bad_vertices > 0) {
    throw InputError(name + std::to_string(bad_vertices) +
                     " corners with non-finite coordinates");
  }
  const double diagonal = ComputeBounds(mesh).Diagonal();
  if (!(diagonal >= 1e-150 && diagonal <= 1e150)) {
    throw InputError(name +
                     "diagonal of the bounding box must be between "
                     "1e-150 and 1e150, found " +
                     std::to_string(diagonal));
  }
  const std::size_t bad_edges = CountBadEdges(mesh);
  if (bad_edges > 0) {
    throw InputError(name + "expected a closed, edge-manifold mesh, found " +
                     std::to_string(bad_edges) +
                     " half-edges without exactly one opposite");
  }
}

// The two shortest edges give the best-conditioned normal.
Vector3d FacetNormal(const TriangleMesh& mesh, const Triangle& t,
                     double scale) {
  const Vector3d e1 = (mesh.vertices[t[1]] - mesh.vertices[t[0]]) * scale;
  const Vector3d e2 = (mesh.vertices[t[2]] - mesh.vertices[t[0]]) * scale;
  const Vector3d e3 = e2 - e1;
  const double l1 = e1.squaredNorm(), l2 = e2.squaredNorm(),
               l3 = e3.squaredNorm();
  return Unit(l1 >= l2 && l1 >= l3   ? e3.cross(Vector3d(-e2))
              : l2 >= l1 && l2 >= l3 ? e1.cross(e3)
                                     : e1.cross(e2));
}

}  // namespace

struct ContactSpace::Indexes {
  std::once_flag bvh_built, normals_built;
  TriangleBvh bvh;
  std::vector<Vector3d> normals;
};

ContactSpace::Data::Data() : indexes(std::make_unique<Indexes>()) {}
ContactSpace::Data::~Data() = default;

ContactSpace::ContactSpace(Parts parts, const std::string& name)
    : data_(MakeData(std::move(parts), name)) {}

std::shared_ptr<ContactSpace::Data> ContactSpace::MakeData(
    Parts parts, const std::string& name) {
  CheckContactMesh(parts.mesh, name);
  for (const std::size_t size : {parts.plane.size(), parts.kind.size()}) {
    if (size != 0 && size != parts.mesh.triangles.size()) {
      throw InputError(name + ": expected planes and kinds of " +
                       std::to_string(parts.mesh.triangles.size()) +
                       " triangles or of none, found " + std::to_string(size));
    }
  }
  auto data = std::make_shared<Data>();
  data->parts = std::move(parts);
  data->bounds = ComputeBounds(data->parts.mesh);
  return data;
}

ContactSpace ContactSpace::WithLength(double length) const {
  if (!(length > 0.0 && std::isfinite(length))) {
    throw InputError("length: expected finite and > 0, found " +
                     std::to_string(length));
  }
  ContactSpace other = *this;
  other.length_ = length;
  return other;
}

const TriangleBvh& ContactSpace::bvh() const {
  Indexes& indexes = *data_->indexes;
  std::call_once(indexes.bvh_built,
                 [&] { indexes.bvh = TriangleBvh(data_->parts.mesh); });
  return indexes.bvh;
}

const std::vector<Vector3d>& ContactSpace::normals() const {
  Indexes& indexes = *data_->indexes;
  std::call_once(indexes.normals_built, [&] {
    const double diagonal = data_->bounds.Diagonal();
    const double scale = std::ldexp(1.0, -std::ilogb(diagonal));
    const TriangleMesh& mesh = data_->parts.mesh;
    indexes.normals.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      indexes.normals.push_back(FacetNormal(mesh, t, scale));
    }
  });
  return indexes.normals;
}

std::vector<ContactSpace> WithCommonLength(std::vector<ContactSpace> spaces) {
  if (spaces.empty()) return spaces;
  BoundingBox box = spaces[0].bounds();
  bool agree = spaces[0].HasOwnLength();
  for (const ContactSpace& space : spaces) {
    agree = agree && space.length() == spaces[0].length();
    box.min = box.min.cwiseMin(space.bounds().min);
    box.max = box.max.cwiseMax(space.bounds().max);
  }
  if (agree) return spaces;
  for (ContactSpace& space : spaces) space = space.WithLength(box.Diagonal());
  return spaces;
}

ContactSpace TakeAsContactSpace(TriangleMesh mesh, const std::string& name) {
  ContactSpace::Parts parts;
  parts.mesh = std::move(mesh);
  parts.report.method = "taken from a mesh";
  auto data = ContactSpace::MakeData(std::move(parts), name);
  internal::DescribeSurface(data->parts.mesh, &data->parts.report);
  ContactSpace space;
  space.data_ = std::move(data);
  return space;
}

}  // namespace phongpd
