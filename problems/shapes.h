// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

// Procedural solids.  Every function returns a closed, outward,
// edge-manifold mesh without self-intersections and throws InputError for
// parameters that cannot give one.  Lengths in the caller's unit.
namespace phongpd {

// Ball of radius r: icosahedron subdivided `levels` times, 20·4^levels
// triangles, vertices on the sphere.
TriangleMesh MakeIcoBall(double radius, int levels);

// Ball of radius r with `meridians` × `parallels` quads: UV sphere,
// 2·meridians·(parallels − 1) triangles (24 × 22 gives the paper's ≈ 1K:
// 1008).
TriangleMesh MakeUvBall(double radius, int meridians, int parallels);

// Cone with its base disc in z = 0 and its apex at z = height:
// 2·sides − 2 triangles (40 sides: the paper's 78).
TriangleMesh MakeCone(double radius, double height, int sides);

// Axis-aligned box between two corners, 12 triangles.
TriangleMesh MakeBox(const Eigen::Vector3d& min, const Eigen::Vector3d& max);

// Union of the three axis-aligned bars [−half_length, half_length] ×
// [−half_width, half_width]², as one solid (60 triangles).
TriangleMesh MakeAxes(double half_length, double half_width);

// Flat open-ended wrench with a round hole at one end and a jaw at the other,
// about 6 × 2.4 × 0.5 for scale 1, centred on its handle.  The four numbers
// count the points on hole, ring, each jaw side and jaw throat;
// 4·(hole + ring + 2·jaw + throat) triangles, less 4: the default gives the
// paper-sized 772.
TriangleMesh MakeWrench(double scale = 1.0, int hole = 48, int ring = 45,
                        int jaw = 35, int throat = 30);

// Torus around the z axis, 2·around·across triangles.
TriangleMesh MakeTorus(double major_radius, double minor_radius, int around,
                       int across);

// L-shaped prism in [0, size]² × [0, height] with legs of the given width.
TriangleMesh MakeL(double size, double width, double height);

// U-shaped trap: a box of outer `size` with walls of the given thickness,
// open towards +x, closed elsewhere in x/y, extruded over [0, height].
TriangleMesh MakeU(double size, double wall, double height);

// Square plate [−side/2, side/2]² × [−thickness/2, thickness/2] with a
// centred square hole.
TriangleMesh MakePlateWithHole(double side, double thickness, double hole);

// As above with a round hole of `sides` corners.
TriangleMesh MakePlateWithRoundHole(double side, double thickness,
                                    double radius, int sides);

// Prism over a regular polygon of `sides` corners around the z axis,
// z in [−height/2, height/2]: pegs and discs.
TriangleMesh MakePrism(double radius, double height, int sides);

// Hollow box: outer cube, inner cubic cavity, both centred (24 triangles in
// two components).  With `window` > 0 a centred square opening of that side
// goes through the +z wall and the solid is one component.
TriangleMesh MakeVessel(double outer, double inner, double window);

// Icosahedron of radius r0 with a pyramid of tip radius r1 on every face,
// 60 triangles; r1 > r0 gives a spiky non-convex star.
TriangleMesh MakeStar(double inner_radius, double outer_radius);

// Tube of radius `tube` along a trefoil-like knot, 2·around·across triangles.
TriangleMesh MakeKnot(double size, double tube, int around, int across);

// Both meshes as one, without touching either (components may overlap).
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b);

// Rotation by no special angle, for tests that must not be axis-aligned.
Eigen::Matrix3d GenericRotation();

}  // namespace phongpd
