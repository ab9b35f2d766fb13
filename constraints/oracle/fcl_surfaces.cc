// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/oracle/fcl_surfaces.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace phongpd {
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

fcl::Transform3d Placed(const RobotPose& pose) {
  fcl::Transform3d placed = fcl::Transform3d::Identity();
  placed.linear() = pose.orientation.toRotationMatrix();
  placed.translation() = pose.position;
  return placed;
}

const fcl::Transform3d& Still() {
  static const fcl::Transform3d identity = fcl::Transform3d::Identity();
  return identity;
}

}  // namespace

struct FclSurfaces::Impl {
  Model robot, obstacle;

  bool MeetAlong(const fcl::MotionBased& motion, fcl::CCDMotionType type,
                 Solver solver) const;
};

bool FclSurfaces::Impl::MeetAlong(const fcl::MotionBased& motion,
                                  fcl::CCDMotionType type,
                                  Solver solver) const {
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = type;
  request.ccd_solver_type = solver == Solver::kPlacements
                                ? fcl::CCDC_NAIVE
                                : fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  const fcl::TranslationMotiond still(Still(), Still());
  fcl::ContinuousCollisionResultd result;
  try {
    fcl::continuousCollide(&robot, &motion, &obstacle, &still, request, result);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("FCL continuousCollide failed: ") +
                             error.what());
  }
  return result.is_collide;
}

FclSurfaces::FclSurfaces(const TriangleMesh& robot,
                         const TriangleMesh& obstacle)
    : impl_(std::make_unique<Impl>()) {
  Fill(robot, &impl_->robot);
  Fill(obstacle, &impl_->obstacle);
}

FclSurfaces::~FclSurfaces() = default;
FclSurfaces::FclSurfaces(FclSurfaces&&) noexcept = default;
FclSurfaces& FclSurfaces::operator=(FclSurfaces&&) noexcept = default;

bool FclSurfaces::Meet(const Eigen::Vector3d& q) const {
  return Meet(RobotPose{q, Eigen::Quaterniond::Identity()});
}

bool FclSurfaces::Meet(const RobotPose& pose) const {
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  try {
    fcl::collide(&impl_->robot, Placed(pose), &impl_->obstacle, Still(),
                 request, result);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("FCL collide failed: ") +
                             error.what());
  }
  return result.isCollision();
}

bool FclSurfaces::Meet(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       Solver solver) const {
  const auto at = [](const Eigen::Vector3d& q) {
    return Placed({q, Eigen::Quaterniond::Identity()});
  };
  const fcl::TranslationMotiond motion(at(a), at(b));
  return impl_->MeetAlong(motion, fcl::CCDM_TRANS, solver);
}

bool FclSurfaces::Meet(const RobotPose& a, const RobotPose& b,
                       Solver solver) const {
  const fcl::InterpMotion<double> motion(
      a.orientation.toRotationMatrix(), a.position,
      b.orientation.toRotationMatrix(), b.position, Eigen::Vector3d::Zero());
  return impl_->MeetAlong(motion, fcl::CCDM_LINEAR, solver);
}

}  // namespace phongpd
