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

// What carries a colliding configuration to C_cont.
enum class RetractionMetric {
  kPhong,           // along Phong directions: many projections
  kEuclidean,       // to the closest point: one
  kLocalEuclidean,  // to every point that is the closest one around it: many
  kContactPoint,   // not at all: a random point of a random triangle of C_cont,
                   // whatever the configuration (the honest baseline)
  kContactPoints,  // as many of those as the configuration has projections
                   // along Phong directions, a baseline of equal strength
};

// Which of the projections of a configuration are taken.  Only
// kPhong has a choice: the baselines take what they list.
enum class BranchChoice {
  kAll,      // each of them; one colliding sample lists the passage
  kRandom,   // one, uniformly
  kNovelty,  // the one whose triangle was taken least often
  kWarm,     // the branch of the previous query, followed to this one
  kNearest,  // the one of least depth
};

// Deepest projection listed, as a fraction of the region's diagonal.  Measured
// on a hole: bounds below 0.2 cost 3-300 × the samples.
inline constexpr double kRetractionDepth = 1.0;
// Projections lifted per configuration, shallowest first.  It bounds the work
// in scenes where one configuration has hundreds.
inline constexpr int kMaxRetractionBranches = 64;

struct RetractionOptions {
  RetractionMetric metric = RetractionMetric::kPhong;
  BranchChoice choice = BranchChoice::kAll;
  // Largest clearance asked for, as a fraction of the region's diagonal; what
  // a point gets is at most half the free gap in front of its facet.  (0, 1].
  double clearance = 1e-2;

  void Validate() const;  // throws InputError
};

enum class RetractionStatus {
  kFree,          // q is free already: it is the point
  kRetracted,     // at least one point
  kNoProjection,  // q is on a contact surface, or only beyond the bounds, or
                  // deeper than kRetractionDepth
  kNoClearance,   // projections, but no free point in front of any of them
  kInvalid,       // q is not finite
};

// A free configuration, at least floor() from every contact surface.
struct RetractedPoint {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double room = 0.0;  // distance to what is nearest; infinity if kFree
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

// Uniform in a box; the same on every platform.
Eigen::Vector3d UniformPoint(const BoundingBox& box, std::mt19937_64* random);

// State of one caller: one per thread and sampler, reused from call to call.
// After a few calls nothing allocates.
struct RetractionScratch {
  std::vector<RetractedPoint> points;  // the answer
  RetractionCounters counters;

  std::vector<PenetrationResult> projections;
  std::vector<LocalProjection> local;
  LocalProjectionScratch local_scratch;
  std::vector<Branch> warm;             // per contact space
  std::vector<std::vector<int>> taken;  // per contact space and triangle
};

// Retraction of configurations onto the neighbourhood of C_cont: from a
// colliding q to the projections q_c of its penetration, each lifted off its
// facet by min(ε, ½ the free gap) along the *facet's* normal (the Phong normal
// may be tangential there, and a fixed ε closes passages narrower than 2ε).
// Both metrics are treated alike from q_c on.
class Retraction {
 public:
  // Throws InputError.
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
