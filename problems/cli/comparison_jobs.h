// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/contact/contact_space_cache.h"
#include "problems/output/row_file.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/comparison_parts.h"
#include "problems/studies/study_metrics.h"
#include "problems/studies/trajectory_comparison.h"

namespace phongpd::cli {

// What gives one row of a comparison.
struct ComparisonJob {
  const SceneSource* source;
  std::uint64_t seed;
  TrajectoryProtocol protocol;
  StudyMetric metric;
  ComparisonPart part;  // of which command its problem is
};

// Appends the rows that are not there yet; those that are must be of the first
// jobs.  Throws InputError, also unless they are.
void RunJobs(const std::vector<ComparisonJob>& jobs,
             const ContactSpaceCache& cache, bool keep_paths, RowFile* rows);

}  // namespace phongpd::cli
