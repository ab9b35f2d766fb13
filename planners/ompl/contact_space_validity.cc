// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/contact_space_validity.h"

#include <ompl/base/SpaceInformation.h>

#include "core/mesh/mesh_error.h"

namespace phongpd {

namespace ob = ompl::base;
using Eigen::Vector3d;

std::shared_ptr<ob::RealVectorStateSpace> MakeConfigurationSpace(
    const BoundingBox& region) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  for (unsigned int k = 0; k < 3; ++k) {
    bounds.setLow(k, region.min[k]);
    bounds.setHigh(k, region.max[k]);
  }
  space->setBounds(bounds);
  return space;
}

std::shared_ptr<ob::RealVectorStateSpace> MakeConfigurationSpace(
    const ContactModel& model) {
  return MakeConfigurationSpace(model.region());
}

ob::SpaceInformationPtr MakeSpaceInformation(const MotionDomain& domain) {
  if (!domain.free_space) {
    throw InputError("space information: expected free space, found none");
  }
  auto si = std::make_shared<ob::SpaceInformation>(
      MakeConfigurationSpace(domain.region));
  si->setStateValidityChecker(
      std::make_shared<ContactSpaceValidityChecker>(si, domain));
  si->setMotionValidator(
      std::make_shared<ContactSpaceMotionValidator>(si, domain));
  si->setup();
  return si;
}

ob::SpaceInformationPtr MakeSpaceInformation(
    const std::shared_ptr<const ContactModel>& model) {
  if (!model) throw InputError("space information: expected a contact model");
  return MakeSpaceInformation(DomainOf(model));
}

void CheckConfigurationSpace(const std::string& name,
                             const ob::StateSpace& space) {
  if (dynamic_cast<const ob::RealVectorStateSpace*>(&space) != nullptr &&
      space.getDimension() == 3) {
    return;
  }
  throw InputError(name +
                   ": expected a RealVectorStateSpace of dimension 3, found '" +
                   space.getName() + "' of dimension " +
                   std::to_string(space.getDimension()));
}

Vector3d ToPoint(const ob::State* state) {
  const double* q = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return Vector3d(q[0], q[1], q[2]);
}

void FromPoint(const Vector3d& q, ob::State* state) {
  double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  for (int k = 0; k < 3; ++k) values[k] = q[k];
}

ContactSpaceValidityChecker::ContactSpaceValidityChecker(
    const ob::SpaceInformationPtr& si, MotionDomain domain)
    : StateValidityChecker(si), domain_(std::move(domain)) {
  specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::EXACT;
}

bool ContactSpaceValidityChecker::isValid(const ob::State* state) const {
  checks_.fetch_add(1, std::memory_order_relaxed);
  return domain_.free_space->IsFree(ToPoint(state));
}

double ContactSpaceValidityChecker::clearance(const ob::State* state) const {
  const Vector3d q = ToPoint(state);
  return domain_.free_space->IsFree(q) ? domain_.free_space->Clearance(q) : 0.0;
}

ContactSpaceMotionValidator::ContactSpaceMotionValidator(
    const ob::SpaceInformationPtr& si, MotionDomain domain)
    : MotionValidator(si), domain_(std::move(domain)) {}

// OMPL's counters are plain integers that other threads update too.
bool ContactSpaceMotionValidator::Count(bool free) const {
  __atomic_fetch_add(free ? &valid_ : &invalid_, 1u, __ATOMIC_RELAXED);
  return free;
}

bool ContactSpaceMotionValidator::checkMotion(const ob::State* s1,
                                              const ob::State* s2) const {
  return Count(domain_.free_space->IsFree(ToPoint(s1), ToPoint(s2)));
}

bool ContactSpaceMotionValidator::checkMotion(
    const ob::State* s1, const ob::State* s2,
    std::pair<ob::State*, double>& lastValid) const {
  const Vector3d a = ToPoint(s1), b = ToPoint(s2);
  const FreeSpace& space = *domain_.free_space;
  const MotionCheck check = space.Check(a, b);
  if (Count(check.free)) return true;
  // Back off from the (rounded) contact until the motion so far is free and
  // other programs can tell that it is.
  double fraction = 0.0;
  const double first = 2.0 * domain_.floor() / (b - a).norm();
  for (double gap = first; gap < check.fraction; gap *= 8.0) {
    const double candidate = check.fraction - gap;
    const Vector3d end = a + candidate * (b - a);
    if (space.Clearance(end) < domain_.floor() || !space.IsFree(a, end)) {
      continue;
    }
    fraction = candidate;
    break;
  }
  lastValid.second = fraction;
  // s1 and s2 may be what is written to.
  if (lastValid.first != nullptr) {
    FromPoint(fraction > 0.0 ? Vector3d(a + fraction * (b - a)) : a,
              lastValid.first);
  }
  return false;
}

}  // namespace phongpd
