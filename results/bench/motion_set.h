// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// A public set of straight motions with rational ground truth: "motion set
// v3".  The set is a stream, defined by this code, a seed and a length; the
// hash of the stream says whether two people have the same one.  Version 3
// since contact spaces, whose features motions graze, are ordered by their
// points.
//
// A motion a → b is blocked iff the closed segment shares a point with the
// closed set C_obj = B ⊕ (−A): touching counts as meeting.  C_obj is a union
// of convex polyhedra with integer half-spaces; the ends of a motion are
// multiples of 2⁻²⁰.  The truth clips the segment by each polyhedron in
// rational numbers (128-bit integers): no mesh, no predicate of the library,
// no rounding.
namespace phongpd::bench {

inline constexpr int kMotionSetVersion = 3;
inline constexpr int kMotionGridBits = 20;  // a unit of length is 2²⁰ steps

using GridVector = Eigen::Matrix<std::int64_t, 3, 1>;

// normal · x ≤ level for all half-spaces; x in units, not steps.
struct HalfSpace {
  GridVector normal;
  std::int64_t level = 0;
};
using Polyhedron = std::vector<HalfSpace>;

struct MotionScene {
  std::string name;
  TriangleMesh robot, obstacle;    // integer coordinates
  std::vector<Polyhedron> pieces;  // C_obj is their union
  TriangleMesh contact;            // ∂C_obj, integer coordinates
};

// The twenty scenes: voxel worlds (exact fits among them), the same under
// unimodular integer matrices, convex bodies, needles, a cavity.  Throws
// std::logic_error if a contact space has a vertex that is no integer point.
std::vector<MotionScene> MotionScenes();

enum class MotionClass {
  kRandom,         // ends anywhere on the grid of steps
  kLattice,        // along an axis or a diagonal, through coordinates of
                   // vertices: in planes of faces, along edges
  kGrazing,        // in the plane of a face, ends at eighths of its edges
  kThroughEdge,    // through or from a point of an edge
  kThroughVertex,  // through or from a vertex
  kNearMiss,       // one of the last three, moved by one step along an axis
};
inline constexpr int kMotionClasses = 6;
std::string Name(MotionClass kind);

struct GridMotion {
  int scene = 0;
  MotionClass kind = MotionClass::kRandom;
  GridVector a = GridVector::Zero(), b = GridVector::Zero();  // in steps

  Eigen::Vector3d From() const { return ToPoint(a); }
  Eigen::Vector3d To() const { return ToPoint(b); }

 private:
  static Eigen::Vector3d ToPoint(const GridVector& p) {
    return p.cast<double>() / static_cast<double>(1 << kMotionGridBits);
  }
};

// The motion of that number: each is drawn from a generator of its own
// (SplitMix64 of seed and index), so any part of the stream can be made alone.
GridMotion MakeMotion(const std::vector<MotionScene>& scenes,
                      std::uint64_t seed, std::uint64_t index);

// The truth.
bool Meets(const MotionScene& scene, const GridVector& a, const GridVector& b);

// FNV-1a over scene, class, ends and truth of every motion, each number as
// eight bytes, least first.
class StreamHash {
 public:
  void Add(const GridMotion& motion, bool meets);
  std::uint64_t value() const { return value_; }

 private:
  void Add(std::int64_t number);
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace phongpd::bench
