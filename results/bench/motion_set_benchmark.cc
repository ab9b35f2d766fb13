// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the public set of straight motions with rational truth
// (motion_set.h): the exact judge of this library beside FCL's continuous
// collision and OMPL's discrete motion validator.  Writes motion_set.csv,
// motion_set.md and a sample of the stream.
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <array>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "constraints/free_space.h"
#include "constraints/oracle/fcl_surfaces.h"
#include "core/stopwatch.h"
#include "planners/ompl/ompl_planning.h"
#include "results/bench/motion_set.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

namespace ob = ::ompl::base;
using Eigen::Vector3d;

// OMPL's validator on one scene, with exact answers for single states.
class OmplMotions {
 public:
  OmplMotions(const FreeSpace& free, const BoundingBox& box, double resolution)
      : space_(std::make_shared<ob::RealVectorStateSpace>(3)) {
    ob::RealVectorBounds bounds(3);
    for (unsigned k = 0; k < 3; ++k) {
      bounds.setLow(k, box.min[k]);
      bounds.setHigh(k, box.max[k]);
    }
    space_->setBounds(bounds);
    si_ = std::make_shared<ob::SpaceInformation>(space_);
    si_->setStateValidityChecker([&free](const ob::State* state) {
      return free.IsFree(ToPoint(state));
    });
    si_->setStateValidityCheckingResolution(resolution);
    si_->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(si_));
    si_->setup();
    a_ = si_->allocState();
    b_ = si_->allocState();
  }
  ~OmplMotions() {
    si_->freeState(a_);
    si_->freeState(b_);
  }
  OmplMotions(const OmplMotions&) = delete;
  OmplMotions& operator=(const OmplMotions&) = delete;

  bool Collides(const Vector3d& a, const Vector3d& b) const {
    Set(a, a_);
    Set(b, b_);
    return !si_->checkMotion(a_, b_);
  }

 private:
  static Vector3d ToPoint(const ob::State* state) {
    const double* values =
        state->as<ob::RealVectorStateSpace::StateType>()->values;
    return {values[0], values[1], values[2]};
  }
  static void Set(const Vector3d& q, ob::State* state) {
    double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (int k = 0; k < 3; ++k) values[k] = q[k];
  }

  std::shared_ptr<ob::RealVectorStateSpace> space_;
  ob::SpaceInformationPtr si_;
  ob::State* a_ = nullptr;
  ob::State* b_ = nullptr;
};

struct Scene {
  Scene(const MotionScene& scene, const std::vector<double>& resolutions)
      : free({TakeAsContactSpace(scene.contact)}),
        fcl(scene.robot, scene.obstacle) {
    BoundingBox box = ComputeBounds(scene.contact);
    const Vector3d margin = (box.max - box.min) / 4.0;
    box.min -= margin;
    box.max += margin;
    for (const double resolution : resolutions) {
      ompl.push_back(std::make_unique<OmplMotions>(free, box, resolution));
    }
  }

  FreeSpace free;
  FclSurfaces fcl;
  std::vector<std::unique_ptr<OmplMotions>> ompl;
};

struct Judge {
  std::string name;
  std::uint64_t every = 1;  // asked about every so manieth motion
  bool needs_free_start = true;
  std::function<bool(const Scene&, const Vector3d&, const Vector3d&)> collides;
};

struct Count {
  long motions = 0, meet = 0, blocked_wrongly = 0, freed_wrongly = 0;
  double seconds = 0.0;
};

std::string SampleRow(const GridMotion& motion, const MotionScene& scene,
                      bool meets) {
  std::ostringstream row;
  row << scene.name << ',' << Name(motion.kind);
  for (const GridVector* end : {&motion.a, &motion.b}) {
    for (int k = 0; k < 3; ++k) row << ',' << (*end)[k];
  }
  row << ',' << (meets ? 1 : 0) << '\n';
  return row.str();
}

std::string Description(long motions, std::uint64_t seed, std::uint64_t hash,
                        const std::vector<MotionScene>& scenes) {
  std::ostringstream text;
  text << "# Motion set v" << kMotionSetVersion << "\n\n"
       << motions << " straight motions of a translating robot in "
       << scenes.size() << " scenes, seed " << seed << ", hash `" << std::hex
       << std::setw(16) << std::setfill('0') << hash << std::dec
       << "` (FNV-1a over scene, class, ends and truth).  The stream is "
          "defined by `results/bench/motion_set.h`; `build/motion_set "
          "--stream FILE` writes all of it, "
          "[motion_set_sample.csv](motion_set_sample.csv) holds the beginning. "
          "Ends are in steps of 2⁻²⁰.\n\n"
          "A motion is blocked iff the closed segment shares a point with the "
          "closed set B ⊕ (−A): **touching counts as meeting**. That set is a "
          "union of convex polyhedra with integer half-spaces, and the truth "
          "clips the segment by them in rational numbers; no mesh and no "
          "predicate of the library takes part.\n\n"
          "- *ours*: `FreeSpace::IsFree` on the contact space, all motions.\n"
          "- *FCL*: `continuousCollide` of the original meshes (OBBRSS trees), "
          "conservative advancement with its default tolerance 1e-4, and FCL's "
          "default solver (ten placements).\n"
          "- *OMPL*: `DiscreteMotionValidator` with exact answers for single "
          "states, at resolutions of the space's extent (1.5 × the contact "
          "space).\n\n"
          "FCL and OMPL expect a free start: motions are turned round where "
          "only the goal is free, and left out where neither is. What is "
          "slow is asked about a part of the stream (column motions).\n\n"
          "| scene | robot | obstacle | contact space, triangles | polyhedra "
          "|\n|---|---:|---:|---:|---:|\n";
  for (const MotionScene& scene : scenes) {
    text << "| " << scene.name << " | " << scene.robot.triangles.size() << " | "
         << scene.obstacle.triangles.size() << " | "
         << scene.contact.triangles.size() << " | " << scene.pieces.size()
         << " |\n";
  }
  return text.str();
}

std::vector<Judge> Judges(const std::vector<double>& resolutions) {
  using Solver = FclSurfaces::Solver;
  std::vector<Judge> judges = {
      {"ours", 1, false,
       [](const Scene& s, const Vector3d& a, const Vector3d& b) {
         return !s.free.IsFree(a, b);
       }},
      {"FCL conservative advancement", 101, true,
       [](const Scene& s, const Vector3d& a, const Vector3d& b) {
         return s.fcl.Meet(a, b, Solver::kConservativeAdvancement);
       }},
      {"FCL default", 101, true,
       [](const Scene& s, const Vector3d& a, const Vector3d& b) {
         return s.fcl.Meet(a, b, Solver::kPlacements);
       }}};
  for (std::size_t i = 0; i < resolutions.size(); ++i) {
    constexpr std::array<std::uint64_t, 3> kEvery = {7, 11, 101};
    judges.push_back(
        {"OMPL at " + Rounded(resolutions[i]), kEvery[i], true,
         [i](const Scene& s, const Vector3d& a, const Vector3d& b) {
           return s.ompl[i]->Collides(a, b);
         }});
  }
  return judges;
}

using Counts = std::vector<std::array<Count, kMotionClasses>>;

// The motion or its reverse, whichever starts free.
std::optional<std::array<Vector3d, 2>> FromFreeEnd(const MotionScene& source,
                                                   const GridMotion& motion) {
  if (!Meets(source, motion.a, motion.a)) return {{motion.From(), motion.To()}};
  if (!Meets(source, motion.b, motion.b)) return {{motion.To(), motion.From()}};
  return std::nullopt;
}

void AskJudges(const std::vector<Judge>& judges, const Scene& scene,
               const MotionScene& source, const GridMotion& motion,
               std::uint64_t index, bool meets, Counts* counts) {
  const auto turned = FromFreeEnd(source, motion);
  for (std::size_t j = 0; j < judges.size(); ++j) {
    const Judge& judge = judges[j];
    // Primes, so that every class and scene is met.
    if (index % judge.every != 0) continue;
    if (judge.needs_free_start && !turned) continue;
    const Vector3d a = judge.needs_free_start ? (*turned)[0] : motion.From();
    const Vector3d b = judge.needs_free_start ? (*turned)[1] : motion.To();
    Count& count = (*counts)[j][static_cast<std::size_t>(motion.kind)];
    const Stopwatch watch;
    const bool collides = judge.collides(scene, a, b);
    count.seconds += watch.Seconds();
    ++count.motions;
    count.meet += meets ? 1 : 0;
    count.blocked_wrongly += collides && !meets ? 1 : 0;
    count.freed_wrongly += meets && !collides ? 1 : 0;
  }
}

// *wrong: what ours got wrong.
Table TableOf(const std::vector<Judge>& judges, const Counts& counts,
              long* wrong) {
  Table table{"Motion checks",
              "",
              {"class", "judge", "motions", "meet", "blocked wrongly",
               "freed wrongly", "µs a motion"},
              {}};
  for (std::size_t c = 0; c < kMotionClasses; ++c) {
    for (std::size_t j = 0; j < judges.size(); ++j) {
      const Count& count = counts[j][c];
      if (j == 0) *wrong += count.blocked_wrongly + count.freed_wrongly;
      table.rows.push_back(
          {Name(static_cast<MotionClass>(c)), judges[j].name,
           std::to_string(count.motions), std::to_string(count.meet),
           std::to_string(count.blocked_wrongly),
           std::to_string(count.freed_wrongly),
           Rounded(count.seconds * 1e6 /
                   static_cast<double>(std::max(1L, count.motions)))});
    }
  }
  return table;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("Exact motion checks against rational truth.");
  std::string stream_file;
  long motions = 1000000;
  std::uint64_t seed = 1;
  app.get_option("--output")->required(false);
  app.add_option("--stream", stream_file, "Write the whole stream as CSV");
  app.add_option("--motions", motions)->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  program->Parse();
  SilenceOmpl();

  const std::vector<MotionScene> sources = MotionScenes();
  const std::vector<double> resolutions = {1e-2, 1e-3, 1e-4};
  std::vector<std::unique_ptr<Scene>> scenes;
  for (const MotionScene& source : sources) {
    scenes.push_back(std::make_unique<Scene>(source, resolutions));
  }
  const std::vector<Judge> judges = Judges(resolutions);
  constexpr char kHeader[] = "scene,class,ax,ay,az,bx,by,bz,blocked\n";
  constexpr long kSample = 2000;
  std::string sample = kHeader;
  std::ofstream stream;
  if (!stream_file.empty()) {
    stream.open(stream_file);
    stream << kHeader;
  }
  StreamHash hash;
  Counts counts(judges.size());
  for (long i = 0; i < motions; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const GridMotion motion = MakeMotion(sources, seed, index);
    const auto at = static_cast<std::size_t>(motion.scene);
    const MotionScene& source = sources[at];
    const bool meets = Meets(source, motion.a, motion.b);
    hash.Add(motion, meets);
    if (i < kSample) sample += SampleRow(motion, source, meets);
    if (stream.is_open()) stream << SampleRow(motion, source, meets);
    if (!program->writes()) continue;
    AskJudges(judges, *scenes[at], source, motion, index, meets, &counts);
  }
  std::cout << "motion set v" << kMotionSetVersion << ", seed " << seed << ", "
            << motions << " motions, hash " << std::hex << hash.value()
            << std::dec << '\n';
  if (!program->writes()) return 0;

  long wrong = 0;
  const Table table = TableOf(judges, counts, &wrong);
  program->Write("motion_set.csv", ToCsv(table));
  program->Write("motion_set_sample.csv", sample);
  program->Write("motion_set.md",
                 Description(motions, seed, hash.value(), sources) + '\n' +
                     program->Circumstances(seed) + '\n');
  program->Commit();
  std::cout << ToText(table);
  return wrong == 0 ? 0 : 1;
}

}  // namespace phongpd::bench
