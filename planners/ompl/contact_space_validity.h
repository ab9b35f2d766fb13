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

// OMPL's view of free space: states of a RealVectorStateSpace of dimension 3
// are configurations q.
namespace phongpd {

// The space of q with the region as bounds.
std::shared_ptr<ompl::base::RealVectorStateSpace> MakeConfigurationSpace(
    const BoundingBox& region);
std::shared_ptr<ompl::base::RealVectorStateSpace> MakeConfigurationSpace(
    const ContactModel& model);

// That space with both classes below, set up.  Throws InputError without a
// model, or without free space.
ompl::base::SpaceInformationPtr MakeSpaceInformation(
    const MotionDomain& domain);
ompl::base::SpaceInformationPtr MakeSpaceInformation(
    const std::shared_ptr<const ContactModel>& model);

// Throws InputError, which begins with `name`, unless the space is a
// RealVectorStateSpace of dimension 3.
void CheckConfigurationSpace(const std::string& name,
                             const ompl::base::StateSpace& space);

Eigen::Vector3d ToPoint(const ompl::base::State* state);
void FromPoint(const Eigen::Vector3d& q, ompl::base::State* state);

// Is q free?  Exact; clearance is the distance to what is nearest, 0 where q
// is not free.  Thread-safe.
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

// Is the whole motion free?  Exact, without a resolution: obstacles that fall
// between the samples of OMPL's DiscreteMotionValidator are seen.  Thread-safe.
class ContactSpaceMotionValidator : public ompl::base::MotionValidator {
 public:
  ContactSpaceMotionValidator(const ompl::base::SpaceInformationPtr& si,
                              MotionDomain domain);
  ContactSpaceMotionValidator(const ompl::base::SpaceInformationPtr& si,
                              const std::shared_ptr<const ContactModel>& model)
      : ContactSpaceMotionValidator(si, DomainOf(model)) {}

  bool checkMotion(const ompl::base::State* s1,
                   const ompl::base::State* s2) const override;

  // If blocked, lastValid.second is the largest fraction found such that the
  // motion up to it is exactly free and its end keeps domain().floor(): OMPL's
  // samplers make states of it, which would lie on the contact surface.  0 if
  // there is none.
  bool checkMotion(
      const ompl::base::State* s1, const ompl::base::State* s2,
      std::pair<ompl::base::State*, double>& lastValid) const override;

  const MotionDomain& domain() const { return domain_; }

 private:
  bool Count(bool free) const;

  MotionDomain domain_;
};

}  // namespace phongpd
