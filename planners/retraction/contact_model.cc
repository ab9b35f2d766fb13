// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/contact_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/numbers.h"
#include "core/mesh/unit_normal.h"
#include "core/projection/contact_surface.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "planners/exact/free_cells.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Triangles closer to the start of a ray than this touch it: well above the
// rounding of a contact point, well below the floor.
double TouchRadius(const BoundingBox& region) {
  const double largest =
      region.min.cwiseAbs().cwiseMax(region.max.cwiseAbs()).maxCoeff();
  return 1e-11 * region.Diagonal() +
         16.0 * std::numeric_limits<double>::epsilon() * largest;
}

struct Space {
  Space(const ContactSpace& contact_space, const PhongMetricOptions& options)
      : contact(contact_space),
        euclidean(contact),
        phong(contact, options),
        segments(contact.bvh()) {
    const TriangleMesh& mesh = contact.mesh();
    neighbors = TriangleNeighbors(mesh);
    normals.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      normals.push_back(UnitNormal(mesh, t));
    }
  }

  ContactSpace contact;
  EuclideanMetric euclidean;
  PhongMetric phong;
  const TriangleBvh& segments;  // of the contact space
  std::vector<Vector3d> normals;
  std::vector<std::array<int, 3>> neighbors;
};

using internal::At;

// Around all that an unbounded cell holds, of its diagonal.
constexpr double kRoom = 0.1;
// Off a corner where the first way runs within the other wall, off both walls,
// and to the middle of what is left.
constexpr int kLifts = 4;

// The box around both; either may be empty.
BoundingBox Hull(const BoundingBox& a, const BoundingBox& b) {
  if (a.IsEmpty()) return b;
  if (b.IsEmpty()) return a;
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

}  // namespace

BoundingBox SamplingRegion(const ContactSpace& space, const Vector3d& start,
                           const Vector3d& goal) {
  const TriangleMesh& contact_mesh = space.mesh();
  BoundingBox all = space.bounds();
  for (const Vector3d& q : {start, goal}) {
    if (IsFinite(q)) all = Hull(all, {q, q});
  }
  // Any way through the outside can be bent into the room around.
  const Vector3d room = Vector3d::Constant(kRoom * all.Diagonal());
  all = {all.min - room, all.max + room};
  const auto neighbors = TriangleNeighbors(contact_mesh);
  const FreeCells cells(contact_mesh, neighbors, space.bvh());
  BoundingBox region = FreeSpace::NoBounds();
  for (const Vector3d& q : {start, goal}) {
    CellRay ray;
    const int cell = IsFinite(q) ? cells.CellOf(q, &ray) : -1;
    if (cell < 0) return all;
    TriangleMesh shell;
    shell.vertices = contact_mesh.vertices;
    for (std::size_t t = 0; t < contact_mesh.triangles.size(); ++t) {
      if (cells.piece()[t] == cell) {
        shell.triangles.push_back(contact_mesh.triangles[t]);
      }
    }
    region = Hull(region, ComputeBounds(shell));
  }
  return region;
}

struct ContactModel::Impl {
  Impl(const std::vector<ContactSpace>& given, const BoundingBox& bounds,
       const PhongFieldOptions& field)
      : free_space(given, bounds), region(bounds) {
    PhongMetricOptions options;
    options.field_options = field;
    spaces.reserve(given.size());
    for (const ContactSpace& one : given) spaces.emplace_back(one, options);
    if (bounds.IsEmpty() && given.empty()) {
      throw InputError("contact model: expected contact spaces or bounds");
    }
    if (bounds.IsEmpty()) {
      for (const ContactSpace& one : given) region = Hull(region, one.bounds());
    }
    touch = TouchRadius(region);
  }

  FreeSpace free_space;
  BoundingBox region;
  double touch = 0.0;  // TouchRadius(region)
  std::vector<Space> spaces;
};

ContactModel::ContactModel(const std::vector<ContactSpace>& spaces,
                           const BoundingBox& bounds,
                           const PhongFieldOptions& field)
    : impl_(std::make_unique<Impl>(spaces, bounds, field)) {}
ContactModel::~ContactModel() = default;
ContactModel::ContactModel(ContactModel&&) noexcept = default;
ContactModel& ContactModel::operator=(ContactModel&&) noexcept = default;

const FreeSpace& ContactModel::free_space() const { return impl_->free_space; }
const BoundingBox& ContactModel::region() const { return impl_->region; }
const ContactSpace& ContactModel::space(int space) const {
  return impl_->spaces[At(space)].contact;
}
const PhongMetric& ContactModel::phong(int space) const {
  return impl_->spaces[At(space)].phong;
}
const std::vector<std::array<int, 3>>& ContactModel::Neighbors(
    int space) const {
  return impl_->spaces[At(space)].neighbors;
}

const Vector3d& ContactModel::Normal(int space, int triangle) const {
  return impl_->spaces[At(space)].normals[At(triangle)];
}

ContactModel::Facet ContactModel::FacetMet(const Vector3d& a, const Vector3d& b,
                                           const MotionCheck& check) const {
  const Vector3d motion = b - a;
  Facet facet;
  facet.space = check.obstacle;
  facet.triangle = check.triangle;
  facet.point = a + check.fraction * motion;
  if (check.obstacle == MotionCheck::kBounds) {
    const BoundingBox& bounds = impl_->free_space.bounds();
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      if (motion[k] == 0.0) continue;
      const double wall = motion[k] > 0.0 ? bounds.max[k] : bounds.min[k];
      const double fraction = (wall - a[k]) / motion[k];
      if (fraction >= least) continue;
      least = fraction;
      facet.normal = motion[k] > 0.0 ? Vector3d(-Vector3d::Unit(k))
                                     : Vector3d(Vector3d::Unit(k));
    }
    return facet;
  }
  facet.normal = Normal(check.obstacle, check.triangle);
  const double length = motion.norm();
  double opposed = facet.normal.dot(motion);
  if (opposed < -1e-9 * length) return facet;
  // The motion enters through an edge of a facet it is (nearly) parallel to.
  const Space& space = impl_->spaces[At(check.obstacle)];
  const double reach = check.fraction + impl_->touch / length;
  space.segments.ForEachHit(a, b, [&](int triangle, double fraction) {
    const Vector3d& normal = space.normals[At(triangle)];
    if (fraction > reach || normal.dot(motion) >= opposed) return;
    opposed = normal.dot(motion);
    facet.triangle = triangle;
    facet.normal = normal;
  });
  return facet;
}

ContactModel::Facet ContactModel::FindNearest(const Vector3d& q,
                                              double* distance) const {
  Facet facet;
  *distance = std::numeric_limits<double>::infinity();
  if (!IsFinite(q)) {
    *distance = -*distance;
    return facet;
  }
  for (std::size_t i = 0; i < impl_->spaces.size(); ++i) {
    const PenetrationResult answer = impl_->spaces[i].euclidean.Query(q);
    if (answer.status == QueryStatus::kInvalid) {
      *distance = -std::numeric_limits<double>::infinity();
      return {};
    }
    if (answer.signed_distance >= *distance) continue;
    *distance = answer.signed_distance;
    facet.space = static_cast<int>(i);
    facet.triangle = answer.triangle;
    facet.point = answer.contact;
    facet.normal = impl_->spaces[i].normals[At(answer.triangle)];
  }
  const BoundingBox& bounds = impl_->free_space.bounds();
  for (int k = 0; k < 3 && !bounds.IsEmpty(); ++k) {
    for (const double side : {-1.0, 1.0}) {
      const double wall = side > 0.0 ? bounds.max[k] : bounds.min[k];
      if (side * (wall - q[k]) >= *distance) continue;
      *distance = side * (wall - q[k]);
      facet.space = MotionCheck::kBounds;
      facet.triangle = -1;
      facet.point = q;
      facet.point[k] = wall;
      facet.normal = -side * Vector3d::Unit(k);
    }
  }
  return facet;
}

double ContactModel::Standoff(const Facet& facet, double clearance) const {
  const Vector3d ray = 2.0 * clearance * facet.normal;
  const Vector3d end = facet.point + ray;
  if (!IsFinite(end) || facet.normal.isZero()) return 0.0;
  double free = 1.0;
  for (const Space& space : impl_->spaces) {
    const TriangleBvh::Hit hit =
        space.segments.FirstHitBeyond(facet.point, end, impl_->touch);
    if (hit.Found()) free = std::min(free, hit.fraction);
  }
  const BoundingBox& bounds = impl_->free_space.bounds();
  for (int k = 0; k < 3 && !bounds.IsEmpty(); ++k) {
    if (ray[k] == 0.0) continue;
    const double wall = ray[k] > 0.0 ? bounds.max[k] : bounds.min[k];
    free = std::min(free, (wall - facet.point[k]) / ray[k]);
  }
  return std::max(0.0, free * clearance);
}

bool ContactModel::LiftOff(Facet facet, double clearance, Vector3d* q,
                           double* room) const {
  // Beyond the bounds, as the outside of a bounds shell is, nothing is free.
  const BoundingBox& bounds = impl_->free_space.bounds();
  const double slack = impl_->touch;
  if (!bounds.IsEmpty() &&
      ((facet.point.array() < bounds.min.array() - slack).any() ||
       (facet.point.array() > bounds.max.array() + slack).any())) {
    return false;
  }
  double best = 0.0;
  for (int lift = 0; lift < kLifts; ++lift) {
    const double standoff = Standoff(facet, clearance);
    if (!(standoff >= floor())) break;
    const Vector3d p = facet.point + standoff * facet.normal;
    double distance = 0.0;
    facet = FindNearest(p, &distance);
    if (distance >= floor() && distance > best) {
      best = distance;
      *q = p;
      *room = distance;
    }
    if (distance >= 0.5 * standoff) break;
  }
  return best > 0.0;
}

}  // namespace phongpd
