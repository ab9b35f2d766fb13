// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/retraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/numbers.h"
#include "planners/exact/check_option.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using internal::At;

// In [0, size); the same on every platform, unlike uniform_int_distribution.
std::size_t RandomIndex(std::size_t size, std::mt19937_64* random) {
  return static_cast<std::size_t>((*random)() % size);
}

double RandomUnit(std::mt19937_64* random) {
  return static_cast<double>((*random)() >> 11) * 0x1p-53;
}

}  // namespace

Vector3d UniformPoint(const BoundingBox& box, std::mt19937_64* random) {
  Vector3d q;
  for (int k = 0; k < 3; ++k) {
    q[k] = box.min[k] + RandomUnit(random) * (box.max[k] - box.min[k]);
  }
  return q;
}

void RetractionOptions::Validate() const {
  const auto check = [](bool holds, const char* name, const char* range,
                        auto value) {
    CheckOption(holds, "retraction", name, range, value);
  };
  check(clearance > 0.0 && clearance <= 1.0, "clearance", "in (0, 1]",
        clearance);
}

Retraction::Retraction(std::shared_ptr<const ContactModel> model,
                       const RetractionOptions& options)
    : model_(std::move(model)), options_(options) {
  options_.Validate();
  if (!model_) throw InputError("retraction: expected a contact model");
}

RetractionStatus Retraction::Retract(const Vector3d& q, std::mt19937_64* random,
                                     RetractionScratch* scratch) const {
  scratch->points.clear();
  ++scratch->counters.queries;
  if (options_.metric == RetractionMetric::kContactPoint) {
    return DrawContactPoint(random, scratch);
  }
  if (!IsFinite(q)) return RetractionStatus::kInvalid;
  if (model_->free_space().IsFree(q)) {
    scratch->points.push_back(
        {q, std::numeric_limits<double>::infinity(), ContactModel::Facet()});
    return RetractionStatus::kFree;
  }
  ++scratch->counters.retractions;
  const std::uint64_t before = scratch->counters.projections;
  if (options_.metric == RetractionMetric::kEuclidean) {
    double distance = 0.0;
    const ContactModel::Facet nearest = model_->FindNearest(q, &distance);
    if (distance < 0.0 && nearest.space >= 0) {
      ++scratch->counters.projections;
      Lift(nearest, scratch);
    }
  } else if (options_.metric == RetractionMetric::kLocalEuclidean) {
    for (std::size_t i = 0; i < model_->size(); ++i) {
      ProjectLocally(static_cast<int>(i), q, scratch);
    }
  } else if (options_.metric == RetractionMetric::kContactPoints) {
    DrawAsManyAsBranches(q, random, scratch);
  } else {
    for (std::size_t i = 0; i < model_->size(); ++i) {
      Project(static_cast<int>(i), q, random, scratch);
    }
  }
  if (scratch->counters.projections == before) {
    return RetractionStatus::kNoProjection;
  }
  return scratch->points.empty() ? RetractionStatus::kNoClearance
                                 : RetractionStatus::kRetracted;
}

RetractionStatus Retraction::DrawContactPoint(
    std::mt19937_64* random, RetractionScratch* scratch) const {
  if (model_->size() == 0) return RetractionStatus::kNoProjection;
  // Facets beyond the bounds (the outside of the bounds shell) are common.
  constexpr int kDraws = 16;
  for (int draw = 0; draw < kDraws; ++draw) {
    const int space = static_cast<int>(RandomIndex(model_->size(), random));
    const TriangleMesh& mesh = model_->space(space).mesh();
    ContactModel::Facet facet;
    facet.space = space;
    facet.triangle =
        static_cast<int>(RandomIndex(mesh.triangles.size(), random));
    const Triangle& t = mesh.triangles[At(facet.triangle)];
    double u = RandomUnit(random), v = RandomUnit(random);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vector3d& origin = mesh.vertices[At(t[0])];
    facet.point = origin + u * (mesh.vertices[At(t[1])] - origin) +
                  v * (mesh.vertices[At(t[2])] - origin);
    facet.normal = model_->Normal(space, facet.triangle);
    ++scratch->counters.projections;
    if (Lift(facet, scratch)) return RetractionStatus::kRetracted;
  }
  return RetractionStatus::kNoClearance;
}

void Retraction::ProjectLocally(int space, const Vector3d& q,
                                RetractionScratch* scratch) const {
  const PhongMetric& metric = model_->phong(space);
  if (!metric.IsInside(q)) return;
  std::vector<LocalProjection>& found = scratch->local;
  FindLocalProjections(model_->space(space).mesh(), model_->Neighbors(space), q,
                       kRetractionDepth * model_->diagonal(),
                       &scratch->local_scratch, &found);
  scratch->counters.projections += found.size();
  const std::size_t limit = std::min(found.size(), At(kMaxRetractionBranches));
  for (std::size_t k = 0; k < limit; ++k) {
    const LocalProjection& hit = found[k];
    Lift({space, hit.triangle, hit.point, model_->Normal(space, hit.triangle)},
         scratch);
  }
}

void Retraction::DrawAsManyAsBranches(const Vector3d& q,
                                      std::mt19937_64* random,
                                      RetractionScratch* scratch) const {
  std::size_t branches = 0;
  for (std::size_t i = 0; i < model_->size(); ++i) {
    model_->phong(static_cast<int>(i))
        .QueryAll(q, kRetractionDepth * model_->diagonal(),
                  &scratch->projections);
    branches +=
        std::min(scratch->projections.size(), At(kMaxRetractionBranches));
  }
  for (std::size_t k = 0; k < branches; ++k) DrawContactPoint(random, scratch);
}

void Retraction::Project(int space, const Vector3d& q, std::mt19937_64* random,
                         RetractionScratch* scratch) const {
  std::vector<PenetrationResult>& found = scratch->projections;
  const PhongMetric& metric = model_->phong(space);
  found.clear();
  if (options_.choice == BranchChoice::kWarm ||
      options_.choice == BranchChoice::kNearest) {
    scratch->warm.resize(model_->size());
    Branch& warm = scratch->warm[At(space)];
    const bool follow = options_.choice == BranchChoice::kWarm;
    const PenetrationResult answer = metric.Query(q, follow ? warm : Branch());
    warm = answer.branch;
    if (answer.status == QueryStatus::kBranchEnded) {
      ++scratch->counters.branch_ends;
    }
    if (!answer.inside) return;
    found.push_back(answer);
  } else {
    metric.QueryAll(q, kRetractionDepth * model_->diagonal(), &found);
    if (found.empty() && metric.IsInside(q)) {
      const PenetrationResult answer = metric.Query(q);
      if (-answer.signed_distance <= kRetractionDepth * model_->diagonal()) {
        found.push_back(answer);
      }
    }
  }
  if (found.empty()) return;
  if (found.front().status == QueryStatus::kEuclideanFallback) {
    ++scratch->counters.fallbacks;
  }
  scratch->counters.projections += found.size();
  Choose(space, random, scratch);
}

// Takes points from scratch->projections by the option's choice.  A choice of
// one tries the others when the chosen one has no free point in front of it
// (a projection on the far side of the bounds is none).
void Retraction::Choose(int space, std::mt19937_64* random,
                        RetractionScratch* scratch) const {
  std::vector<PenetrationResult>& found = scratch->projections;
  const bool all = options_.choice == BranchChoice::kAll;
  std::vector<int>* taken = nullptr;
  if (options_.choice == BranchChoice::kNovelty) {
    scratch->taken.resize(model_->size());
    taken = &scratch->taken[At(space)];
    taken->resize(model_->space(space).mesh().triangles.size());
  }
  const std::size_t limit = std::min(found.size(), At(kMaxRetractionBranches));
  for (std::size_t k = 0; k < limit; ++k) {
    std::size_t chosen = k;
    if (options_.choice == BranchChoice::kRandom) {
      chosen = k + RandomIndex(found.size() - k, random);
    } else if (taken != nullptr) {
      for (std::size_t i = k; i < found.size(); ++i) {
        if ((*taken)[At(found[i].triangle)] <
            (*taken)[At(found[chosen].triangle)]) {
          chosen = i;
        }
      }
    }
    std::swap(found[k], found[chosen]);
    const PenetrationResult& hit = found[k];
    if (taken != nullptr) ++(*taken)[At(hit.triangle)];
    const ContactModel::Facet contact = {space, hit.triangle, hit.contact,
                                         model_->Normal(space, hit.triangle)};
    if (Lift(contact, scratch) && !all) return;
  }
}

bool Retraction::Lift(const ContactModel::Facet& contact,
                      RetractionScratch* scratch) const {
  RetractedPoint point;
  point.contact = contact;
  if (!model_->LiftOff(contact, clearance(), &point.q, &point.room)) {
    return false;
  }
  ++scratch->counters.points;
  scratch->points.push_back(point);
  return true;
}

}  // namespace phongpd
