// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "core/contact_space/contact_space.h"
#include "core/contact_space/patch_plane.h"

namespace phongpd::internal {

// The surface of a contact space as a mesh that can be changed inside its
// planar patches (triangles of one plane id and kind, joined by edges) without
// changing the surface: every operation either leaves each triangle turned the
// same way as its patch, decided exactly, or does nothing.
//
// Edges between patches are fixed: they can be split (in the patches on both
// sides, so the mesh stays conforming) but not flipped.  Triangles that have
// no area, or the wrong turn, after rounding to double are frozen: neither
// they nor their edges change.
//
// New vertices are rounded once, whatever the number of operations before:
// those on fixed edges from A + t (B − A) with original ends A, B and a dyadic
// t, those inside from the plane through three far-apart original vertices of
// the patch.  Each is within half an ulp per coordinate of that line or plane.
//
// Coordinates are the surface's times Scale(), a power of two that brings its
// diagonal into [1, 2): exact, and results scale bit for bit.
class PatchMesh {
 public:
  // Edge k of a triangle runs from its vertex k to its vertex k + 1 mod 3.
  struct Edge {
    int triangle = -1;
    int k = 0;
  };

  // The surface must be closed and edge-manifold.
  explicit PatchMesh(const ContactSpace& space);

  // Puts the changed mesh, plane ids and kinds in place.
  void Store(ContactSpace* space) const;

  double Scale() const { return scale_; }
  int Count() const { return static_cast<int>(triangles_.size()); }
  const Eigen::Vector3d& Point(int t, int k) const {
    return points_[triangles_[t][k % 3]];
  }
  bool IsFrozen(int t) const { return frozen_[t]; }
  bool IsFixed(Edge e) const {
    const int o = neighbors_[e.triangle][e.k];
    return patch_of_[o] != patch_of_[e.triangle] || frozen_[o] ||
           frozen_[e.triangle];
  }
  bool CanSplit(Edge e) const {
    return !frozen_[e.triangle] && !frozen_[neighbors_[e.triangle][e.k]];
  }
  // The same edge seen from the other side.
  Edge Opposite(Edge e) const;

  // Edges between patches whose normals are at least `angle` (radians) apart.
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> SharpEdges(
      double angle) const;

  const PatchPlane& Plane(int t) const { return patches_[patch_of_[t]].plane; }
  // Walks from t towards x, a point of the patch's plane.  Ends in the
  // triangle holding x: k = −1; at a fixed edge in between; or, should the
  // walk get lost, nowhere: triangle = −1.
  Edge Walk(int t, const Eigen::Vector3d& x) const;

  // Each appends the changed and new triangles to `changed`, and returns
  // false, with nothing done, where a triangle would lose its turn.
  bool SplitEdge(Edge e, std::vector<int>* changed);
  bool InsertPoint(int t, const Eigen::Vector3d& x, std::vector<int>* changed);
  // Flips edges until the patches around `changed` are Delaunay again.
  void Legalize(std::vector<int>* changed);

  // Is the apex d on the other side of ab within the circle through a, b, c?
  // Clearly: rounding errors do not count.
  static bool InCircle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c, const Eigen::Vector3d& d);

 private:
  struct Patch {
    int plane_id;
    ContactKind kind;
    PatchPlane plane;
  };
  // Where a vertex on a fixed edge lies: A + t (B − A).
  struct EdgePlace {
    int a = -1, b = -1;
    double t = 0.0;
  };

  void MakePatches(const ContactSpace& space);
  bool Turns(int patch, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             const Eigen::Vector3d& c) const;
  EdgePlace MiddleOf(int a, int b) const;
  int AddTriangle(int patch);
  void Set(int t, const std::array<int, 3>& vertices,
           const std::array<int, 3>& neighbors);
  void Relink(int t, int from, int to, int neighbor);
  bool AreJoined(Edge at, int other) const;
  bool Flip(Edge e);

  double scale_ = 1.0;
  std::vector<Eigen::Vector3d> points_;
  std::vector<EdgePlace> places_;  // of vertices added on fixed edges
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 3>> neighbors_;
  std::vector<int> patch_of_;
  std::vector<char> frozen_;
  std::vector<Patch> patches_;
};

}  // namespace phongpd::internal
