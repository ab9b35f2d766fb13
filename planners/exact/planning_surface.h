// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/projection/contact_surface.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/free_cells.h"
#include "planners/exact/route_order.h"

namespace phongpd {

// The merged contact space as planners need it, and what every query begins
// and ends with.  Thread-safe; stays where it is, its members refer to each
// other.
struct PlanningSurface {
  // Throws InputError for options.
  PlanningSurface(const ContactSpace& space,
                  const ContactSurfaceOptions& given_options,
                  ObstacleNames names);
  PlanningSurface(const PlanningSurface&) = delete;
  PlanningSurface& operator=(const PlanningSurface&) = delete;

  // A result with evidence, certificates, and its status where no path is to
  // be looked for; kFailed without a reason where one is.
  PlanResult Begin(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                   const RouteRequest& request) const;

  // The lesser clearance of two free configurations, at most the wish > 0.
  double ClearanceOfEnds(const Eigen::Vector3d& start,
                         const Eigen::Vector3d& goal, double clearance) const;
  // Is the straight way free, and about as clear as its ends and the wish
  // allow; as clear, where the wish is to be kept?
  bool IsClearWay(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                  const PlanResult& result) const;
  // The share of the clearance of the ends with which a way is clear.
  static double ShareOfEnds(const PlanResult& result) {
    return result.keeps_clearance ? kKeptOfClearance : 0.4;
  }
  // How far routes are lifted and centred.  Segments between lifted points
  // come nearer than these, and are split only below 0.6 of them.
  static double LiftOf(const PlanResult& result) {
    return result.wanted_clearance * (result.keeps_clearance ? 2.0 : 1.0);
  }

  // Does a path of that clearance stay free whatever rounding did to the
  // surface?  With less it may lead where solids touch.
  bool IsCertain(double clearance) const {
    return RouteOrder(cells.rounding()).IsCertain(clearance);
  }

  // Makes a free path the result if it is better (RouteOrder).
  void Offer(std::vector<Eigen::Vector3d> raw_path,
             std::vector<Eigen::Vector3d> path, PlanResult* result) const;
  // The same after it has been centred and shortened.
  void Keep(std::vector<Eigen::Vector3d> raw_path, int random_cuts,
            PlanResult* result) const;

  // Enough in the cell of that number: kEnoughClearance of its hull.
  double WantedClearance(int cell) const;
  // Of a path that is free, at most what it has at its start.
  double ClearanceOf(const std::vector<Eigen::Vector3d>& path) const;

  const ContactSurfaceOptions options;
  const ContactSurface contact;
  const TriangleBvh& segments;  // of the space
  const BoundingBox bounds;
  const std::vector<std::array<int, 3>> neighbors;
  const FreeCells cells;

 private:
  std::string WhyInvalid(const char* which, const Eigen::Vector3d& q) const;
  CellCertificate Locate(const Eigen::Vector3d& q) const;

  ObstacleNames names_;
  std::vector<BoundingBox> piece_bounds_;
};

}  // namespace phongpd
