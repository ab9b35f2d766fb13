// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "core/projection/penetration_metric.h"
#include "core/projection/phong_metric.h"

namespace phongpd {

class FeatureSearch;

enum class MetricKind {
  kPhong,
  kEuclidean,
  kSmoothed,      // Euclid's depth, smoothed direction at q
  kSmoothedFoot,  // the same with the direction at q_c
};

// The derivative inside C_obj.
enum class JacobianKind {
  kDirection,  // the metric's unit direction n̂, outward: continuous, n̂·∇d = 1
               // (median angle to ∇d inside a U at ℓ = 0.2: 30°); of smoothed
               // metrics not: there it is the cosine of the angle to Euclid's
  kExact,  // ∇d itself; jumps at mesh edges, grows without bound at folds
};

struct SignedMetricOptions {
  MetricKind metric = MetricKind::kPhong;
  // Of kPhong.  kSmoothed and kSmoothedFoot use its smoothing length alone
  // (smoothed_metric.h); their exact Jacobian is Euclid's.
  PhongMetricOptions phong;
  JacobianKind jacobian = JacobianKind::kDirection;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

// The metric inside C_obj that they name.  Throws InputError for options.
std::shared_ptr<const PenetrationMetric> MakePenetrationMetric(
    const ContactSpace& space, const SignedMetricOptions& options = {});

inline constexpr int kMaxMetricRows = 8;
// Least angle between the directions of two rows, degrees.
inline constexpr double kRowSeparation = 25.0;
// Rows after the first are no farther than this, a share of D.  Walls farther
// off matter for no margin, and to search for them takes time.
inline constexpr double kRowReach = 0.1;
// Longer gradients of a row are cut to this length.  A constraint d ≥ m expects
// a length of about 1; near a fold |∇d| → ∞.
inline constexpr double kMaxRowGradient = 5.0;

// One value of a constraint d(q) ≥ m and its derivative.  User's unit.
struct MetricRow {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  QueryStatus status = QueryStatus::kInvalid;
  bool inside = false;
  int triangle = -1;         // of the contact mesh
  Branch branch;             // of row 0 and its copies: for the next query
  bool is_capped = false;    // gradient was longer than kMaxRowGradient
  bool is_repeated = false;  // an unused row: copy of row 0
};

// The signed metric of one contact space as K constraint rows:
//
//   outside and on C_cont   d(q) = |q − q_c|, the Euclidean distance
//   inside C_obj            d(q) = −depth, Phong's or Euclid's (the smoothed
//                           metrics': Euclid's)
//
// With all options d is zero exactly on C_cont and positive exactly in free
// space: options change how a solver gets out, not what is feasible.
//
// Rows (outside): row 0 is d; row k is the distance to the nearest triangle
// within kRowReach whose direction differs by more than kRowSeparation from
// those of rows 0 … k−1.  All are necessary for d ≥ m, so more rows never
// change the feasible set; they show the solver the second wall of a channel
// before it hits that wall.  Inside, and where there is no further feature, the
// remaining rows are copies of row 0 with is_repeated, so that the pattern
// stays fixed.
class SignedMetric {
 public:
  // Throws InputError for options.
  explicit SignedMetric(const ContactSpace& space,
                        const SignedMetricOptions& options = {});
  // With a metric of one's own inside C_obj instead of `options.metric` and
  // `options.phong`.  It is of this space, and outside and on C_cont it answers
  // as EuclideanMetric does.  Throws InputError for null, too.
  SignedMetric(const ContactSpace& space,
               std::shared_ptr<const PenetrationMetric> metric,
               const SignedMetricOptions& options);
  // The same without a contact space, for a WindowMetric.  Further features are
  // not known then: rows 1 … K−1 are copies of row 0.
  SignedMetric(std::shared_ptr<const PenetrationMetric> metric,
               const SignedMetricOptions& options);

  const SignedMetricOptions& options() const { return options_; }
  bool HasSpace() const { return space_.has_value(); }
  // Requires HasSpace().
  const ContactSpace& space() const { return *space_; }

  // Writes `count` = K rows, K in [1, kMaxMetricRows].  With a valid `previous`
  // branch the inside value continues that branch, otherwise it is the least
  // depth.  For q not finite every row is kInvalid and zero; no row ever holds
  // NaN or Inf.  Const, thread-safe, no allocation.
  void Query(const Eigen::Vector3d& q, const Branch& previous, int count,
             MetricRow* rows) const;
  // Row 0 alone.
  MetricRow Query(const Eigen::Vector3d& q,
                  const Branch& previous = Branch()) const;

 private:
  SignedMetricOptions options_;
  std::optional<ContactSpace> space_;
  double reach_ = 0.0;  // user's unit
  std::shared_ptr<const PenetrationMetric> metric_;
  std::shared_ptr<const FeatureSearch> features_;  // null: without a space
};

}  // namespace phongpd
