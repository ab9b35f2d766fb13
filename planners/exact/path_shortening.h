// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace phongpd {

class FreeSpace;
class TriangleBvh;

// A new segment keeps min(clearance, a share of the least clearance of what it
// replaces on the path given): this share unless another is asked for.
inline constexpr double kClearanceKept = 0.8;

struct ShorteningOptions {
  // Clearance that is enough, user's unit; ≥ 0.
  double clearance = 0.0;
  int random_cuts = 200;
  int pulls = 12;  // rounds over all inner points
  std::uint64_t seed = 1;
};

// Shortens a path that meets no surface: points left out as far as can be
// seen, straight cuts between random points, and points pulled towards the
// line between their neighbours.  Every segment of the result is free by an
// exact test and keeps its clearance relative to the path *given*, so that
// repeated cuts do not add up, by kept_share, in (0, 1].  Ends stay.  Same
// arguments, same path.
std::vector<Eigen::Vector3d> ShortenPath(
    const std::vector<Eigen::Vector3d>& path, const TriangleBvh& segments,
    const ShorteningOptions& options, double kept_share = kClearanceKept);
// The same for a path that is free in `space`, bounds included.
std::vector<Eigen::Vector3d> ShortenPath(
    const std::vector<Eigen::Vector3d>& path, const FreeSpace& space,
    const ShorteningOptions& options, double kept_share = kClearanceKept);

}  // namespace phongpd
