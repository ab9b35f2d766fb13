// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/contact/robot_pose.h"
#include "core/solid/solid.h"

// How deep?  Which to take:
//
//   two meshes as they lie; few poses, turned ones too
//       PenetrationDepth, DepthQuery (here): the least depth, nothing built
//   a robot that translates, many positions
//       ContactSpace once, then EuclideanMetric: the least depth
//   ... and a direction that does not jump where the nearest point does
//       SmoothedMetric: the same depth, for solvers
//   ... and depths and directions that go on from one position to the next
//       PhongMetric: continuous along a branch, with exact derivatives
//   few such depths, and no contact space
//       WindowPhong, WindowSmoothed: the metric's own, cold, from what is near
//   a motion without a jump, whatever the shape; nothing to differentiate
//       PenetrationTracker: a contact that slides, at the price of depth
//   rows of a nonlinear program
//       SignedMetric for a robot that translates, PoseRow for one that turns
//
// All answer with a Depth, or with a result that has more and becomes a Depth
// by ToDepth.  "Where", its status, is exact and means the same for all; how an
// answer goes on from the one before is QueryStatus.
namespace phongpd {

enum class DepthStatus {
  kPenetrating,  // q is strictly inside C_obj
  kTouching,     // q lies on C_cont: the solids meet, an arbitrarily small
                 // motion parts them
  kSeparate,     // the solids share no point
  kInvalid,      // q is not finite; DepthQuery throws instead
};

const char* ToString(DepthStatus status);  // "penetrating", ...

// How much of C_cont was modelled for an answer.
enum class DepthLevel {
  kNone,    // nothing: the solids are apart
  kWindow,  // boxes around q
  kFull,    // all of it
};
const char* ToString(DepthLevel level);  // "none", "window", "full"

// The feature of an operand that a witness point lies on: one, two or three
// vertices of the mesh that the query was made with (the first of those at the
// same place); −1 for the others.
struct ContactFeature {
  enum Kind { kNone, kVertex, kEdge, kFacet };
  Kind kind = kNone;
  std::array<int, 3> vertices = {-1, -1, -1};
};

const char* ToString(ContactFeature::Kind kind);  // "none", "vertex", ...

// The answer.  Lengths in the user's unit.
struct Depth {
  DepthStatus status = DepthStatus::kSeparate;
  // Euclidean penetration depth min |q_c − q| over q_c on C_cont (paper, Eqs. 1
  // and 2), the length of the shortest translation after which A touches B from
  // outside; 0 unless penetrating.
  // Of PhongPD and trackers: |q_c − q| with their own q_c, which is no less.
  double depth = 0.0;
  // Least distance between the solids; 0 unless separate.
  double clearance = 0.0;
  // Unit: towards q_c when penetrating, the facet's outward normal when
  // touching, away from q_c when separate.  A + q leaves B along it.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  // q_c, the configuration nearest to q at which A touches B.
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  // The pair of points that touch there: one of A as it is placed, one of B;
  // on_obstacle − on_robot = q_c − q.  One pair of perhaps several; zero if the
  // features are kNone.
  Eigen::Vector3d on_robot = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_obstacle = Eigen::Vector3d::Zero();
  ContactFeature robot_feature, obstacle_feature;
  // The answer is the global one: it is within explored_radius, and everything
  // nearer than that was looked at.  Otherwise a limit was met: the true depth
  // is at least explored_radius and at most `depth`, which is a translation
  // that suffices; features are kNone if no point of C_cont was found.
  bool certified = false;
  double explored_radius = 0.0;
  DepthLevel level = DepthLevel::kNone;
  // By how much coordinates were rounded at most, to lie on the grid; 0: not at
  // all.  The answer is exact for the rounded solids, but for rounding in
  // double; for the given solids depth and clearance hold to 4·√3 times this.
  double grid_step = 0.0;
  std::size_t arranged_faces = 0;  // over all windows
  int windows = 0;
  // Those windows: cubes around q with these half-widths, in the order in which
  // they were built, their sides along the columns of `window_axes`.
  std::vector<double> window_reaches;
  Eigen::Matrix3d window_axes = Eigen::Matrix3d::Identity();
  double seconds = 0.0;  // wall time of the query

  // −depth, 0 or the clearance: its sign is that of the status.
  double SignedDistance() const { return clearance - depth; }
};

using DepthResult = Depth;  // what it was called

struct DepthOptions {
  // Explore no farther than this around q, user's unit: > 0.
  double max_radius = std::numeric_limits<double>::infinity();
  // Start no window after this; 0: no limit.
  double max_seconds = 0.0;
  // What messages call operands that are meshes; a Solid has its own name.
  std::string robot_name = "robot";
  std::string obstacle_name = "obstacle";
};

// Exact penetration depth of two solids of any genus as they lie, with nothing
// computed in advance.  C_cont = ∂(B ⊕ (−A)) is modelled in boxes around q
// only, the smallest first, until the answer is certified (core/README.md).  It
// is the answer of EuclideanMetric on the whole contact space.
//
// `At` is const and thread-safe.  Queries in the orientation in which the robot
// was given share what was prepared; every other orientation is prepared anew.
class DepthQuery {
 public:
  // Throws InputError naming the operand where no solid is left of it on the
  // grid; meshes become solids by MakeSolid, by the options' names, which
  // throws where they are none.
  DepthQuery(const Solid& robot, const Solid& obstacle,
             const DepthOptions& options = {});
  DepthQuery(const TriangleMesh& robot, const TriangleMesh& obstacle,
             const DepthOptions& options = {});
  ~DepthQuery();
  DepthQuery(DepthQuery&&) noexcept;
  DepthQuery& operator=(DepthQuery&&) noexcept;

  // The robot moved by q.  Throws InputError unless q is finite and within
  // 1e15 times the size of the operands, and BuildCancelled after CancelBuilds
  // (build_stop.h).
  Depth At(const Eigen::Vector3d& q) const;

  // The robot turned, then moved: translational depth at a pose.  Throws
  // InputError also unless | |quaternion| − 1 | ≤ 1e-9.
  Depth At(const RobotPose& pose) const;

  // What a user should know about the operands although it is no error: a
  // sentence each, with the operand's name.
  const std::vector<std::string>& warnings() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The same once.
Depth PenetrationDepth(const Solid& robot, const Solid& obstacle,
                       const RobotPose& pose = {},
                       const DepthOptions& options = {});
Depth PenetrationDepth(const TriangleMesh& robot, const TriangleMesh& obstacle,
                       const RobotPose& pose = {},
                       const DepthOptions& options = {});

}  // namespace phongpd
