// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "planners/ompl/motion_domain.h"
#include "planners/retraction/contact_model.h"

// Free space for OMPL's planners: a state of a RealVectorStateSpace of
// dimension 3 is a configuration q of a robot that translates.  Use
// MakeSpaceInformation, then any of OMPL's planners.  For a robot that turns:
// rigid_motion_validator.h.
namespace phongpd {

// The state space with the region as its bounds; for a model, its region().
std::shared_ptr<ompl::base::RealVectorStateSpace> MakeConfigurationSpace(
    const BoundingBox& region);
std::shared_ptr<ompl::base::RealVectorStateSpace> MakeConfigurationSpace(
    const ContactModel& model);

// That state space with both classes below, set up and ready for a planner.
// Throws InputError without a model, or without free space.
ompl::base::SpaceInformationPtr MakeSpaceInformation(
    const MotionDomain& domain);
ompl::base::SpaceInformationPtr MakeSpaceInformation(
    const std::shared_ptr<const ContactModel>& model);

// Throws InputError unless the space is a RealVectorStateSpace of dimension 3.
// `name` begins the message.
void CheckConfigurationSpace(const std::string& name,
                             const ompl::base::StateSpace& space);

Eigen::Vector3d ToPoint(const ompl::base::State* state);
void FromPoint(const Eigen::Vector3d& q, ompl::base::State* state);

// isValid: is q free?  Exact.  clearance: the distance from q to the nearest
// contact, user's unit, 0 if q is not free.  Thread-safe.
class ContactSpaceValidityChecker : public ompl::base::StateValidityChecker {
 public:
  ContactSpaceValidityChecker(const ompl::base::SpaceInformationPtr& si,
                              MotionDomain domain);
  ContactSpaceValidityChecker(const ompl::base::SpaceInformationPtr& si,
                              const std::shared_ptr<const ContactModel>& model)
      : ContactSpaceValidityChecker(si, DomainOf(model)) {}

  bool isValid(const ompl::base::State* state) const override;
  double clearance(const ompl::base::State* state) const override;

  std::uint64_t checks() const { return checks_; }

 private:
  MotionDomain domain_;
  mutable std::atomic<std::uint64_t> checks_{0};
};

// Is the whole straight motion free?  Exact, for all its points: no obstacle is
// missed, unlike with OMPL's DiscreteMotionValidator, which tests samples.
// Thread-safe.
class ContactSpaceMotionValidator : public ompl::base::MotionValidator {
 public:
  ContactSpaceMotionValidator(const ompl::base::SpaceInformationPtr& si,
                              MotionDomain domain);
  ContactSpaceMotionValidator(const ompl::base::SpaceInformationPtr& si,
                              const std::shared_ptr<const ContactModel>& model)
      : ContactSpaceMotionValidator(si, DomainOf(model)) {}

  bool checkMotion(const ompl::base::State* s1,
                   const ompl::base::State* s2) const override;

  // If the motion is blocked, lastValid.second is the largest fraction found up
  // to which it is free, and whose state is at least domain().floor() away from
  // contact; 0 if there is none.  (OMPL's planners take that state for a new
  // one.  Without the floor it would lie on the contact surface.)
  bool checkMotion(
      const ompl::base::State* s1, const ompl::base::State* s2,
      std::pair<ompl::base::State*, double>& lastValid) const override;

  const MotionDomain& domain() const { return domain_; }

 private:
  bool Count(bool free) const;

  MotionDomain domain_;
};

}  // namespace phongpd
