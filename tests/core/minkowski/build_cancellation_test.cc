// SPDX-License-Identifier: GPL-3.0-or-later
// A build that would take minutes, stopped by another thread.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"
#include "core/minkowski/build_stop.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

TEST(BuildCancellation, StopsARunningBuildAndNoLaterOne) {
  const TriangleMesh knot = MakeKnot(1.0, 0.2, 96, 24);  // minutes on itself
  std::atomic<bool> is_done{false};
  std::string what;
  std::thread builder([&] {
    try {
      BuildContactSpace(knot, knot);
    } catch (const BuildCancelled& error) {
      what = error.what();
    }
    is_done = true;
  });
  // Until it is there to be stopped.
  while (!is_done) {
    CancelBuilds();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  builder.join();
  EXPECT_EQ(what.find("robot and obstacle: the contact space was cancelled"),
            0u)
      << what;
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(BuildContactSpace(box, box).report().components, 1);
}

// A query is asked again and again: what stopped one answer stops no other.
TEST(BuildCancellation, StopsADepthAndNoLaterOneOfTheSameQuery) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  const DepthQuery boxes(box, box);
  const TriangleMesh knot = MakeKnot(1.0, 0.2, 96, 24);
  const DepthQuery knots(knot, knot);
  std::atomic<bool> is_done{false}, is_cancelled{false};
  std::thread asker([&] {
    try {
      knots.At(Eigen::Vector3d::Zero());
    } catch (const BuildCancelled&) {
      is_cancelled = true;
    }
    is_done = true;
  });
  while (!is_done) {
    CancelBuilds();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  asker.join();
  EXPECT_TRUE(is_cancelled);
  const Depth depth = boxes.At(Eigen::Vector3d(0.25, 0.0, 0.0));
  EXPECT_TRUE(depth.certified);
  EXPECT_NEAR(depth.depth, 0.75, 1e-12);
}

}  // namespace
}  // namespace phongpd
