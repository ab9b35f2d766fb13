// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/fcl_motions.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <stdexcept>
#include <vector>

namespace phongpd::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

void Fill(const TriangleMesh& mesh, Model* model) {
  std::vector<fcl::Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]),
                           static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  const bool built =
      model->beginModel() == fcl::BVH_OK &&
      model->addSubModel(mesh.vertices, triangles) == fcl::BVH_OK &&
      model->endModel() == fcl::BVH_OK;
  if (!built) throw std::runtime_error("FCL could not build its box tree");
}

}  // namespace

struct FclMotions::Impl {
  Model robot, obstacle;
};

FclMotions::FclMotions(const TriangleMesh& robot, const TriangleMesh& obstacle)
    : impl_(std::make_unique<Impl>()) {
  Fill(robot, &impl_->robot);
  Fill(obstacle, &impl_->obstacle);
}
FclMotions::~FclMotions() = default;
FclMotions::FclMotions(FclMotions&&) noexcept = default;

bool FclMotions::Collides(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          Solver solver) const {
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_TRANS;
  request.ccd_solver_type = solver == Solver::kDefault
                                ? fcl::CCDC_NAIVE
                                : fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  fcl::Transform3d from = fcl::Transform3d::Identity(), to = from;
  from.translation() = a;
  to.translation() = b;
  const fcl::Transform3d still = fcl::Transform3d::Identity();
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(&impl_->robot, from, to, &impl_->obstacle, still,
                         still, request, result);
  return result.is_collide;
}

}  // namespace phongpd::bench
