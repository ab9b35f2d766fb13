// SPDX-License-Identifier: GPL-3.0-or-later
// The words of requests and answers read back to what they mean.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/mesh/mesh_error.h"
#include "planners/retraction/retraction_names.h"
#include "planners/world/model.h"
#include "planners/world/path_status.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/planner_id.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

TEST(Names, OfPlannersReadBackAndSayWhatEachNeeds) {
  std::set<std::string> names;
  for (const PlannerId planner : AllPlanners()) {
    const std::string name = ToString(planner);
    EXPECT_EQ(ParsePlanner(name, "planner"), planner);
    EXPECT_TRUE(names.insert(name).second) << name;
    const bool retracts = name.find("retraction") != std::string::npos;
    EXPECT_EQ(Retracts(planner), retracts) << name;
    EXPECT_EQ(ChecksMotionsOnly(planner),
              !retracts && name != "contact-surface")
        << name;
    EXPECT_EQ(SeeksClearance(planner), !ChecksMotionsOnly(planner)) << name;
  }
  EXPECT_EQ(names.size(), PlannerNames().size());
  const std::string text =
      testing::ErrorOf([&] { ParsePlanner("RRTConnect", "--planner"); });
  EXPECT_NE(text.find("--planner: expected one of contact-surface"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("did you mean rrt-connect?"), std::string::npos) << text;
}

TEST(Names, OfRetractionsReadBack) {
  for (const std::string& name : RetractionNames()) {
    EXPECT_EQ(RetractionName(ParseRetraction(name, "metric")), name);
  }
  // The choice of a metric without one says nothing.
  RetractionOptions options;
  options.metric = RetractionMetric::kEuclidean;
  options.choice = BranchChoice::kWarm;
  EXPECT_EQ(RetractionName(options), "euclidean");
  EXPECT_THROW(ParseRetraction("phone", "metric"), InputError);
}

TEST(Names, OfModelsReadBack) {
  for (const std::string& name : ModelNames()) {
    EXPECT_EQ(ToString(ParseModel(name, "model")), name);
  }
  EXPECT_THROW(ParseModel("some", "model"), InputError);
}

TEST(Names, OfMetricsReadBack) {
  for (const char* name :
       {"euclidean", "phong@0", "phong@0.2", "phong@0.5unit/exact",
        "phong@0.1/tangent-plane", "phong@0.1/tangent-plane/exact",
        "smoothed@0.2", "smoothed-foot@0.5unit"}) {
    EXPECT_EQ(ParsePenetration(name, "metric").Name(), name);
  }
  const auto title = [](const char* name) {
    return ParsePenetration(name, "metric").Title();
  };
  EXPECT_EQ(title("euclidean"), "Euclidean PD");
  EXPECT_EQ(title("phong@0.5unit/exact"), "PhongPD, ℓ = 0.5unit/exact");
  EXPECT_EQ(title("smoothed@0.2"), "smoothed@0.2");
  for (const char* name : {"", "phongg", "phong@", "phong@-1", "phong@0.1/some",
                           "phong@0.1/exact/tangent-plane/exact", "euclid",
                           "euclidean@0.2", "smoothed@", "smoothed@0",
                           "smoothed@0.2/exact", "smooth@0.2", "@0.2"}) {
    EXPECT_THROW(ParsePenetration(name, "metric"), InputError) << name;
  }
  // As flags name the kind alone: all else is the default.
  EXPECT_EQ(ParsePenetration("phong", "metric").Name(),
            PenetrationSpec().Name());
  // Of Euclid nothing else counts; a length beyond D is no share of it.
  PenetrationSpec spec;
  spec.metric = MetricKind::kEuclidean;
  spec.jacobian = JacobianKind::kExact;
  EXPECT_EQ(spec.Options(1.0).jacobian, JacobianKind::kDirection);
  spec = ParsePenetration("phong@3unit", "metric");
  EXPECT_DOUBLE_EQ(spec.Options(10.0).phong.field_options.smoothing_length,
                   0.3);
  EXPECT_THROW(spec.Options(2.0), InputError);
  for (const std::string& name : MetricNames()) {
    EXPECT_EQ(ToString(ParseMetricKind(name, "metric")), name);
  }
  EXPECT_THROW(ParseMetricKind("smooth", "metric"), InputError);
}

TEST(Names, OfSmoothedMetricsTakeALengthAndTheDirectionAlone) {
  EXPECT_EQ(ParsePenetration("smoothed", "metric").Name(), "smoothed@0.2");
  EXPECT_EQ(ParsePenetration("smoothed-foot", "metric").Name(),
            "smoothed-foot@0.2");
  PenetrationSpec spec = ParsePenetration("smoothed@3unit", "metric");
  EXPECT_EQ(spec.Options(10.0).metric, MetricKind::kSmoothed);
  EXPECT_DOUBLE_EQ(spec.Options(10.0).phong.field_options.smoothing_length,
                   0.3);
  EXPECT_THROW(spec.Options(2.0), InputError);
  spec.metric = MetricKind::kSmoothedFoot;
  EXPECT_EQ(spec.Name(), "smoothed-foot@3unit");
  spec.jacobian = JacobianKind::kExact;
  EXPECT_THROW(spec.Options(10.0), InputError);
  spec = PenetrationSpec();
  spec.metric = MetricKind::kSmoothed;
  spec.smoothing_length = Length::FromShare(0.0);
  EXPECT_THROW(spec.Options(10.0), InputError);
}

TEST(Names, OfStatusesDifferAndTellFreePathsFromBlockedEnds) {
  std::set<std::string> names;
  int free = 0, blocked = 0;
  for (int k = 0; k <= static_cast<int>(PathStatus::kSmallestTrust); ++k) {
    const auto status = static_cast<PathStatus>(k);
    EXPECT_TRUE(names.insert(ToString(status)).second) << ToString(status);
    free += HasFreePath(status);
    blocked += IsStartBlocked(status) || IsGoalBlocked(status);
    EXPECT_FALSE(IsStartBlocked(status) && IsGoalBlocked(status));
  }
  EXPECT_EQ(free, 5);
  EXPECT_EQ(blocked, 4);
}

}  // namespace
}  // namespace phongpd
