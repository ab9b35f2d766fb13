// SPDX-License-Identifier: GPL-3.0-or-later
// Presets and the one smoothing length, wherever they are told.
#include "planners/world/preset.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "constraints/signed_metric.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/solve/optimize.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

TEST(Preset, NamesReadBackAndOthersAreRefusedWithAllNames) {
  for (const std::string& name : PresetNames()) {
    EXPECT_EQ(ToString(ParsePreset(name, "--preset")), name);
  }
  EXPECT_EQ(ToString(Preset::kBalanced), std::string("balanced"));
  const std::string what =
      testing::ErrorOf([&] { ParsePreset("slow", "--preset"); });
  EXPECT_EQ(what,
            "--preset: expected one of fast, balanced, tight, found 'slow'");
}

TEST(Preset, BalancedLeavesOptionsAsTheyCome) {
  ContactSurfaceOptions surface;
  ApplyPreset(Preset::kBalanced, &surface);
  EXPECT_EQ(surface.routes, ContactSurfaceOptions().routes);
  EXPECT_EQ(surface.spacing, ContactSurfaceOptions().spacing);
  EXPECT_EQ(surface.gap_links, ContactSurfaceOptions().gap_links);
  OptimizeRequest request;
  ApplyPreset(Preset::kTight, &request);
  ApplyPreset(Preset::kBalanced, &request);
  const PipelineOptions& pipeline = request.options;
  EXPECT_EQ(pipeline.routes, PipelineOptions().routes);
  EXPECT_EQ(pipeline.also_line, PipelineOptions().also_line);
  EXPECT_EQ(pipeline.polish, PipelineOptions().polish);
}

TEST(Preset, FastDoesLessAndTightMoreThanBalanced) {
  ContactSurfaceOptions fast, tight;
  ApplyPreset(Preset::kFast, &fast);
  ApplyPreset(Preset::kTight, &tight);
  EXPECT_LT(fast.routes, ContactSurfaceOptions().routes);
  EXPECT_GT(tight.routes, ContactSurfaceOptions().routes);
  for (const ContactSurfaceOptions& options : {fast, tight}) {
    EXPECT_NO_THROW(options.Validate());
  }
  OptimizeRequest quick, thorough;
  ApplyPreset(Preset::kFast, &quick);
  ApplyPreset(Preset::kTight, &thorough);
  EXPECT_FALSE(quick.options.also_line);
  EXPECT_GT(thorough.options.routes, PipelineOptions().routes);
  EXPECT_EQ(thorough.options.polish, PolishWhen::kAlways);
}

TEST(Preset, OfASceneArrivesInItsPipeline) {
  Scene scene = SceneSource("u_axis").Load();
  EXPECT_EQ(scene.preset, Preset::kBalanced);
  scene.preset = Preset::kTight;
  EXPECT_EQ(OptimizeRequestOf(scene).options.routes, 3);
}

TEST(SmoothingLength, IsOneByDefaultEverywhere) {
  EXPECT_EQ(PhongFieldOptions().smoothing_length, kDefaultSmoothingLength);
  EXPECT_EQ(SignedMetricOptions().phong.field_options.smoothing_length,
            kDefaultSmoothingLength);
  const Length length = Length::FromShare(kDefaultSmoothingLength);
  EXPECT_EQ(PenetrationSpec().smoothing_length, length);
  EXPECT_EQ(PenetrationSpec().Name(), "phong@" + length.Text());
  // Of families, and of files that say none.
  EXPECT_EQ(SceneSource("u_axis").Load().penetration.smoothing_length, length);
  EXPECT_EQ(SceneSchema()["properties"]["penetration"]["properties"]
                         ["smoothing_length"]["default"],
            length.Text("mm"));
  EXPECT_EQ(PhongFieldOptions::Unsmoothed().smoothing_length, 0.0);
}

}  // namespace
}  // namespace phongpd
