// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/bvh/separators.h"
#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Where a straight motion first touches something.
struct MotionCheck {
  static constexpr int kNone = -1;
  static constexpr int kBounds = -2;

  bool free = true;
  double fraction = 1.0;  // of the motion up to the first contact, rounded;
                          // 0 when it starts in collision
  int obstacle = kNone;   // index of the contact space (or convolution model),
                          // or kBounds
  int triangle = -1;      // of that contact space; −1 inside it or at bounds,
                          // and where there is none but a convolution model
};

// The configurations q at which a translating robot touches nothing: strictly
// outside every contact space and strictly inside the bounds.
//
// A translating robot's motion from a to b is free iff the segment starts free
// and meets no contact surface (no sampling, no resolution), so
// every answer below but the distances is exact for the meshes given.  It is
// the judge of every path in this library.  Thread-safe.
//
// These questions are about free space only, so the convolution of robot and
// obstacle is enough to answer them, at a fraction of the cost of C_cont
// (convolution_model.h): OfConvolutions gives the same answers.
class FreeSpace {
 public:
  // One contact space per obstacle, or one for all of them (MergedObstacle).
  // Empty bounds: none.  Throws InputError for bounds that hold NaN or are
  // infinite.
  explicit FreeSpace(std::vector<ContactSpace> spaces,
                     const BoundingBox& bounds = NoBounds());
  // One model per obstacle, or one for all of them.  Throws as above.
  static FreeSpace OfConvolutions(std::vector<ConvolutionModel> models,
                                  const BoundingBox& bounds = NoBounds());
  ~FreeSpace();
  FreeSpace(FreeSpace&&) noexcept;
  FreeSpace& operator=(FreeSpace&&) noexcept;

  static BoundingBox NoBounds();
  // Throws InputError "bounds: …" for NaN or infinity.
  static void CheckBounds(const BoundingBox& bounds);

  // Exact.  False for non-finite q.
  bool IsFree(const Eigen::Vector3d& q) const;
  // Exact: every point of the closed segment is free.
  bool IsFree(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  // `free` is exact, and the rest says what is met first.
  MotionCheck Check(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // Distance from q to the nearest contact surface or bound, ≥ 0, rounded;
  // infinity if there is neither; 0 for non-finite q.  Convolution models know
  // it for free q only, and answer 0 for all others.
  double Clearance(const Eigen::Vector3d& q) const;
  // The least over the closed segment; 0 if it is not free.
  double Clearance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // Planes that separate a segment from all contact triangles within `radius`,
  // the nearest first (none for the bounds).  A triangle has no plane of its
  // own if it is behind the plane of a nearer one, or above it by at most
  // `slack` (separators.h).  Convolution models give planes of their facets,
  // also of those hidden behind C_cont.  Rounded; empty for non-finite points
  // and for lengths that are not ≥ 0.
  std::vector<Separator> FindSeparators(const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b, double radius,
                                        double slack) const;

  // Empty where the answers come from convolution models, and the other way
  // round.
  const std::vector<ContactSpace>& spaces() const;
  const std::vector<ConvolutionModel>& convolutions() const;
  std::size_t size() const { return spaces().size(); }
  const BoundingBox& bounds() const;

 private:
  struct Impl;
  explicit FreeSpace(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

// Σ |p_{i+1} − p_i| of a polyline.
double PathLength(const std::vector<Eigen::Vector3d>& path);

// The first collision along a polyline.
struct PathCheck {
  bool free = false;  // no: also for an empty path
  int segment = -1;   // of the first collision; point k → point k + 1
  MotionCheck motion;
};

// Exact.  A path of one point is its point.
PathCheck CheckPath(const FreeSpace& space,
                    const std::vector<Eigen::Vector3d>& path);

// The smallest distance from any point of a polyline to the nearest contact
// surface or bound, rounded; 0 if the path is not free or empty.
double PathClearance(const FreeSpace& space,
                     const std::vector<Eigen::Vector3d>& path);

}  // namespace phongpd
