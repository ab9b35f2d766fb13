// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/random_ends.h"

namespace phongpd::bench {

using Eigen::Vector3d;

Ends RandomEnds(const World& world, std::mt19937_64* random) {
  const BoundingBox box = ContactBounds(world.workspace());
  const Vector3d more = 0.1 * (box.max - box.min);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const FreeSpace& space = *world.Convolution().free_space;
  const auto draw = [&] {
    for (;;) {
      Vector3d q;
      for (int k = 0; k < 3; ++k) {
        q[k] = box.min[k] - more[k] +
               share(*random) * (box.max[k] - box.min[k] + 2.0 * more[k]);
      }
      if (space.IsFree(q) && space.Clearance(q) > 0.02 * world.diagonal()) {
        return q;
      }
    }
  };
  for (;;) {
    const Ends ends = {draw(), draw()};
    if (!world.IsFree({ends.start, ends.goal})) return ends;
  }
}

}  // namespace phongpd::bench
