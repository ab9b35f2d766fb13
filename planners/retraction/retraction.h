// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "core/projection/phong_metric.h"
#include "planners/retraction/contact_model.h"
#include "planners/retraction/local_projections.h"

namespace phongpd {

// How a colliding configuration is projected onto C_cont.
enum class RetractionMetric {
  kPhong,           // along Phong directions: many projections
  kEuclidean,       // to the closest point: one projection
  kLocalEuclidean,  // to every local minimum of the distance: many projections
  // Baselines, whose points do not depend on the configuration:
  kContactPoint,   // a random point of a random triangle of C_cont
  kContactPoints,  // as many of those as the configuration has projections
                   // along Phong directions
};

// Which of a configuration's projections are used.  For kPhong only: the other
// metrics use all that they find.
enum class BranchChoice {
  kAll,      // each of them: one colliding sample gives points on all sides of
             // a passage
  kRandom,   // one, uniformly
  kNovelty,  // the one whose triangle was used least often
  kWarm,     // the branch of the previous query, followed to this one
  kNearest,  // the one of least depth
};

// The largest depth of a projection, as a fraction of the region's diagonal.
// Measured for a hole: with less than 0.2, 3 to 300 times as many samples were
// needed.
inline constexpr double kRetractionDepth = 1.0;
// At most so many projections of a configuration are used, shallowest first: in
// some scenes one configuration has hundreds.
inline constexpr int kMaxRetractionBranches = 64;

struct RetractionOptions {
  RetractionMetric metric = RetractionMetric::kPhong;
  BranchChoice choice = BranchChoice::kAll;
  // ε: the largest clearance that a point gets, as a fraction in (0, 1] of the
  // region's diagonal.  It gets less where the gap in front of its facet is
  // narrower than 2ε: half the gap.
  double clearance = 1e-2;

  void Validate() const;  // throws InputError
};

enum class RetractionStatus {
  kFree,          // q is free: it is the only point
  kRetracted,     // q collides: there is at least one point
  kNoProjection,  // q lies on a contact surface, or in no obstacle but beyond
                  // the bounds, or deeper than kRetractionDepth
  kNoClearance,   // there are projections, but no free point in front of them
  kInvalid,       // q is not finite
};

// A free configuration, at least ContactModel::floor() from every contact
// surface.
struct RetractedPoint {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double room = 0.0;  // distance to the nearest contact; infinity if kFree
  ContactModel::Facet contact;  // where q was projected to; none if kFree
};

struct RetractionCounters {
  std::uint64_t queries = 0;      // Retract calls
  std::uint64_t retractions = 0;  // of colliding configurations
  std::uint64_t projections = 0;  // on C_cont
  std::uint64_t branch_ends = 0;  // kWarm: branches that folded
  std::uint64_t fallbacks = 0;    // no Phong projection: Euclidean instead
  std::uint64_t points = 0;       // free points found
};

// A uniform random point in a box; the same on every platform.
Eigen::Vector3d UniformPoint(const BoundingBox& box, std::mt19937_64* random);

// The answer, counters and buffers of one caller.  Have one per thread and
// sampler, and reuse it: after a few calls nothing allocates.
struct RetractionScratch {
  std::vector<RetractedPoint> points;  // the answer of the last call
  RetractionCounters counters;         // of all calls

  // Buffers of Retract.
  std::vector<PenetrationResult> projections;
  std::vector<LocalProjection> local;
  LocalProjectionScratch local_scratch;
  std::vector<Branch> warm;             // per contact space
  std::vector<std::vector<int>> taken;  // per contact space and triangle
};

// Turns colliding samples into free ones near contact, where sampling-based
// planners need them: a colliding q is projected onto C_cont, and each
// projection q_c is lifted off its facet by min(ε, half the free gap).  It is
// lifted along the normal of the facet, since the Phong normal may be
// tangential there; a fixed ε would close passages narrower than 2ε.  From q_c
// on, all metrics are treated alike.
class Retraction {
 public:
  // Throws InputError for options and without a model.
  Retraction(std::shared_ptr<const ContactModel> model,
             const RetractionOptions& options = {});

  // Fills scratch->points.  A q inside several contact spaces is projected in
  // each of them.  Thread-safe with one scratch and engine per thread.
  RetractionStatus Retract(const Eigen::Vector3d& q, std::mt19937_64* random,
                           RetractionScratch* scratch) const;

  // The same model with other options.
  Retraction WithOptions(const RetractionOptions& options) const {
    return Retraction(model_, options);
  }

  const RetractionOptions& options() const { return options_; }
  const ContactModel& model() const { return *model_; }
  // ε in the user's unit.
  double clearance() const { return options_.clearance * model_->diagonal(); }

 private:
  RetractionStatus DrawContactPoint(std::mt19937_64* random,
                                    RetractionScratch* scratch) const;
  void ProjectLocally(int space, const Eigen::Vector3d& q,
                      RetractionScratch* scratch) const;
  void DrawAsManyAsBranches(const Eigen::Vector3d& q, std::mt19937_64* random,
                            RetractionScratch* scratch) const;
  void Project(int space, const Eigen::Vector3d& q, std::mt19937_64* random,
               RetractionScratch* scratch) const;
  void Choose(int space, std::mt19937_64* random,
              RetractionScratch* scratch) const;
  bool Lift(const ContactModel::Facet& contact,
            RetractionScratch* scratch) const;

  std::shared_ptr<const ContactModel> model_;
  RetractionOptions options_;
};

}  // namespace phongpd
