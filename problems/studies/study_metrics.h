// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/contact/contact_space.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/phong_metric.h"
#include "planners/solve/optimize.h"

// Metrics that the convergence study alone follows, to tell what of PhongPD it
// is that helps a solver: the memory of a branch, the depth, or the direction.
// Outside C_obj each is EuclideanMetric, bit for bit.
namespace phongpd {

// Euclid followed locally.  A branch is a local minimum of |x − q| over C_cont;
// the next answer is the one that descent from there over adjacent triangles
// reaches, with its exact gradient.  Where a minimum vanishes, it slides on to
// another without a word.  Without a branch it is the Euclidean answer, which
// begins one; kBranchEnded where q has left the sheet of its contact on the
// other side and is still inside, or outside although the branch has depth.
// Queries allocate.
std::shared_ptr<const PenetrationMetric> MakeFollowedMetric(
    const ContactSpace& space);

// Euclid's value and contact (continuous and 1-Lipschitz by itself), Phong's
// direction, branch and status; `gradient` is Phong's, too.
std::shared_ptr<const PenetrationMetric> MakeMixedMetric(
    const ContactSpace& space, const PhongMetricOptions& options);

// The same, with a direction that fades to Euclid's (n_e) where walls are near
// each other:
//
//   n = (w n_p + (1 − w) n_e) / |…|,   w = min(1, g / ℓ),
//
// g the free way that is left beyond Euclid's contact q_c, along n_e.  Where
// there is none, as in a dead end, it is Euclid's own.
std::shared_ptr<const PenetrationMetric> MakeFadedMetric(
    const ContactSpace& space, const PhongMetricOptions& options);

// What an optimiser of the study follows.
struct StudyMetric {
  PenetrationSpec penetration;
  std::optional<OwnMetric> own;  // one of the above

  std::string Name() const { return own ? own->name : penetration.Name(); }
};

// The metrics above by name, "followed", "mixed@L" and "faded@L", the controls
// "diffused@L" and "placebo@L" (control_metrics.h), and all that
// ParsePenetration takes.  Throws InputError starting with `what`.
StudyMetric ParseStudyMetric(const std::string& text, const std::string& what);

}  // namespace phongpd
