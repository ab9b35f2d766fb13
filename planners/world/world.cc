// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/world.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <utility>

#include "core/contact/joined_contact_spaces.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "core/stopwatch.h"
#include "planners/world/obstacle_groups.h"

namespace phongpd {
namespace {

// "a, b, c"; of many the first, and how many more.
std::string NameOf(const std::vector<Solid>& solids) {
  constexpr std::size_t kMost = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(solids.size(), kMost); ++i) {
    names += (i == 0 ? "" : ", ") + solids[i].name();
  }
  if (solids.size() > kMost) {
    names += " and " + std::to_string(solids.size() - kMost) + " more";
  }
  return names;
}

}  // namespace

std::vector<TriangleMesh> WorldSpaces::Meshes() const {
  std::vector<TriangleMesh> meshes;
  for (const ContactSpace& space : spaces) meshes.push_back(space.mesh());
  return meshes;
}

struct World::Impl {
  struct Slot {
    std::mutex mutex;  // held while building
    std::unique_ptr<const WorldSpaces> spaces;
  };

  // Without bounds there is nothing to seal.
  Slot& SlotOf(SpaceLayout layout) {
    const bool is_merged =
        layout == SpaceLayout::kMerged && !workspace.bounds.IsEmpty();
    const bool is_each = layout == SpaceLayout::kPerObstacle;
    return slots[is_each ? 2 : is_merged ? 1 : 0];
  }

  // Adds the wall time of a build to the report, also of one that is refused.
  struct Spent {
    ~Spent() {
      const std::lock_guard<std::mutex> lock(world->report_mutex);
      world->report.seconds += stopwatch.Seconds();
    }
    Impl* world;
    Stopwatch stopwatch = {};
  };

  // Of which `spent` seconds are gone.
  ContactSpaceOptions Options(double spent = 0.0) const {
    constexpr double kNoTime = 1e-9;
    ContactSpaceOptions options;
    if (limits.max_seconds > 0.0) {
      options.max_seconds = std::max(limits.max_seconds - spent, kNoTime);
    }
    options.max_mib = limits.max_mib;
    return options;
  }

  // Its name in messages, of which the world's is the beginning.
  Solid Called(const Solid& solid, const std::string& what) const {
    return solid.Named(name + ": " + what);
  }

  // Of obstacles that one build must hold.
  ContactSpace BuildPart(const Solid& obstacle, double spent) {
    ContactSpace built = BuildContactSpaceCached(
        Called(workspace.robot, "robot"), Called(obstacle, obstacle.name()),
        Options(spent), cache);
    const std::lock_guard<std::mutex> lock(report_mutex);
    ++report.parts;
    report.parts_from_cache += built.report().from_cache ? 1 : 0;
    report.from_cache = report.parts_from_cache > 0;
    report.warnings.insert(report.warnings.end(),
                           built.report().warnings.begin(),
                           built.report().warnings.end());
    return built;
  }

  // One space of all of them, by `what` in messages.
  ContactSpace Build(const std::vector<Solid>& obstacles,
                     const std::string& what) {
    const Spent spent{this};
    const auto groups = ObstacleGroups(workspace.robot, obstacles);
    std::vector<ContactSpace> parts;
    for (const std::vector<int>& group : groups) {
      std::vector<Solid> members;
      for (const int i : group) {
        members.push_back(obstacles[static_cast<std::size_t>(i)]);
      }
      const bool is_all = groups.size() == 1 && members.size() > 1;
      parts.push_back(
          BuildPart(JoinedSolids(members, is_all ? what : NameOf(members)),
                    spent.stopwatch.Seconds()));
    }
    {
      const std::lock_guard<std::mutex> lock(report_mutex);
      ++report.contact_spaces;
    }
    return JoinedContactSpaces(parts).WithLength(diagonal);
  }

  std::unique_ptr<const WorldSpaces> BuildAll(SpaceLayout layout) {
    auto all = std::make_unique<WorldSpaces>();
    const bool has_bounds = !workspace.bounds.IsEmpty();
    const bool is_sealed = layout == SpaceLayout::kSealed && has_bounds;
    const std::vector<int> reachable = ReachableObstacles(workspace);
    if (layout == SpaceLayout::kPerObstacle) {
      for (const int i : reachable) {
        const Solid& obstacle =
            workspace.obstacles[static_cast<std::size_t>(i)];
        all->spaces.push_back(Build({obstacle}, obstacle.name()));
      }
    } else if (is_sealed || !reachable.empty()) {
      std::vector<Solid> obstacles;
      for (const int i : reachable) {
        obstacles.push_back(workspace.obstacles[static_cast<std::size_t>(i)]);
      }
      if (is_sealed) obstacles.push_back(BoundsShell(workspace));
      all->spaces.push_back(
          Build(obstacles, is_sealed ? "obstacles and bounds" : "obstacles"));
    }
    for (const ContactSpace& space : all->spaces) {
      all->triangles += space.mesh().triangles.size();
    }
    // Bounds that are part of the mesh need no second test.
    all->free_space = std::make_shared<FreeSpace>(
        all->spaces, is_sealed ? FreeSpace::NoBounds() : workspace.bounds);
    return all;
  }

  ConvolutionModel BuildModel(const Solid& obstacle, const std::string& what) {
    const Spent spent{this};
    ConvolutionModel model(Called(workspace.robot, "robot"),
                           Called(obstacle, what), Options());
    const std::lock_guard<std::mutex> lock(report_mutex);
    ++report.convolutions;
    report.warnings.insert(report.warnings.end(),
                           model.report().warnings.begin(),
                           model.report().warnings.end());
    return model;
  }

  std::unique_ptr<const WorldConvolution> BuildConvolution() {
    auto all = std::make_unique<WorldConvolution>();
    if (!ReachableObstacles(workspace).empty()) {
      all->models.push_back(BuildModel(JoinedObstacle(workspace), "obstacles"));
    }
    all->free_space = std::make_shared<FreeSpace>(
        FreeSpace::OfConvolutions(all->models, workspace.bounds));
    return all;
  }

  Workspace workspace;
  std::string name;
  ContactSpaceCache cache;
  WorldLimits limits;
  double diagonal = 0.0;
  std::array<Slot, 3> slots;
  std::mutex convolution_mutex;  // held while building
  std::unique_ptr<const WorldConvolution> convolution;
  std::mutex sealed_mutex;  // held while building
  std::unique_ptr<const ConvolutionModel> sealed_convolution;
  std::mutex report_mutex;
  WorldReport report;
  // Of a type, the last ones with their tags, the oldest first.
  struct Shelf {
    std::mutex mutex;  // held while making
    std::vector<std::pair<std::string, std::shared_ptr<const void>>> items;
  };
  std::mutex shelves_mutex;
  std::map<std::string, Shelf> shelves;
};

std::size_t WorldConvolution::facets() const {
  std::size_t facets = 0;
  for (const ConvolutionModel& model : models) facets += model.facets();
  return facets;
}

World::World(Workspace workspace, const std::string& name,
             const ContactSpaceCache& cache, const WorldLimits& limits)
    : impl_(std::make_shared<Impl>()) {
  workspace.Validate();
  if (workspace.obstacles.empty() && workspace.bounds.IsEmpty()) {
    throw InputError(name + ": expected an obstacle or bounds, found neither");
  }
  impl_->diagonal = ContactBounds(workspace).Diagonal();
  impl_->workspace = std::move(workspace);
  impl_->name = name;
  impl_->cache = cache;
  impl_->limits = limits;
}

const Workspace& World::workspace() const { return impl_->workspace; }
const std::string& World::name() const { return impl_->name; }
double World::diagonal() const { return impl_->diagonal; }

Diagnosis World::Diagnose(const Eigen::Vector3d& q) const {
  return phongpd::Diagnose(impl_->workspace, q);
}

bool World::IsFree(const std::vector<Eigen::Vector3d>& path) const {
  return CheckPath(Judge(), path).free;
}

const FreeSpace& World::Judge() const {
  const WorldSpaces* const built = Built(SpaceLayout::kMerged);
  return built == nullptr ? *Convolution().free_space : *built->free_space;
}

const WorldSpaces& World::Spaces(SpaceLayout layout) const {
  Impl::Slot& slot = impl_->SlotOf(layout);
  const std::lock_guard<std::mutex> lock(slot.mutex);
  if (slot.spaces == nullptr) {
    // A thread that waits for its own tasks must not take up one of a caller
    // that asks for the same spaces: it would wait for itself.
    tbb::this_task_arena::isolate(
        [&] { slot.spaces = impl_->BuildAll(layout); });
  }
  return *slot.spaces;
}

const ContactSpace& World::Sealed() const {
  return Spaces(SpaceLayout::kSealed).spaces.front();
}

const WorldSpaces* World::Built(SpaceLayout layout) const {
  Impl::Slot& slot = impl_->SlotOf(layout);
  const std::lock_guard<std::mutex> lock(slot.mutex);
  return slot.spaces.get();
}

const WorldConvolution& World::Convolution() const {
  const std::lock_guard<std::mutex> lock(impl_->convolution_mutex);
  if (impl_->convolution == nullptr) {
    // As in Spaces.
    tbb::this_task_arena::isolate(
        [&] { impl_->convolution = impl_->BuildConvolution(); });
  }
  return *impl_->convolution;
}

const WorldConvolution* World::BuiltConvolution() const {
  const std::lock_guard<std::mutex> lock(impl_->convolution_mutex);
  return impl_->convolution.get();
}

const ConvolutionModel& World::SealedConvolution() const {
  // Without bounds there is nothing to seal.
  if (impl_->workspace.bounds.IsEmpty()) return Convolution().models.front();
  const std::lock_guard<std::mutex> lock(impl_->sealed_mutex);
  if (impl_->sealed_convolution == nullptr) {
    // As in Spaces.
    tbb::this_task_arena::isolate([&] {
      impl_->sealed_convolution =
          std::make_unique<const ConvolutionModel>(impl_->BuildModel(
              MergedObstacle(impl_->workspace), "obstacles and bounds"));
    });
  }
  return *impl_->sealed_convolution;
}

WorldReport World::Report() const {
  const std::lock_guard<std::mutex> lock(impl_->report_mutex);
  return impl_->report;
}

std::shared_ptr<const void> World::KeptAny(
    const std::string& type, const std::string& tag,
    const std::function<std::shared_ptr<const void>()>& make) const {
  Impl::Shelf& shelf = [&]() -> Impl::Shelf& {
    const std::lock_guard<std::mutex> lock(impl_->shelves_mutex);
    return impl_->shelves[type];
  }();
  const std::lock_guard<std::mutex> lock(shelf.mutex);
  for (const auto& [known, item] : shelf.items) {
    if (known == tag) return item;
  }
  std::shared_ptr<const void> made;
  // As in Spaces.
  tbb::this_task_arena::isolate([&] { made = make(); });
  if (shelf.items.size() == kMostKept) shelf.items.erase(shelf.items.begin());
  shelf.items.emplace_back(tag, made);
  return made;
}

bool HaveSameSolids(const Workspace& a, const Workspace& b) {
  if (!a.robot.HasSameMesh(b.robot) ||
      a.obstacles.size() != b.obstacles.size() ||
      a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max) {
    return false;
  }
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    if (a.obstacles[i].name() != b.obstacles[i].name() ||
        !a.obstacles[i].HasSameMesh(b.obstacles[i])) {
      return false;
    }
  }
  return true;
}

void RequireSameSolids(const Workspace& workspace, const World& world,
                       const std::string& scene) {
  if (HaveSameSolids(workspace, world.workspace())) return;
  throw InputError(scene + ": expected the solids and bounds of the world " +
                   world.name() + ", found others");
}

}  // namespace phongpd
