// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Procedural solids for examples, tests and benchmarks.  Unless it says
// otherwise, a function returns a closed, edge-manifold mesh that faces outward
// and does not intersect itself.  It throws InputError for parameters that
// cannot give one: one line with the shape, the parameter, what is expected and
// what was found.  Lengths are in the user's unit, in [1e-70, 1e70].  A curve
// has at most 10 000 points, a mesh at most 10⁷ triangles.  The same arguments
// give the same mesh, bit for bit.  Circles begin on the +x axis, and their
// points on the axes are exact.
namespace phongpd {

// Ball: an icosahedron subdivided `levels` times, in [0, 9], with its vertices
// on the sphere of that radius; 20·4^levels triangles.
TriangleMesh MakeIcoBall(double radius, int levels);

// Ball: a UV sphere of `meridians` × `parallels` faces around the z axis;
// 2·meridians·(parallels − 1) triangles (24 × 22 gives 1008, the paper's ≈ 1K).
TriangleMesh MakeUvBall(double radius, int meridians, int parallels);

// Cone with its base disc in z = 0 and its apex at z = height;
// 2·sides − 2 triangles (40 sides give the paper's 78).
TriangleMesh MakeCone(double radius, double height, int sides);

// Axis-aligned box between two corners, min < max, with exactly these
// coordinates; 12 triangles.
TriangleMesh MakeBox(const Eigen::Vector3d& min, const Eigen::Vector3d& max);

// Three bars that cross: the union of [−half_length, half_length] ×
// [−half_width, half_width]² along x and the same along y and z; 60 triangles.
TriangleMesh MakeAxes(double half_length, double half_width);

// Flat wrench in the xy plane, with a round hole at its −x end and a jaw that
// is open towards +x.  Its size is 7.07 × 2.4 × 0.5 · scale; its origin is half
// way between the centres of hole and jaw.  The numbers of points: on the hole,
// at least 3; on the ring around it, 6; on each side of the jaw, 4; on the
// throat, 3.  4·(hole + ring + 2·jaw + throat) triangles; the default gives the
// paper's 772.
TriangleMesh MakeWrench(double scale = 1.0, int hole = 48, int ring = 45,
                        int jaw = 35, int throat = 30);

// Torus around the z axis, minor radius < major radius, with `around` points
// along its circle and `across` points around its tube; 2·around·across
// triangles.
TriangleMesh MakeTorus(double major_radius, double minor_radius, int around,
                       int across);

// L-shaped prism in [0, size]² × [0, height], with legs of the given width
// along the x and y axes; 20 triangles.
TriangleMesh MakeL(double size, double width, double height);

// U-shaped trap in [0, size]² × [0, height]: three walls of thickness `wall`,
// open towards +x and ±z; 28 triangles.
TriangleMesh MakeU(double size, double wall, double height);

// Square plate [−side/2, side/2]² × [−thickness/2, thickness/2] with a square
// hole of side `hole` through its centre along z; 32 triangles.
TriangleMesh MakePlateWithHole(double side, double thickness, double hole);

// The same plate with a polygonal hole: the regular polygon with `sides`
// corners on the circle of that radius; 4·sides + 16 triangles.
TriangleMesh MakePlateWithRoundHole(double side, double thickness,
                                    double radius, int sides);

// Prism, for pegs and discs: the regular polygon with `sides` corners on the
// circle of that radius around the z axis, z in [−height/2, height/2];
// 4·sides − 4 triangles.
TriangleMesh MakePrism(double radius, double height, int sides);

// Hollow cube of side `outer` around a cubic cavity of side `inner`, both
// centred at the origin.  window = 0: the cavity is closed; 24 triangles in two
// components, the inner one facing the cavity.  window > 0: a square opening of
// that side through the middle of the +z wall; one component of 412 triangles.
TriangleMesh MakeVessel(double outer, double inner, double window);

// A box-shaped cavity between two corners, min < max, in a box with walls of
// the given thickness: 24 triangles in two components.
TriangleMesh MakeBoxShell(const Eigen::Vector3d& min,
                          const Eigen::Vector3d& max, double thickness);

// The union of the solid cells of a grid.  x, y and z are the grid's planes, in
// ascending order.  layers[k][j][i] is '#' for a solid cell, '.' for an empty
// one; the cell lies between x[i] and x[i + 1], y[j] and y[j + 1], z[k] and
// z[k + 1].  Every flat face is triangulated as one polygon.  The mesh is
// closed and faces outward; it is edge-manifold only if no two solid cells
// share just an edge.
TriangleMesh MakeCells(const std::vector<double>& x,
                       const std::vector<double>& y,
                       const std::vector<double>& z,
                       const std::vector<std::vector<std::string>>& layers);

// Star: an icosahedron with its vertices at inner_radius from the origin, and
// on every face a pyramid with its apex at outer_radius.  outer_radius >
// inner_radius gives spikes, and a mesh that is not convex; 60 triangles.
TriangleMesh MakeStar(double inner_radius, double outer_radius);

// A smooth body with bumps and dents and without symmetry: the vertices of
// MakeIcoBall(radius, levels), each multiplied by a factor between
// 1 − roughness and 1 + roughness; roughness in [0, 1).  The factor is a sum of
// waves in random directions, of 2 to 6 radians per radius.  The body is
// star-shaped, so that it never intersects itself.
TriangleMesh MakeBlob(double radius, int levels, double roughness,
                      std::uint64_t seed);

// A solid as if it had been scanned: edges longer than `edge` are halved until
// there are none, then every coordinate of every vertex moves at random by at
// most `noise`, in [0, edge/10).  Faces are then no longer coplanar, so that
// its contact spaces are as finely tessellated as the mesh itself.  The noise
// must be far below the thickness of the walls, or the mesh may intersect
// itself.
TriangleMesh MakeScan(TriangleMesh solid, double edge, double noise,
                      std::uint64_t seed);

// Knot: a tube of radius `tube` < size/2 along the trefoil
// size · (sin t + 2 sin 2t, cos t − 2 cos 2t, −sin 3t), with `around` ≥ 32
// points along the trefoil and `across` points around the tube;
// 2·around·across triangles.
TriangleMesh MakeKnot(double size, double tube, int around, int across);

// Tube with flat ends along a polyline.  Each part is a prism over the regular
// polygon with `sides` corners on the circle of that radius; neighbouring parts
// meet in a mitre.  The first corner of the first part points towards `up`; it
// is carried along the tube without twist.  Bends must be below 90 degrees, and
// each part longer than the mitres at its ends, radius · tan(bend / 2) each.
// Other parts must not touch each other; this is not checked here, but
// MakeSolid checks it.  2·sides·points − 4 triangles.
TriangleMesh MakeTube(const std::vector<Eigen::Vector3d>& path, double radius,
                      int sides,
                      const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

// A rotation by no special angle, for meshes that must not be axis-aligned:
// 0.7 rad about z, then 0.9 about y, then 0.4 about x.
Eigen::Matrix3d GenericRotation();

}  // namespace phongpd
