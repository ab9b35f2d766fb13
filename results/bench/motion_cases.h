// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/penetration_tracker.h"

// What metrics are followed along: contact spaces, ways through them, and what
// a metric does from frame to frame.
namespace phongpd::bench {

struct MotionSpace {
  std::string name;
  ContactSpace contact;
};

// The paper's three, plates, rings, hollows, a knot, an organic body, a scan.
std::vector<MotionSpace> MotionSpaces();

// Positions of the robot, one a frame.
using Motion = std::vector<Eigen::Vector3d>;

// Straight ways between interior points, a bend to the side in every second.
std::vector<Motion> MakeMotions(const ContactSpace& contact, int motions,
                                int frames, std::uint64_t seed);

// Random walks from interior points: steps of 0.003 of the bounding box's
// diagonal, each in the direction of the one before and a third of a standard
// normal vector; the sides of the box throw them back.
std::vector<Motion> MakeWalks(const ContactSpace& contact, int motions,
                              int frames, std::uint64_t seed);

struct MotionStep {
  Eigen::Vector3d pd;
  bool left_elsewhere;  // outside, where the frame before led elsewhere
  bool sliding;         // of the tracker
  bool branch_ended;    // of a metric with branches
};
// Answers the positions of one motion in turn.
using Follower = std::function<MotionStep(const Eigen::Vector3d&)>;
using BeginFollowing = std::function<Follower()>;

// What they follow must outlive them.
BeginFollowing FollowMetric(const PenetrationMetric& metric);
BeginFollowing FollowTracker(const PenetrationTracker& tracker);

// Of every frame, 0 outside.
std::vector<double> EuclideanDepths(const PenetrationMetric& euclidean,
                                    const Motion& motion);

// A change of PD between two frames that counts as a jump, a share of D.
inline constexpr double kMotionJump = 0.05;

}  // namespace phongpd::bench
