// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/mesh/numbers.h"
#include "core/projection/phong_field.h"
#include "core/projection/tangent_plane_field.h"
#include "problems/shapes/shapes.h"

namespace phongpd::testing {

using internal::At;

// A field and its tangent planes.
struct TangentPlaneCase {
  PhongField field;
  TangentPlaneField planes;

  explicit TangentPlaneCase(PhongField f)
      : field(std::move(f)), planes(BuildTangentPlaneField(field)) {}
};

// Of solids with sharp, blunt and re-entrant edges, as they are and smoothed.
inline std::vector<TangentPlaneCase> TangentPlaneCases() {
  const Eigen::Matrix3d turn = GenericRotation();
  std::vector<TangentPlaneCase> result;
  for (const double ell : {0.0, 0.15}) {
    PhongFieldOptions options;
    options.smoothing_length = ell;
    for (const TriangleMesh& mesh :
         {MakeBox(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3)),
          Rotated(MakeU(1.0, 0.2, 0.5), turn), MakeStar(1.0, 2.0),
          Rotated(MakeCone(1.0, 2.0, 12), turn), MakeIcoBall(1.0, 2)}) {
      result.emplace_back(BuildPhongField(TakeAsContactSpace(mesh), options));
    }
  }
  return result;
}

// A field of one triangle with the given vertex normals.
inline TangentPlaneCase OneTriangle(
    const std::array<Eigen::Vector3d, 3>& normals) {
  PhongField field;
  field.mesh.vertices = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0.1, 0),
                         Eigen::Vector3d(0.2, 0.9, 0)};
  field.mesh.triangles = {{0, 1, 2}};
  for (const Eigen::Vector3d& n : normals)
    field.normals.push_back(n.normalized());
  return TangentPlaneCase(field);
}

// The normalised linear interpolation of the normals.
inline Eigen::Vector3d Linear(const PhongField& field, int t,
                              const Eigen::Vector3d& lambda) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += lambda[static_cast<Eigen::Index>(k)] *
           field.normals[At(field.mesh.triangles[At(t)][k])];
  }
  return sum.normalized();
}

inline Eigen::Vector3d Point(const PhongField& field, int t,
                             const Eigen::Vector3d& lambda) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += lambda[static_cast<Eigen::Index>(k)] *
           field.mesh.vertices[At(field.mesh.triangles[At(t)][k])];
  }
  return sum;
}

// λ on the edge from vertex k.
inline Eigen::Vector3d OnEdge(int k, double u) {
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
  lambda[k] = 1.0 - u;
  lambda[(k + 1) % 3] = u;
  return lambda;
}

}  // namespace phongpd::testing
