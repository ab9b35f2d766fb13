// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/oracle/collision_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <memory>
#include <string>
#include <vector>

#include "constraints/oracle/fcl_surfaces.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using SideOf = CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel>;

// One closed component.  Its bounded side adds `sign` to the winding number
// of the solid: +1 for a body, -1 for a cavity.
struct Component {
  int sign = 1;
  Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
  std::unique_ptr<SurfaceMesh> mesh;  // side_of points into it
  std::unique_ptr<SideOf> side_of;
};

std::unique_ptr<SurfaceMesh> ToSurfaceMesh(const TriangleMesh& mesh) {
  std::vector<int> index(mesh.vertices.size(), -1);
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Triangle& triangle : mesh.triangles) {
    std::vector<std::size_t>& polygon = polygons.emplace_back();
    for (const int v : triangle) {
      int& i = index[static_cast<std::size_t>(v)];
      if (i < 0) {
        i = static_cast<int>(points.size());
        const Eigen::Vector3d& p = mesh.vertices[static_cast<std::size_t>(v)];
        points.emplace_back(p.x(), p.y(), p.z());
      }
      polygon.push_back(static_cast<std::size_t>(i));
    }
  }
  // The half-edge structure holds one fan a vertex: this doubles the vertices
  // where a surface is pinched.  Parity of ray crossings does not mind.
  pmp::orient_polygon_soup(points, polygons);
  auto result = std::make_unique<SurfaceMesh>();
  pmp::polygon_soup_to_polygon_mesh(points, polygons, *result);
  return result;
}

// The union of the bodies less their cavities: points of winding number > 0.
// Components are asked one by one, because overlapping bodies make the parity
// of all surfaces together wrong.
class Bodies {
 public:
  explicit Bodies(const TriangleMesh& mesh) {
    int count = 0;
    const std::vector<int> label = LabelComponents(mesh, &count);
    std::vector<TriangleMesh> parts(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      parts[static_cast<std::size_t>(label[t])].triangles.push_back(
          mesh.triangles[t]);
    }
    for (TriangleMesh& part : parts) {
      part.vertices = mesh.vertices;
      Component& c = components_.emplace_back();
      c.sign = SignedVolume(part) < 0.0 ? -1 : 1;
      c.vertex = mesh.vertices[static_cast<std::size_t>(part.triangles[0][0])];
      c.mesh = ToSurfaceMesh(part);
      c.side_of = std::make_unique<SideOf>(*c.mesh);
      // The tree is built by the first question; ask it now, so that later
      // ones only read.
      (*c.side_of)(Point(c.vertex.x(), c.vertex.y(), c.vertex.z()));
    }
  }

  const std::vector<Component>& components() const { return components_; }

  // Closed: points of the surface count as inside.
  bool Contains(const Eigen::Vector3d& p) const {
    const Point point(p.x(), p.y(), p.z());
    int winding = 0;
    for (const Component& c : components_) {
      const CGAL::Bounded_side side = (*c.side_of)(point);
      if (side == CGAL::ON_BOUNDED_SIDE ||
          (side == CGAL::ON_BOUNDARY && c.sign > 0)) {
        winding += c.sign;
      }
    }
    return winding > 0;
  }

 private:
  std::vector<Component> components_;
};

}  // namespace

struct CollisionOracle::Impl {
  Impl(const TriangleMesh& robot_mesh, const TriangleMesh& obstacle_mesh)
      : robot(robot_mesh),
        obstacle(obstacle_mesh),
        surfaces(robot_mesh, obstacle_mesh) {}

  Bodies robot;
  Bodies obstacle;
  FclSurfaces surfaces;
};

CollisionOracle::CollisionOracle(const Solid& robot, const Solid& obstacle) {
  RequireNotEmpty(robot, "collision oracle: robot");
  RequireNotEmpty(obstacle, "collision oracle: obstacle");
  impl_ = std::make_unique<Impl>(robot, obstacle);
}

CollisionOracle::~CollisionOracle() = default;
CollisionOracle::CollisionOracle(CollisionOracle&&) noexcept = default;
CollisionOracle& CollisionOracle::operator=(CollisionOracle&&) noexcept =
    default;

bool CollisionOracle::Collides(const Eigen::Vector3d& q) const {
  if (!IsFinite(q)) {
    throw InputError("collision oracle: the configuration must be finite");
  }
  if (impl_->surfaces.Meet(q)) return true;
  // Disjoint surfaces: the solids share a point iff one whole component of
  // one lies in the other, and any of its vertices shows it.
  for (const Component& c : impl_->robot.components()) {
    if (impl_->obstacle.Contains(c.vertex + q)) return true;
  }
  for (const Component& c : impl_->obstacle.components()) {
    if (impl_->robot.Contains(c.vertex - q)) return true;
  }
  return false;
}

}  // namespace phongpd
