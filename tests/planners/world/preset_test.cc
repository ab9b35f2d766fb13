// SPDX-License-Identifier: GPL-3.0-or-later
// Presets and the one smoothing length, wherever they are told.
#include "planners/world/preset.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "constraints/signed_metric.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/trajectory_study.h"

namespace phongpd {
namespace {

TEST(Preset, NamesReadBackAndOthersAreRefusedWithAllNames) {
  for (const std::string& name : PresetNames()) {
    EXPECT_EQ(ToString(ParsePreset(name, "--preset")), name);
  }
  EXPECT_EQ(ToString(Preset::kBalanced), std::string("balanced"));
  try {
    ParsePreset("slow", "--preset");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "--preset: expected one of fast, balanced, tight, found 'slow'");
  }
}

TEST(Preset, BalancedLeavesOptionsAsTheyCome) {
  ContactSurfaceOptions surface;
  ApplyPreset(Preset::kBalanced, &surface);
  EXPECT_EQ(surface.routes, ContactSurfaceOptions().routes);
  EXPECT_EQ(surface.spacing, ContactSurfaceOptions().spacing);
  EXPECT_EQ(surface.gap_links, ContactSurfaceOptions().gap_links);
  PipelineOptions pipeline;
  ApplyPreset(Preset::kBalanced, &pipeline);
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
  PipelineOptions quick, thorough;
  ApplyPreset(Preset::kFast, &quick);
  ApplyPreset(Preset::kTight, &thorough);
  EXPECT_FALSE(quick.also_line);
  EXPECT_GT(thorough.routes, PipelineOptions().routes);
  EXPECT_EQ(thorough.polish, PolishWhen::kAlways);
}

TEST(Preset, OfASceneArrivesInItsPipeline) {
  Scene scene = SceneSource("u_axis").Load();
  EXPECT_EQ(scene.preset, Preset::kBalanced);
  scene.preset = Preset::kTight;
  EXPECT_EQ(ScenePipelineOptions(scene).routes, 3);
}

TEST(SmoothingLength, IsOneByDefaultEverywhere) {
  EXPECT_EQ(PhongFieldOptions().smoothing_length, kDefaultSmoothingLength);
  EXPECT_EQ(SignedMetricOptions().phong.field_options.smoothing_length,
            kDefaultSmoothingLength);
  const Length length = Length::FromShare(kDefaultSmoothingLength);
  EXPECT_EQ(PenetrationSettings().smoothing_length, length);
  EXPECT_EQ(TrajectoryMetric().smoothing_length, length);
  EXPECT_EQ(TrajectoryMetric().name, "phong@" + length.Text());
  // Of families, and of files that say none.
  EXPECT_EQ(SceneSource("u_axis").Load().penetration.smoothing_length, length);
  EXPECT_EQ(SceneSchema()["properties"]["penetration"]["properties"]
                         ["smoothing_length"]["default"],
            length.Text("mm"));
  EXPECT_EQ(PhongFieldOptions::Unsmoothed().smoothing_length, 0.0);
}

}  // namespace
}  // namespace phongpd
