// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

class TriangleBvh;

// A segment through free space between what it leaves and what it meets first.
struct CellRay {
  enum class End {
    kSurface,    // meets another piece of surface, free all the way
    kShell,      // the piece it leaves encloses free space: no ray needed
    kOutside,    // leaves the hull of the mesh
    kUndecided,  // every line tried came within rounding of an edge
  };

  End end = End::kUndecided;
  int from_triangle = -1;  // it leaves; −1: a configuration
  int to_triangle = -1;    // it meets, from its free side
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

// The free cells around a closed surface, decided by one ray per piece.
//
// A piece is a part of the surface connected through edges.  Seen from
// infinity it is an island, free around it, or a shell, free inside it.  A
// bounded cell has exactly one shell on its boundary, the unbounded cell none,
// all others are islands.  From each island a ray along one direction d,
// generic for all of them, leaves the piece for good and meets the next piece
// of the same cell, so the chain island → island → … climbs along d until it
// ends in the shell of the cell or outside.  Where it ends *is* the cell: two
// configurations are connected by a free path iff their chains end alike.
//
// What is proved.  A ray counts only if the segment it lies on keeps
// `rounding` away from every edge and by both its ends from every triangle,
// and if the points in which it crosses triangles are further apart than they
// could move.  Hence the answer is the same for every embedded surface of the
// same connectivity whose vertices are within rounding of the mesh's: for the
// mesh itself if it is embedded, and for the exact contact space which
// BuildContactSpace rounded to doubles, even if rounding made a few slivers
// of the mesh meet.
class FreeCells {
 public:
  static constexpr int kOutside = -1;    // the unbounded cell
  static constexpr int kUndecided = -2;  // see CellRay::End

  // `mesh` closed, edge-manifold, oriented with the free side in front, finite;
  // it, its neighbours (FreeNeighbors) and `segments` must outlive this.
  FreeCells(const TriangleMesh& mesh,
            const std::vector<std::array<int, 3>>& neighbors,
            const TriangleBvh& segments);

  // Largest displacement of vertices that the answers allow for, 2⁻⁴⁶ of the
  // largest coordinate.
  double rounding() const { return rounding_; }

  int piece_count() const { return static_cast<int>(rays_.size()); }
  const std::vector<int>& piece() const { return piece_; }    // of a triangle
  const std::vector<CellRay>& rays() const { return rays_; }  // of a piece

  // The cell in front of a piece: its shell's number, kOutside or kUndecided.
  int CellOfPiece(int piece) const { return cell_[piece]; }

  // The pieces a chain runs through, the given one first.
  std::vector<int> Chain(int piece) const;

  // Does a point lie so far along the common direction of the pieces' rays
  // that nothing is there?  All such points see each other.
  bool IsAbove(const Eigen::Vector3d& p) const;

  // The cell that a free configuration lies in; the ray that tells goes to
  // *ray.
  int CellOf(const Eigen::Vector3d& q, CellRay* ray) const;

 private:
  struct Crossing {
    int triangle;
    double fraction, slack;  // of the way along the segment
  };

  bool Cast(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
            std::vector<Crossing>* crossings) const;
  CellRay RayOfPiece(const std::vector<int>& triangles,
                     const Eigen::Vector3d& direction) const;
  CellRay RayThrough(int triangle, const Eigen::Vector3d& direction) const;
  CellRay RayFrom(const Eigen::Vector3d& q,
                  const Eigen::Vector3d& direction) const;
  double Top(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d Beyond(const Eigen::Vector3d& from,
                         const Eigen::Vector3d& direction) const;
  bool CastRays(const std::vector<std::vector<int>>& triangles, int direction);
  void FollowChains();

  const TriangleMesh& mesh_;
  const TriangleBvh& segments_;
  BoundingBox bounds_;
  double rounding_ = 0.0;
  int direction_ = 0;  // common one of the pieces' rays
  std::vector<int> piece_;
  std::vector<CellRay> rays_;
  std::vector<int> cell_;
};

}  // namespace phongpd
