// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/planner_names.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/retraction_settings.h"
#include "problems/output/nearest_name.h"
#include "problems/output/text.h"

namespace phongpd {

std::vector<std::string> PlannerNames() {
  std::vector<std::string> names = {kContactSurface};
  const std::vector<std::string>& ompl = OmplPlannerNames();
  names.insert(names.end(), ompl.begin(), ompl.end());
  return names;
}

const std::vector<std::string>& RetractionNames() {
  static const std::vector<std::string> names = {
      "phong",         "phong-random",  "phong-novelty",
      "phong-warm",    "phong-nearest", "euclidean",
      "euclidean-all", "contact-point", "contact-points"};
  return names;
}

RetractionOptions ParseRetraction(const std::string& text,
                                  const std::string& what) {
  RetractionOptions options;
  const std::vector<std::string>& names = RetractionNames();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw InputError(what + ": expected one of " + Joined(names) + "; found '" +
                     text + "'" + DidYouMean(text, names));
  }
  const std::ptrdiff_t index = found - names.begin();
  constexpr BranchChoice kChoices[] = {
      BranchChoice::kAll, BranchChoice::kRandom, BranchChoice::kNovelty,
      BranchChoice::kWarm, BranchChoice::kNearest};
  if (index < 5) options.choice = kChoices[index];
  // The others have the names of their metrics.
  if (index >= 5) options.metric = RetractionMetricFromString(text);
  return options;
}

void CheckHasOmplLog(const std::string& planner) {
  if (planner != kContactSurface) return;
  throw InputError("--ompl-log: expected a planner of OMPL, found " + planner);
}

bool SeeksClearance(const std::string& planner) {
  return planner == kContactSurface ||
         planner.find("retraction") != std::string::npos;
}

void RequireSeeksClearance(const std::string& planner,
                           const std::string& what) {
  if (SeeksClearance(planner)) return;
  throw InputError(what +
                   ": expected a planner that seeks one (contact-surface or a "
                   "retraction), found " +
                   planner);
}

bool ChecksMotionsOnly(const std::string& planner) {
  const std::vector<std::string> names = SurfaceFreePlannerNames();
  return std::find(names.begin(), names.end(), planner) != names.end();
}

bool NeedsWholeSurface(const std::string& planner) {
  return planner != kContactSurface && !ChecksMotionsOnly(planner);
}

}  // namespace phongpd
