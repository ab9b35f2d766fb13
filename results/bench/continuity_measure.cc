// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/continuity_measure.h"

#include <memory>
#include <utility>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/output/text.h"
#include "results/bench/yardstick.h"

namespace phongpd::bench {
namespace {

using Row = ContinuityRow;

const std::vector<double>& Ratios() {
  static const std::vector<double> ratios = {1.1, 1.33, 1.5, 2.0, 3.0};
  return ratios;
}

struct Case {
  const MotionSpace& space;
  std::string kind;  // of the motions
  std::vector<Motion> motions;
  std::vector<std::vector<double>> depths;
};

Row Follow(const Case& held, const std::string& name,
           const BeginFollowing& begin, bool has_branches) {
  const double jump = kMotionJump * held.space.contact.length();
  Row row;
  row.space = held.space.name;
  row.motions = held.kind;
  row.rule = name;
  for (std::size_t m = 0; m < held.motions.size(); ++m) {
    const Motion& motion = held.motions[m];
    Follower follow = begin();
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const Follower before = follow;
      const MotionStep step = follow(motion[i]);
      if (held.depths[m][i] > 0.0) {
        ++row.frames;
        row.ratios.push_back(step.pd.norm() / held.depths[m][i]);
      }
      if (i > 0 && (step.pd - last).norm() > jump) {
        ++row.jumps;
        const JumpClass kind = ClassOfJump(before, motion[i - 1], motion[i],
                                           last, jump, has_branches);
        ++row.classes[static_cast<std::size_t>(kind)];
      }
      last = step.pd;
    }
  }
  return row;
}

// What follows the motions, and what they are measured by; built once a space.
struct Rules {
  explicit Rules(const ContactSpace& contact)
      : euclidean(contact), tracker(contact), yardstick(contact) {
    for (const double ell : {0.0, 0.1, 0.2}) {
      PhongMetricOptions options;
      options.field_options.smoothing_length = ell;
      phong.emplace_back("phong@" + Rounded(ell),
                         std::make_unique<PhongMetric>(contact, options));
    }
  }

  EuclideanMetric euclidean;
  PenetrationTracker tracker;
  Yardstick yardstick;
  std::vector<std::pair<std::string, std::unique_ptr<PhongMetric>>> phong;
};

void Measure(const Case& held, const Rules& rules, std::vector<Row>* rows) {
  rows->push_back(
      Follow(held, "euclidean", FollowMetric(rules.euclidean), false));
  const int frames = rows->back().frames;
  for (const auto& [name, metric] : rules.phong) {
    rows->push_back(Follow(held, name, FollowMetric(*metric), true));
  }
  rows->push_back(Follow(held, "tracker", FollowTracker(rules.tracker), true));
  std::vector<int> least(Ratios().size(), 0);
  for (std::size_t m = 0; m < held.motions.size(); ++m) {
    const std::vector<int> of_motion =
        rules.yardstick.LeastJumps(held.motions[m], held.depths[m], Ratios());
    for (std::size_t c = 0; c < least.size(); ++c) least[c] += of_motion[c];
  }
  for (std::size_t c = 0; c < least.size(); ++c) {
    Row row;
    row.space = held.space.name;
    row.motions = held.kind;
    row.rule = "any rule, c = " + Rounded(Ratios()[c]);
    row.frames = frames;
    row.jumps = least[c];
    row.is_bound = true;
    row.ratio = Ratios()[c];
    rows->push_back(std::move(row));
  }
}

}  // namespace

std::vector<Row> MeasureContinuity(const MotionSpace& space,
                                   const ContinuityOptions& options) {
  const Rules rules(space.contact);
  Case cases[] = {
      {space,
       kWays,
       MakeMotions(space.contact, options.motions, options.frames,
                   options.seed),
       {}},
      {space,
       kWalks,
       MakeWalks(space.contact, options.motions, options.frames, options.seed),
       {}}};
  std::vector<Row> rows;
  for (Case& held : cases) {
    for (const Motion& motion : held.motions) {
      held.depths.push_back(EuclideanDepths(rules.euclidean, motion));
    }
    Measure(held, rules, &rows);
  }
  return rows;
}
std::vector<Row> TotalsOf(const std::vector<Row>& rows,
                          const std::string& space,
                          const std::string& motions) {
  std::vector<Row> totals;
  for (const Row& row : rows) {
    if (row.space.find("hollow") != std::string::npos) continue;
    auto same = std::find_if(totals.begin(), totals.end(),
                             [&](const Row& r) { return r.rule == row.rule; });
    if (same == totals.end()) {
      totals.push_back(row);
      totals.back().space = space;
      totals.back().motions = motions;
      continue;
    }
    same->frames += row.frames;
    same->jumps += row.jumps;
    for (std::size_t k = 0; k < same->classes.size(); ++k) {
      same->classes[k] += row.classes[k];
    }
    same->ratios.insert(same->ratios.end(), row.ratios.begin(),
                        row.ratios.end());
  }
  return totals;
}

}  // namespace phongpd::bench
