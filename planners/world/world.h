// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/contact/contact_space_cache.h"
#include "planners/world/diagnosis.h"
#include "planners/world/length.h"
#include "planners/world/workspace.h"

namespace phongpd {

// How the obstacles of a world become contact spaces.
enum class SpaceLayout {
  kMerged,       // one, of all of them
  kPerObstacle,  // one each; they may overlap
  kSealed,       // one, of all of them and the bounds: what planners need
};

// The contact spaces of one layout; only what the robot can touch within the
// bounds is in them.  All have the world's D for length.
struct WorldSpaces {
  std::vector<ContactSpace> spaces;
  // Of those, and of the bounds where they are no part of them.
  std::shared_ptr<const FreeSpace> free_space;
  std::size_t triangles = 0;  // of all spaces

  // Their meshes, for pictures.
  std::vector<TriangleMesh> Meshes() const;
};

// Free space alone, without contact spaces, and of the convolution only what
// questions lead to: all there is to model for whoever only asks whether
// motions are free and how much room they have.
struct WorldConvolution {
  std::vector<ConvolutionModel> models;  // one of all obstacles, or none
  // Of that and the bounds.
  std::shared_ptr<const FreeSpace> free_space;

  std::size_t facets() const;  // modelled so far
};

// What a world may spend on one contact space (ContactSpaceOptions).
struct WorldLimits {
  double max_seconds = 0.0;  // on all parts of it; 0: no limit
  double max_mib = 0.0;      // 0: nine tenths of what is free
};

// What a world has built so far.
struct WorldReport {
  int contact_spaces = 0;  // built, or read from the cache: the full level
  // Those of obstacles that are apart are built one by one (obstacle_groups.h),
  // kept one by one and joined, so that what moves does not cost what stays.
  int parts = 0;
  int parts_from_cache = 0;
  int convolutions = 0;     // built: free space alone
  double seconds = 0.0;     // spent on them, and on what limits refused
  bool from_cache = false;  // at least one part of them
  std::vector<std::string> warnings;
};

// A robot that translates among named obstacles, perhaps within bounds, and
// all that planners and optimisers share of it: the length D that options are
// told in, the diagnosis of start and goal, and contact spaces, which are
// built when somebody asks for them, once, and kept.
//
//   World world(workspace);
//   Diagnosis start = world.Diagnose(q);                // nothing is built
//   const WorldSpaces& s = world.Spaces(SpaceLayout::kSealed);
//   ContactSurfacePlanner planner(s.spaces[0]);
//
// A handle: copies are cheap and share what is built.  Thread-safe; whoever
// asks for what another thread is building waits for it.
class World {
 public:
  // `name` begins the messages about its solids.  Throws InputError like
  // Workspace::Validate, and if there is nothing to collide with: neither an
  // obstacle nor bounds.
  explicit World(Workspace workspace, const std::string& name = "world",
                 const ContactSpaceCache& cache = {},
                 const WorldLimits& limits = {});

  const Workspace& workspace() const;
  const std::string& name() const;

  // D, the one length of the world: the diagonal of ContactBounds(workspace),
  // > 0, whatever the layout; bounds are no part of it where an obstacle can be
  // reached.  User's unit.
  double diagonal() const;
  ResolvedLength Resolve(const Length& length) const {
    return length.Resolve(diagonal());
  }

  // Exact, on the solids; builds nothing (diagnosis.h).
  Diagnosis Diagnose(const Eigen::Vector3d& q) const;
  // Does the robot touch nothing anywhere on the polyline, and is it within
  // bounds?  Exact, without sampling, by Judge(); CheckPath on that tells where
  // it collides first.  False where a number is not finite, and for no point.
  bool IsFree(const std::vector<Eigen::Vector3d>& path) const;
  // The free space that answers: of contact spaces that are there already, or
  // else of free space alone, built on first use.
  const FreeSpace& Judge() const;

  // Builds them on first use, one after the other (each build is parallel), or
  // takes them from the cache.  The reference holds as long as a copy of the
  // world does.  Throws what BuildContactSpace throws (BuildRefusal at the
  // limits), and then builds anew when asked again.
  const WorldSpaces& Spaces(SpaceLayout layout) const;
  // spaces[0] of kSealed, whose free cells end at the bounds.
  const ContactSpace& Sealed() const;
  // What there is of them already; null before Spaces.
  const WorldSpaces* Built(SpaceLayout layout) const;

  // Free space at a fraction of the cost of Spaces, with the same answers;
  // built on first use and kept as those are.  Throws what ConvolutionModel
  // throws.
  const WorldConvolution& Convolution() const;
  // Null before Convolution.
  const WorldConvolution* BuiltConvolution() const;
  // Of all that Sealed is of, the bounds too: what is explored to tell cells
  // apart (WindowPlanner).
  const ConvolutionModel& SealedConvolution() const;
  WorldReport Report() const;

  // What others make of a world and need again: tables of a planner, metrics.
  // Made on first use, and kept as long as `tag` is among the last
  // kMostKept of its type.  Thread-safe; whoever asks for what is being made
  // waits for it.  Throws what `make` throws, and keeps nothing then.
  template <typename T>
  std::shared_ptr<const T> Kept(const std::string& tag,
                                const std::function<T()>& make) const {
    return std::static_pointer_cast<const T>(KeptAny(
        typeid(T).name(), tag, [&make]() -> std::shared_ptr<const void> {
          return std::make_shared<const T>(make());
        }));
  }
  static constexpr std::size_t kMostKept = 32;

 private:
  std::shared_ptr<const void> KeptAny(
      const std::string& type, const std::string& tag,
      const std::function<std::shared_ptr<const void>()>& make) const;

  struct Impl;
  std::shared_ptr<Impl> impl_;
};

// Have both the same solids and bounds, obstacles by the same names in the same
// order, so that one world serves both?
bool HaveSameSolids(const Workspace& a, const Workspace& b);
// Throws InputError naming `scene` unless the world has those.
void RequireSameSolids(const Workspace& workspace, const World& world,
                       const std::string& scene);

}  // namespace phongpd
