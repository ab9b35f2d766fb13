// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/comparison_jobs.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "problems/cli/command.h"
#include "problems/output/json_text.h"
#include "problems/scenes/kept_world.h"
#include "problems/studies/comparison_rows.h"
#include "problems/studies/comparison_run.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

// Throws InputError unless the line is the job's row.
void CheckKept(const std::string& line, const ComparisonJob& job,
               const std::string& where) {
  const Json row = Json::parse(line);
  CheckComparisonRow(row, where);
  if (row.at("seed") == job.seed &&
      RowText(row, "protocol") == job.protocol.name &&
      RowText(row, "method") == job.metric.Name()) {
    return;
  }
  throw InputError(where + ": expected seed " + std::to_string(job.seed) +
                   ", " + job.protocol.name + ", " + job.metric.Name() +
                   "; found another; remove the file");
}

}  // namespace

void RunJobs(const std::vector<ComparisonJob>& jobs,
             const ContactSpaceCache& cache, bool keep_paths, RowFile* rows) {
  const std::size_t kept = std::min(rows->rows().size(), jobs.size());
  for (std::size_t i = 0; i < kept; ++i) {
    CheckKept(rows->rows()[i], jobs[i],
              rows->path() + ": row " + std::to_string(i + 1));
  }
  if (kept > 0) {
    Note("going on after " + std::to_string(kept) + " of " +
         std::to_string(jobs.size()) + " rows in " + rows->path());
  }
  KeptWorld worlds(cache);
  Scene scene;
  for (std::size_t i = kept; i < jobs.size(); ++i) {
    const ComparisonJob& job = jobs[i];
    const ComparisonRun run = {job.seed, job.protocol, job.metric,
                               job.source->is_family()};
    ProgressOf("rows", i - kept, jobs.size() - kept);
    if (i == kept || job.source != jobs[i - 1].source ||
        job.seed != jobs[i - 1].seed) {
      Progress(job.source->label() + ", seed " + std::to_string(job.seed));
      scene = job.source->Load(job.seed);
      const std::string beyond =
          MarginBeyondReach(worlds.Of(scene), RequestOf(scene, run));
      if (!beyond.empty()) {
        Warn(job.source->label() + ", seed " + std::to_string(job.seed) + ": " +
             beyond);
      }
    }
    Json row = RunComparison(scene, worlds.Of(scene), run);
    if (!keep_paths) row.erase("path");
    MarkPart(job.part, &row);
    rows->Append(JsonText(row));
  }
}

}  // namespace phongpd::cli
