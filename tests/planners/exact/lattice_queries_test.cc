// SPDX-License-Identifier: GPL-3.0-or-later
// Round numbers: every query whose start, goal and rays lie in planes, edges
// and corners of C_cont.  Truth: flood fill of the lattice, and rational
// arithmetic on its boxes.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/contact/convolution_model.h"
#include "planners/exact/contact_roadmap.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/free_neighbors.h"
#include "planners/exact/path_lift.h"
#include "planners/exact/surface_graph.h"
#include "planners/world/workspace.h"
#include "problems/scenes/scene.h"
#include "tests/support/campaign.h"
#include "tests/support/flood_truth.h"
#include "tests/support/lattice_world.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::CampaignCases;
using testing::LatticeWorld;

constexpr std::uint64_t kSeed = 20;

struct Query {
  Vector3d start, goal;
  PathStatus truth;
};

// Mostly free ones; one in sixteen wherever it falls.
Query RandomQuery(const LatticeWorld& world, std::mt19937_64* random) {
  const auto pick = [&](bool free) {
    LatticeWorld::Cell cell = world.RandomCell(random);
    while (free && world.Label(cell) < 0) cell = world.RandomCell(random);
    return cell;
  };
  const LatticeWorld::Cell start = pick((*random)() % 16 > 0);
  const LatticeWorld::Cell goal = pick((*random)() % 16 > 0);
  return {world.Point(start), world.Point(goal),
          testing::FloodTruth(world.Label(start), world.Label(goal))};
}

struct QueryTally {
  long queries = 0, solved = 0, proved = 0, invalid = 0;
  long failures = 0, deleted = 0, confirmed = 0;
};

// Judges an answer, in rational arithmetic too if `confirm`.
void Judge(const LatticeWorld& world, const FreeSpace& space, const Query& pair,
           const PlanResult& result, bool confirm, QueryTally* tally) {
  ++tally->queries;
  tally->solved += result.status == PathStatus::kSolved;
  tally->proved += result.status == PathStatus::kInfeasibleProved;
  tally->invalid += result.status == PathStatus::kStartInCollision ||
                    result.status == PathStatus::kGoalInCollision;
  tally->deleted += result.deleted_edges > 0;
  bool right = result.status == pair.truth;
  if (result.status == PathStatus::kSolved) {
    right = right && CheckPath(space, result.path).free &&
            result.path.front() == pair.start &&
            result.path.back() == pair.goal;
    if (confirm) right = right && world.IsFree(result.path);
    tally->confirmed += confirm;
  }
  if (right) return;
  if (++tally->failures > 10) return;
  ADD_FAILURE() << world.name << " from " << pair.start.transpose() << " to "
                << pair.goal.transpose() << ": " << ToString(result.status)
                << " instead of " << ToString(pair.truth) << " "
                << result.reason;
}

template <typename Answer>
void Report(const char* item, const QueryTally& tally, const Answer& subject) {
  testing::CampaignRow row;
  row.item = item;
  row.subject = subject;
  row.cases = tally.queries;
  row.failures = tally.failures;
  row.seed = kSeed;
  testing::ReportCampaign(row);
}

// Calls ask(world, space, planner) for as many worlds of all families.
template <typename Ask>
void ForEachWorld(long worlds, const ContactSurfaceOptions& options,
                  const Ask& ask) {
  for (long i = 0; i < worlds; ++i) {
    std::mt19937_64 random(kSeed + static_cast<std::uint64_t>(i));
    const auto family =
        static_cast<LatticeWorld::Family>(i % LatticeWorld::kFamilies);
    const LatticeWorld world = testing::MakeLatticeWorld(
        family, i / LatticeWorld::kFamilies % 2 == 1, &random);
    const auto planner = std::make_shared<const ContactSurfacePlanner>(
        TakeAsContactSpace(world.contact_space), options);
    ask(world, FreeSpace({TakeAsContactSpace(world.contact_space)}), planner,
        &random);
  }
}

TEST(LatticeCampaign, AnswersEveryQueryRight) {
  QueryTally tally;
  ForEachWorld(CampaignCases(40, 200), testing::LeastSettings(),
               [&](const LatticeWorld& world, const FreeSpace& space,
                   const auto& planner, std::mt19937_64* random) {
                 const long queries = CampaignCases(120, 5000);
                 for (long k = 0; k < queries; ++k) {
                   const Query pair = RandomQuery(world, random);
                   Judge(world, space, pair,
                         planner->Plan(pair.start, pair.goal), k % 20 == 0,
                         &tally);
                 }
               });
  EXPECT_EQ(tally.failures, 0);
  // Hardly a route has a segment that nothing frees; another is found then.
  EXPECT_LT(tally.deleted, 1 + tally.queries / 1000);
  EXPECT_GT(tally.solved, tally.queries / 2);
  EXPECT_GT(tally.proved, tally.queries / 100);
  EXPECT_GT(tally.invalid, tally.queries / 100);
  EXPECT_GT(tally.confirmed, tally.queries / 100);
  Report("lattice", tally, "least settings");
}

TEST(LatticeCampaign, AnswersByDefaultOptionsAndByRoadmap) {
  QueryTally by_default, by_roadmap;
  ForEachWorld(CampaignCases(20, 200), {},
               [&](const LatticeWorld& world, const FreeSpace& space,
                   const auto& planner, std::mt19937_64* random) {
                 const ContactRoadmap roadmap(planner);
                 const long queries = CampaignCases(10, 50);
                 for (long k = 0; k < queries; ++k) {
                   const Query pair = RandomQuery(world, random);
                   Judge(world, space, pair,
                         planner->Plan(pair.start, pair.goal), true,
                         &by_default);
                   RoadmapRequest request;
                   request.shorten = k % 2 == 0;
                   Judge(world, space, pair,
                         roadmap.Plan(pair.start, pair.goal, request), true,
                         &by_roadmap);
                 }
               });
  EXPECT_EQ(by_default.failures, 0);
  EXPECT_EQ(by_roadmap.failures, 0);
  EXPECT_GT(by_default.solved, by_default.queries / 2);
  Report("lattice", by_default, "default options");
  Report("lattice", by_roadmap, "roadmap");
}

TEST(LatticeCampaign, SolvesTheQueriesThatFailed) {
  for (const char* name : {"one_box.json", "prism.json"}) {
    const Scene scene =
        ReadScene(std::string(PHONGPD_TEST_DATA) + "/faults/" + name);
    const ContactSpace contact = BuildContactSpace(
        scene.workspace.robot, MergedObstacle(scene.workspace));
    const PlanResult plan =
        ContactSurfacePlanner(contact).Plan(scene.start, scene.goal);
    EXPECT_EQ(ToString(plan.status), std::string("solved")) << name;
    EXPECT_EQ(plan.deleted_edges, 0) << name;
    EXPECT_TRUE(CheckPath(FreeSpace({contact}), plan.path).free) << name;
  }
}

// The prism of that file: no robot can be shut in, so what is free connects.
TEST(LatticeCampaign, ConnectsTheLatticeAroundAPrism) {
  const Scene scene =
      ReadScene(std::string(PHONGPD_TEST_DATA) + "/faults/prism.json");
  const TriangleMesh contact =
      BuildContactSpace(scene.workspace.robot, MergedObstacle(scene.workspace))
          .mesh();
  const ContactSurfacePlanner planner(TakeAsContactSpace(contact),
                                      testing::LeastSettings());
  const FreeSpace space({TakeAsContactSpace(contact)});
  std::mt19937_64 random(kSeed);
  const BoundingBox box = ComputeBounds(contact);
  const auto pick = [&] {
    Vector3d q;
    do {
      for (int k = 0; k < 3; ++k) {
        const int low = static_cast<int>(2.0 * box.min[k]) - 4;
        const int high = static_cast<int>(2.0 * box.max[k]) + 4;
        q[k] = 0.5 * (low + static_cast<int>(
                                random() % static_cast<unsigned>(high - low)));
      }
    } while (!space.IsFree(q));
    return q;
  };
  QueryTally tally;
  for (long i = CampaignCases(100, 10000); i > 0; --i) {
    const Vector3d start = pick(), goal = pick();
    const PlanResult result = planner.Plan(start, goal);
    ++tally.queries;
    if (result.status == PathStatus::kSolved &&
        CheckPath(space, result.path).free) {
      continue;
    }
    ++tally.failures;
    EXPECT_LT(tally.failures, 5) << start.transpose() << " to "
                                 << goal.transpose() << " " << result.reason;
  }
  EXPECT_EQ(tally.failures, 0);
  Report("lattice", tally, "prism");
}

// The lemma of planners/README.md, on every triangle of every world: all its
// sites see each other when they are lifted little enough.
TEST(PathLift, FreesEverySegmentBetweenSitesOfATriangle) {
  int segments_lifted = 0, blocked = 0;
  ForEachWorld(
      20, testing::LeastSettings(),
      [&](const LatticeWorld& world, const FreeSpace&, const auto& planner,
          std::mt19937_64*) {
        const TriangleMesh& mesh = world.contact_space;
        const TriangleBvh segments(mesh);
        const FreeCells& cells = planner->cells();
        const SurfaceGraph graph(mesh, FreeNeighbors(mesh), segments, cells,
                                 0.2 * ComputeBounds(mesh).Diagonal(), 100);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
          std::vector<SurfaceSite> sites;
          graph.ForEachOn(static_cast<int>(t),
                          [&](int i) { sites.push_back(graph.sites()[i]); });
          for (std::size_t i = 1; i < sites.size(); ++i) {
            std::vector<Vector3d> path;
            LiftCounts counts;
            const bool free = LiftRoute({sites[i - 1], sites[i]}, segments, 1.0,
                                        cells.rounding(), &path, &counts)
                                  .empty();
            ++segments_lifted;
            blocked += !free;
            if (!free && blocked < 5) {
              ADD_FAILURE()
                  << world.name << ": " << sites[i - 1].point.transpose()
                  << " along " << sites[i - 1].direction.transpose() << " and "
                  << sites[i].point.transpose() << " along "
                  << sites[i].direction.transpose();
            }
          }
        }
      });
  EXPECT_GT(segments_lifted, 4000);
  EXPECT_EQ(blocked, 0);
}

// What is asked of the model that queries are built from.
TEST(ConvolutionModel, AgreesWithRationalArithmeticOnLatticeWorlds) {
  std::mt19937_64 random(6);
  int free = 0, blocked = 0;
  for (int i = 0; i < 40; ++i) {
    const auto family =
        static_cast<LatticeWorld::Family>(i % LatticeWorld::kFamilies);
    const LatticeWorld world =
        testing::MakeLatticeWorld(family, i % 2 == 1, &random);
    SCOPED_TRACE(world.name);
    const auto mapped = [&](TriangleMesh mesh) {
      for (Vector3d& v : mesh.vertices) v = world.map.cast<double>() * v;
      return mesh;
    };
    const FreeSpace found = FreeSpace::OfConvolutions(
        {ConvolutionModel(mapped(world.workspace.robot),
                          mapped(MergedObstacle(world.workspace)))});
    for (int k = 0; k < 200; ++k) {
      const Vector3d a = world.Point(world.RandomCell(&random));
      const Vector3d b = world.Point(world.RandomCell(&random));
      const bool is_free = world.IsFree({a, b});
      ASSERT_EQ(found.IsFree(a, b), is_free)
          << a.transpose() << " to " << b.transpose();
      (is_free ? free : blocked) += 1;
    }
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(blocked, 1000);
}

}  // namespace
}  // namespace phongpd
