// SPDX-License-Identifier: GPL-3.0-or-later
// A build that would take minutes, stopped by another thread.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/contact/contact_space.h"
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

}  // namespace
}  // namespace phongpd
