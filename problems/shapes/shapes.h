// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Procedural solids.  Every function returns a closed, outward,
// edge-manifold mesh without self-intersections and throws InputError for
// parameters that cannot give one: one line that names the shape and the
// parameter, what it must be and what it was.  Lengths are in the caller's
// unit, in [1e-70, 1e70]; counts of points on a curve are at most 10 000,
// triangles at most 10⁷.  Same arguments, same bytes.  Circles start on +x and
// hit the axes exactly.
namespace phongpd {

// Ball of radius r: icosahedron subdivided `levels` times, 20·4^levels
// triangles, vertices on the sphere; levels in [0, 9].
TriangleMesh MakeIcoBall(double radius, int levels);

// Ball of radius r with `meridians` × `parallels` quads: UV sphere,
// 2·meridians·(parallels − 1) triangles (24 × 22 gives the paper's ≈ 1K:
// 1008).
TriangleMesh MakeUvBall(double radius, int meridians, int parallels);

// Cone with its base disc in z = 0 and its apex at z = height:
// 2·sides − 2 triangles (40 sides: the paper's 78).
TriangleMesh MakeCone(double radius, double height, int sides);

// Axis-aligned box between two corners, min < max; 12 triangles, coordinates
// exactly the given ones.
TriangleMesh MakeBox(const Eigen::Vector3d& min, const Eigen::Vector3d& max);

// Union of the three axis-aligned bars [−half_length, half_length] ×
// [−half_width, half_width]², as one solid (60 triangles).
TriangleMesh MakeAxes(double half_length, double half_width);

// Flat open-ended wrench in the xy plane with a round hole at its −x end and
// a jaw open towards +x, 7.07 × 2.4 × 0.5 for scale 1, origin half way
// between the centres of hole and jaw.  The four numbers count the points on
// the hole (at least 3), the ring (6), each jaw side (4) and the throat (3);
// 4·(hole + ring + 2·jaw + throat) triangles: the default gives the paper's
// 772.
TriangleMesh MakeWrench(double scale = 1.0, int hole = 48, int ring = 45,
                        int jaw = 35, int throat = 30);

// Torus around the z axis, minor radius < major radius, 2·around·across
// triangles.
TriangleMesh MakeTorus(double major_radius, double minor_radius, int around,
                       int across);

// L-shaped prism in [0, size]² × [0, height] with legs of the given width
// along the x and y axes, 20 triangles.
TriangleMesh MakeL(double size, double width, double height);

// U-shaped trap in [0, size]² × [0, height]: walls of the given thickness
// along three sides, open towards +x and ±z; 28 triangles.
TriangleMesh MakeU(double size, double wall, double height);

// Square plate [−side/2, side/2]² × [−thickness/2, thickness/2] with a
// centred square hole of side `hole` through it along z, 32 triangles.
TriangleMesh MakePlateWithHole(double side, double thickness, double hole);

// As above with a hole over the regular polygon of `sides` corners inscribed
// in the circle of that radius, 4·sides + 16 triangles.
TriangleMesh MakePlateWithRoundHole(double side, double thickness,
                                    double radius, int sides);

// Prism over a regular polygon of `sides` corners around the z axis,
// z in [−height/2, height/2]: pegs and discs.  4·sides − 4 triangles.
TriangleMesh MakePrism(double radius, double height, int sides);

// Hollow box: outer cube, inner cubic cavity, both centred (24 triangles in
// two components, the inner one facing the cavity).  With `window` > 0 a
// centred square opening of that side goes through the +z wall and the solid
// is one component of 412 triangles.
TriangleMesh MakeVessel(double outer, double inner, double window);

// A box-shaped cavity between two corners, min < max, in a box with walls of
// the given thickness: 24 triangles in two components.
TriangleMesh MakeBoxShell(const Eigen::Vector3d& min,
                          const Eigen::Vector3d& max, double thickness);

// The cells of a grid that are solid: cuts ascending, layers[k][j][i] = '#' for
// solid, '.' for empty, between the cuts i and i + 1 of x, j and j + 1 of y, k
// and k + 1 of z.  Every flat face is triangulated as one polygon.  Closed and
// outward, but edge-manifold only where no two cells meet in an edge alone.
TriangleMesh MakeCells(const std::vector<double>& x,
                       const std::vector<double>& y,
                       const std::vector<double>& z,
                       const std::vector<std::vector<std::string>>& layers);

// Icosahedron of vertex radius r0 with a pyramid of tip radius r1 on every
// face, 60 triangles; r1 > r0 gives a spiky non-convex star.
TriangleMesh MakeStar(double inner_radius, double outer_radius);

// An organic body without symmetry: MakeIcoBall(radius, levels) with every
// vertex moved along its ray by a factor between 1 − roughness and
// 1 + roughness, a sum of smooth waves in random directions (2 to 6 radians a
// radius, hence bumps and dents).  Star-shaped, so never self-intersecting;
// roughness in [0, 1).
TriangleMesh MakeBlob(double radius, int levels, double roughness,
                      std::uint64_t seed);

// A solid as a scanner sees it: edges longer than `edge` are halved until none
// is, then every coordinate of every vertex moves by at most `noise`, below a
// tenth of `edge`; 0: no noise.  No coplanar faces are left to merge, so its
// contact spaces are as finely tessellated as it is.  Noise far below the
// thickness of its walls keeps it embedded.
TriangleMesh MakeScan(TriangleMesh solid, double edge, double noise,
                      std::uint64_t seed);

// Tube of radius `tube` < size/2 along the trefoil knot
// size · (sin t + 2 sin 2t, cos t − 2 cos 2t, −sin 3t),
// 2·around·across triangles, around ≥ 32.
TriangleMesh MakeKnot(double size, double tube, int around, int across);

// Tube along a polyline with flat ends.  Each part is a prism over the regular
// polygon of `sides` corners inscribed in the circle of that radius, cut off
// at the mitres; the first corner of the first part lies towards `up`, and is
// carried along without twist.  Bends are below 90 degrees, and parts longer
// than the mitres at their ends, radius · tan(bend / 2) each; that parts which
// are no neighbours keep apart is the caller's to see to (MakeSolid tells).
// 2·sides·points − 4 triangles.
TriangleMesh MakeTube(const std::vector<Eigen::Vector3d>& path, double radius,
                      int sides,
                      const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

// Rotation by no special angle (0.7 rad about z, 0.9 about y, 0.4 about x),
// for meshes that must not be axis-aligned.
Eigen::Matrix3d GenericRotation();

}  // namespace phongpd
