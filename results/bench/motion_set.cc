// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/motion_set.h"

#include <algorithm>

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
__extension__ using Wide = __int128;

constexpr std::int64_t kStepsPerUnit = std::int64_t{1} << kMotionGridBits;

// Sebastiano Vigna's SplitMix64 (public domain).
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t state) : state_(state) {}
  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  // In [min, max]; the bias is below 2⁻³⁰ for the ranges used.
  std::int64_t In(std::int64_t min, std::int64_t max) {
    const auto count = static_cast<std::uint64_t>(max - min + 1);
    return min + static_cast<std::int64_t>(Next() % count);
  }
  GridVector VectorIn(std::int64_t min, std::int64_t max) {
    GridVector v;
    for (int k = 0; k < 3; ++k) v[k] = In(min, max);
    return v;
  }

 private:
  std::uint64_t state_;
};

GridVector NonZero(std::int64_t most, SplitMix* random) {
  GridVector v = GridVector::Zero();
  while (v.isZero()) v = random->VectorIn(-most, most);
  return v;
}

// Ends on both sides of p, in half units; every third one starts at p.
void Through(const GridVector& p, SplitMix* random, GridMotion* motion) {
  const GridVector d = NonZero(3, random) * (kStepsPerUnit / 2);
  motion->a = p - d * (random->In(0, 2) == 0 ? 0 : random->In(1, 12));
  motion->b = p + d * random->In(0, 12);
}

GridVector Steps(const Vector3d& v) {
  return GridVector(v.cast<std::int64_t>() * kStepsPerUnit);
}

void Anywhere(const TriangleMesh& mesh, SplitMix* random, GridMotion* motion) {
  const BoundingBox box = ComputeBounds(mesh);
  const GridVector low = Steps(box.min), span = Steps(box.max) - low;
  for (GridVector* end : {&motion->a, &motion->b}) {
    for (int k = 0; k < 3; ++k) {
      (*end)[k] = low[k] + random->In(-span[k] / 4, span[k] + span[k] / 4);
    }
  }
}

void OnLattice(const GridVector& p0, SplitMix* random, GridMotion* motion) {
  const GridVector d = NonZero(1, random) * kStepsPerUnit;
  const GridVector move = random->VectorIn(-6, 6) * kStepsPerUnit;
  motion->a = p0;
  // Some coordinates stay those of a vertex.
  for (int k = 0; k < 3; ++k) {
    if (random->In(0, 1) == 0) motion->a[k] += move[k];
  }
  motion->b = motion->a + d * random->In(0, 24);
}

}  // namespace

std::string Name(MotionClass kind) {
  switch (kind) {
    case MotionClass::kRandom:
      return "random";
    case MotionClass::kLattice:
      return "lattice";
    case MotionClass::kGrazing:
      return "grazing";
    case MotionClass::kThroughEdge:
      return "through an edge";
    case MotionClass::kThroughVertex:
      return "through a vertex";
    case MotionClass::kNearMiss:
      return "near miss";
  }
  return "";
}

GridMotion MakeMotion(const std::vector<MotionScene>& scenes,
                      std::uint64_t seed, std::uint64_t index) {
  SplitMix random(SplitMix(seed).Next() ^ (index * 0xd1342543de82ef95U));
  GridMotion motion;
  motion.kind = static_cast<MotionClass>(index % kMotionClasses);
  const std::uint64_t scene = index / kMotionClasses % scenes.size();
  motion.scene = static_cast<int>(scene);
  const TriangleMesh& mesh = scenes[scene].contact;
  const auto size = static_cast<std::int64_t>(mesh.triangles.size());
  const Triangle& t =
      mesh.triangles[static_cast<std::size_t>(random.In(0, size - 1))];
  const GridVector p0 = Steps(mesh.vertices[t[0]]);
  const GridVector e1 = Steps(mesh.vertices[t[1]]) - p0;
  const GridVector e2 = Steps(mesh.vertices[t[2]]) - p0;

  MotionClass kind = motion.kind;
  if (kind == MotionClass::kNearMiss) {
    kind = static_cast<MotionClass>(
        random.In(static_cast<int>(MotionClass::kGrazing),
                  static_cast<int>(MotionClass::kThroughVertex)));
  }
  switch (kind) {
    case MotionClass::kRandom:
      Anywhere(mesh, &random, &motion);
      break;
    case MotionClass::kLattice:
      OnLattice(p0, &random, &motion);
      break;
    case MotionClass::kGrazing:
      for (GridVector* end : {&motion.a, &motion.b}) {
        *end = p0 + e1 * random.In(-4, 12) / 8;
        *end += e2 * random.In(-4, 12) / 8;
      }
      break;
    case MotionClass::kThroughEdge:
      Through(p0 + e1 * random.In(0, 8) / 8, &random, &motion);
      break;
    default:
      Through(p0, &random, &motion);
  }
  if (motion.kind == MotionClass::kNearMiss) {
    const int axis = static_cast<int>(random.In(0, 2));
    const std::int64_t step = random.In(0, 1) == 0 ? 1 : -1;
    motion.a[axis] += step;
    motion.b[axis] += step;
  }
  return motion;
}

bool Meets(const MotionScene& scene, const GridVector& a, const GridVector& b) {
  // The part of the segment inside the half-spaces so far is [enter, leave],
  // fractions of positive denominators.
  struct Fraction {
    Wide over = 0, under = 1;
    bool operator<(const Fraction& other) const {
      return over * other.under < other.over * under;
    }
  };
  return std::any_of(
      scene.pieces.begin(), scene.pieces.end(), [&](const Polyhedron& piece) {
        Fraction enter{0, 1}, leave{1, 1};
        for (const HalfSpace& half : piece) {
          const Wide above_a = half.normal.dot(a) - half.level * kStepsPerUnit;
          const Wide above_b = half.normal.dot(b) - half.level * kStepsPerUnit;
          if (above_a > 0 && above_b > 0) return false;
          if (above_a > 0) {
            enter = std::max(enter, Fraction{above_a, above_a - above_b});
          } else if (above_b > 0) {
            leave = std::min(leave, Fraction{-above_a, above_b - above_a});
          }
          if (leave < enter) return false;
        }
        return true;
      });
}

void StreamHash::Add(std::int64_t number) {
  auto bits = static_cast<std::uint64_t>(number);
  for (int i = 0; i < 8; ++i, bits >>= 8U) {
    value_ = (value_ ^ (bits & 0xffU)) * 0x100000001b3U;
  }
}

void StreamHash::Add(const GridMotion& motion, bool meets) {
  Add(motion.scene);
  Add(static_cast<std::int64_t>(motion.kind));
  for (const GridVector* end : {&motion.a, &motion.b}) {
    for (int k = 0; k < 3; ++k) Add((*end)[k]);
  }
  Add(std::int64_t{meets});
}

}  // namespace phongpd::bench
