// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/world/world.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"

namespace phongpd {
namespace {

bool IsSame(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
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

  ContactSpaceOptions Options(const std::string& what) const {
    ContactSpaceOptions options;
    options.robot_name = name + ": robot";
    options.obstacle_name = name + ": " + what;
    options.max_seconds = limits.max_seconds;
    options.max_mib = limits.max_mib;
    return options;
  }

  ContactSpace Build(const TriangleMesh& obstacle, const std::string& what) {
    const Spent spent{this};
    ContactSpace built = BuildContactSpaceCached(workspace.robot, obstacle,
                                                 Options(what), cache);
    const std::lock_guard<std::mutex> lock(report_mutex);
    ++report.contact_spaces;
    report.from_cache = report.from_cache || built.report().from_cache;
    report.warnings.insert(report.warnings.end(),
                           built.report().warnings.begin(),
                           built.report().warnings.end());
    return built.WithLength(diagonal);
  }

  std::unique_ptr<const WorldSpaces> BuildAll(SpaceLayout layout) {
    auto all = std::make_unique<WorldSpaces>();
    const bool has_bounds = !workspace.bounds.IsEmpty();
    const bool is_sealed = layout == SpaceLayout::kSealed && has_bounds;
    const std::vector<int> reachable = ReachableObstacles(workspace);
    if (layout == SpaceLayout::kPerObstacle) {
      for (const int i : reachable) {
        const Obstacle& obstacle =
            workspace.obstacles[static_cast<std::size_t>(i)];
        all->spaces.push_back(Build(obstacle.mesh, obstacle.id));
      }
    } else if (is_sealed) {
      all->spaces.push_back(
          Build(MergedObstacle(workspace), "obstacles and bounds"));
    } else if (!reachable.empty()) {
      all->spaces.push_back(Build(JoinedObstacle(workspace), "obstacles"));
    }
    for (const ContactSpace& space : all->spaces) {
      all->triangles += space.mesh().triangles.size();
    }
    // Bounds that are part of the mesh need no second test.
    all->free_space = std::make_shared<FreeSpace>(
        all->spaces, is_sealed ? FreeSpace::NoBounds() : workspace.bounds);
    return all;
  }

  std::unique_ptr<const WorldConvolution> BuildConvolution() {
    auto all = std::make_unique<WorldConvolution>();
    if (!ReachableObstacles(workspace).empty()) {
      const Spent spent{this};
      const ConvolutionModel& model = all->models.emplace_back(
          workspace.robot, JoinedObstacle(workspace), Options("obstacles"));
      all->facets = model.report().facets;
      const std::lock_guard<std::mutex> lock(report_mutex);
      ++report.convolutions;
      report.warnings.insert(report.warnings.end(),
                             model.report().warnings.begin(),
                             model.report().warnings.end());
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
  std::mutex report_mutex;
  WorldReport report;
};

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

WorldReport World::Report() const {
  const std::lock_guard<std::mutex> lock(impl_->report_mutex);
  return impl_->report;
}

bool HaveSameSolids(const Workspace& a, const Workspace& b) {
  if (!IsSame(a.robot, b.robot) || a.obstacles.size() != b.obstacles.size() ||
      a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max) {
    return false;
  }
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    if (a.obstacles[i].id != b.obstacles[i].id ||
        !IsSame(a.obstacles[i].mesh, b.obstacles[i].mesh)) {
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
