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

// The contact spaces of one layout.  They hold only what the robot can touch
// within the bounds, and all have the world's D as their length.
struct WorldSpaces {
  std::vector<ContactSpace> spaces;
  // Of these spaces, and of the bounds unless they are part of a space.
  std::shared_ptr<const FreeSpace> free_space;
  std::size_t triangles = 0;  // of all spaces

  // Their meshes, for pictures.
  std::vector<TriangleMesh> Meshes() const;
};

// Free space alone, without contact spaces.  Facets of the convolution are made
// when a question needs them.  It is enough to answer whether motions are free
// and how much room they have.
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
  // Obstacles that are apart are built one by one (obstacle_groups.h), kept in
  // the cache one by one, and joined: if one of them is moved, the others need
  // not be built again.
  int parts = 0;
  int parts_from_cache = 0;
  int convolutions = 0;     // built: free space alone
  double seconds = 0.0;     // spent on them, and on what limits refused
  bool from_cache = false;  // at least one part of them
  std::vector<std::string> warnings;
};

// A robot that translates among named obstacles, perhaps within bounds, and
// what all planners and optimisers need of it: the length D that options refer
// to, the diagnosis of start and goal, and contact spaces.  These are built
// once, when somebody asks for them, and kept.
//
//   World world(workspace);
//   Diagnosis start = world.Diagnose(q);                // nothing is built
//   const WorldSpaces& s = world.Spaces(SpaceLayout::kSealed);
//   ContactSurfacePlanner planner(s.spaces[0]);
//
// A handle: copies are cheap and share what is built.  Thread-safe: a thread
// that asks for something that another one is building waits for it.
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

  // D, the one length of the world, > 0, user's unit: the diagonal of
  // ContactBounds(workspace), the same for all layouts.  Bounds count only if
  // no obstacle can be reached.
  double diagonal() const;
  ResolvedLength Resolve(const Length& length) const {
    return length.Resolve(diagonal());
  }

  // Exact, on the solids; builds nothing (diagnosis.h).
  Diagnosis Diagnose(const Eigen::Vector3d& q) const;
  // Is the whole polyline free and within the bounds?  Exact, without sampling,
  // by Judge(); CheckPath with that tells where the robot collides first. False
  // for an empty path, and if a number is not finite.
  bool IsFree(const std::vector<Eigen::Vector3d>& path) const;
  // The free space that IsFree asks: from contact spaces that are built
  // already; otherwise from Convolution(), built on first use.
  const FreeSpace& Judge() const;

  // Builds the contact spaces on first use, one after the other (each build
  // uses all threads), or takes them from the cache.  The reference is valid as
  // long as a copy of the world exists.  Throws what BuildContactSpace throws
  // (BuildRefusal at the limits); the next call then tries again.
  const WorldSpaces& Spaces(SpaceLayout layout) const;
  // spaces[0] of kSealed, whose free cells end at the bounds.
  const ContactSpace& Sealed() const;
  // The spaces if they are built already; null before Spaces.
  const WorldSpaces* Built(SpaceLayout layout) const;

  // Free space at a fraction of the cost of Spaces, with the same answers;
  // built on first use and kept as those are.  Throws what ConvolutionModel
  // throws.
  const WorldConvolution& Convolution() const;
  // Null before Convolution.
  const WorldConvolution* BuiltConvolution() const;
  // The model of all that is in Sealed, with the bounds: WindowPlanner explores
  // it to tell cells apart.
  const ConvolutionModel& SealedConvolution() const;
  WorldReport Report() const;

  // Keeps what others make of a world and need again, such as metrics or tables
  // of a planner.  It is made on first use, and kept while `tag` is among the
  // last kMostKept of its type.  Thread-safe: a second thread that asks for it
  // waits until it is made.  Throws what `make` throws, and then keeps nothing.
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

// Do both have the same solids and bounds, with the same names of obstacles in
// the same order?  Then one world serves both.
bool HaveSameSolids(const Workspace& a, const Workspace& b);

}  // namespace phongpd
