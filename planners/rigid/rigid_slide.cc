// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_slide.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Of the reach.
constexpr double kSkin = 5e-5;
constexpr double kMaxStep = 0.05;
// Contacts are looked for in so many steps: a row says nothing about what is
// out of reach, and steps may be longer than asked by what they slide off.
constexpr double kContactRange = 1.2;
constexpr double kLongestStep = 3.0;  // of what was asked for
// Of a step: how well its contact is known.
constexpr double kTolerance = 0.1;
constexpr int kMaxMoves = 80;
constexpr int kMaxSlowMoves = 6;
constexpr double kSlow = 0.02;  // of the largest step
// A step that turns back to less, of its length, is none.
constexpr double kLeastMove = 1e-3;
constexpr double kTowWeight = 0.02;
constexpr std::size_t kMaxContacts = 300;
constexpr double kSameRow = 1e-4;  // squared difference
constexpr int kMaxSweeps = 100;
constexpr double kSettled = 1e-9;

}  // namespace

RigidSlide::RigidSlide(const RigidModel& model, bool turns, RigidLinks* links)
    : model_(model),
      turns_(turns),
      links_(links),
      gyration_(model.gyration),
      skin_(kSkin * model.reach),
      max_step_(kMaxStep * model.reach) {}

double RigidSlide::Rest(const RobotPose& pose, const SlidePull& pull) const {
  if (!pull.is_tow) return ObjectDistance(pose, pull.to, gyration_);
  return (pose.orientation * pull.grip + pose.position - pull.place).norm();
}

RigidSlide::Aim RigidSlide::AimFrom(const RobotPose& pose,
                                    const SlidePull& pull, double step) {
  const Step best = BestStep(pose, pull, step);
  Aim aim;
  aim.has_arrived = best.arrived;
  aim.is_step = !(best.move.norm() < kLeastMove * step);
  if (best.arrived || !aim.is_step) return aim;
  aim.pose = Moved(pose, best.move, gyration_);
  aim.is_last = !pull.is_tow && ObjectDistance(aim.pose, pull.to, gyration_) <
                                    kSettled * gyration_;
  if (aim.is_last) aim.pose = pull.to;
  return aim;
}

bool RigidSlide::Slide(const RobotPose& from, const SlidePull& pull,
                       std::vector<RobotPose>* path) {
  path->assign(1, from);
  RobotPose pose = from;
  double rest = Rest(pose, pull), step = max_step_;
  int slow = 0;
  // A step that leads nowhere is tried again, shorter; false: it is too short.
  const auto shortens = [&] {
    if (step < 8.0 * skin_) return false;
    step /= 4.0;
    return true;
  };
  for (int i = 0; i < kMaxMoves && !links_->IsStopped(); ++i) {
    const bool is_straight = i == 0 && !pull.is_tow;
    const Aim aim = is_straight ? Aim{pull.to, true, true, false}
                                : AimFrom(pose, pull, step);
    if (aim.has_arrived) return pull.is_tow;
    if (!aim.is_step) {
      if (!shortens()) break;
      continue;
    }
    const double length = ObjectDistance(pose, aim.pose, gyration_);
    if (!(length > 0.0)) return aim.is_last;
    const RigidMotion motion(pose, aim.pose);
    // Where exactly it meets matters little: the next steps come closer.
    const double tolerance =
        std::max(0.5 * skin_ / length,
                 is_straight ? kTolerance * step / length : kTolerance);
    const double share =
        links_->FreeShare(motion, tolerance, 2.0 * skin_ / length);
    RobotPose next = aim.pose;
    if (share >= 1.0) {
      if (aim.is_last) {
        path->push_back(pull.to);
        return true;
      }
      step = std::min(max_step_, 2.0 * step);
    } else {
      if (!is_straight && share < 0.7) step = std::max(skin_, 0.5 * step);
      if (share * length < 0.2 * skin_) {
        if (!shortens()) break;
        continue;
      }
      next = motion.At(share);
    }
    const double now = Rest(next, pull);
    if (!(now < rest)) {
      step /= 4.0;
      if (step < skin_) break;
      continue;
    }
    path->push_back(next);
    slow = now > rest - kSlow * max_step_ ? slow + 1 : 0;
    if (slow > kMaxSlowMoves) break;
    pose = next;
    rest = now;
  }
  return false;
}

RigidSlide::Step RigidSlide::BestStep(const RobotPose& pose,
                                      const SlidePull& pull, double length) {
  Step best;
  Matrix6 factor = Matrix6::Identity();  // C, of the quadratic form C Cᵀ
  Vector6 wanted;                        // Cᵀ ξ*
  if (pull.is_tow) {
    const Vector3d r = pose.orientation * pull.grip;
    Vector3d g = pull.place - pose.position - r;
    best.arrived = g.norm() < skin_;
    if (best.arrived) return best;
    if (g.norm() > length) g *= length / g.norm();
    Eigen::Matrix<double, 3, 6> grip;
    Eigen::Matrix3d cross;
    cross << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
    grip << Eigen::Matrix3d::Identity(), -cross / gyration_;
    const Matrix6 form =
        grip.transpose() * grip + kTowWeight * Matrix6::Identity();
    factor = form.llt().matrixL();
    wanted = factor.triangularView<Eigen::Lower>().solve(
        Vector6(grip.transpose() * g));
  } else {
    wanted = Difference(pose, pull.to, gyration_);
    const double rest = wanted.norm();
    best.arrived = !(rest > 0.0);
    if (best.arrived) return best;
    if (rest > length) wanted *= length / rest;
  }
  MakeRows(factor, length, pose);
  best.move =
      factor.transpose().triangularView<Eigen::Upper>().solve(Project(wanted));
  const double most = kLongestStep * length;
  if (best.move.norm() > most) best.move *= most / best.move.norm();
  return best;
}

void RigidSlide::MakeRows(const Matrix6& factor, double length,
                          const RobotPose& pose) {
  long tests = 0;
  FindContacts(model_.robot_surface, model_.obstacle_surface, pose,
               kContactRange * length + 2.0 * skin_, &contacts_, &tests,
               kMaxContacts);
  links_->AddTests(tests);
  std::sort(contacts_.begin(), contacts_.end(), IsNearer);
  rows_ = 0;
  for (const PoseContact& contact : contacts_) {
    if (rows_ >= kMaxRows) break;
    Vector6 raw;
    raw << contact.normal, contact.arm.cross(contact.normal) / gyration_;
    if (!turns_) raw.tail<3>().setZero();
    const auto known = raw_.begin() + rows_;
    const bool is_known =
        std::any_of(raw_.begin(), known, [&](const Vector6& other) {
          return (other - raw).squaredNorm() < kSameRow;
        });
    if (is_known) continue;
    const auto row = static_cast<std::size_t>(rows_++);
    raw_[row] = raw;
    directions_[row] = factor.triangularView<Eigen::Lower>().solve(raw);
    squares_[row] = directions_[row].squaredNorm();
    least_[row] = skin_ - contact.gap;
  }
}

Vector6 RigidSlide::Project(const Vector6& wanted) const {
  Vector6 y = wanted;
  std::array<double, kMaxRows> multipliers{};
  const auto rows = static_cast<std::size_t>(rows_);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
      const double missing = (least_[i] - directions_[i].dot(y)) / squares_[i];
      const double multiplier = std::max(0.0, multipliers[i] + missing);
      const double added = multiplier - multipliers[i];
      if (added == 0.0) continue;
      y += added * directions_[i];
      multipliers[i] = multiplier;
      change = std::max(change, std::abs(added) * std::sqrt(squares_[i]));
    }
    if (change <= kSettled * wanted.norm()) break;
  }
  return y;
}

}  // namespace phongpd::internal
