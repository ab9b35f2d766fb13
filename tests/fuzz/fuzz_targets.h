// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

// What the fuzzers do with the bytes they are given.  Each returns when the
// bytes were refused (InputError) or gave a result that keeps what the
// library promises of it; another exception, a broken promise (which prints a
// line and aborts), a crash, a leak or a sanitizer's report is a defect.
namespace phongpd::fuzz {

// Mesh files, in memory: refused, or valid indices and finite coordinates.
void MeshOff(const std::uint8_t* data, std::size_t size);
void MeshObj(const std::uint8_t* data, std::size_t size);
void MeshStl(const std::uint8_t* data, std::size_t size);
void MeshPly(const std::uint8_t* data, std::size_t size);

// A URDF or SDF file after a byte that says what of it is read (all of it, a
// link, joint values): refused, or valid indices and finite coordinates.  No
// mesh file is read.  Only where tinyxml2 is.
void Robot(const std::uint8_t* data, std::size_t size);

// A glTF file in the folder of a stranger, with ways out of it: refused, or a
// mesh of what lies in the folder.  Assimp reads it in a process of its own, of
// which the fuzzer sees the outcome.  Only where Assimp is.
void Gltf(const std::uint8_t* data, std::size_t size);

// A file of points: refused, or finite.
void PointsCsv(const std::uint8_t* data, std::size_t size);

// A scene file: refused, or solids.  Counts of procedural shapes are cut to
// what is fast, scans are left out, and no mesh file is read.
void Scene(const std::uint8_t* data, std::size_t size);

// The contents of a cached or saved contact space, which are the same bytes
// read by the same code (FromBytes), their checksum taken as right:
// refused, or the same after writing and reading again.
void Cache(const std::uint8_t* data, std::size_t size);

// The contents of a piece of a contact space, their checksum taken as right:
// refused, or joined to a closed contact space with finite vertices.
void Piece(const std::uint8_t* data, std::size_t size);

// Two small solids, changed as the bytes say (vertices onto each other or next
// to each other, turned and doubled triangles, scales, offsets): refused, or
// a closed contact space of finite volume.
void ContactSpace(const std::uint8_t* data, std::size_t size);

// Queries of three contact spaces by every metric, at points of any bits,
// with branches of other points, other metrics and any bits: an answer that is
// finite, unit directions, exact insides.
void Query(const std::uint8_t* data, std::size_t size);

struct Target {
  const char* name;
  void (*run)(const std::uint8_t* data, std::size_t size);
};
inline constexpr Target kTargets[] = {
    {"cache", Cache},      {"contact_space", ContactSpace},
    {"mesh_obj", MeshObj}, {"mesh_off", MeshOff},
    {"mesh_ply", MeshPly}, {"mesh_stl", MeshStl},
    {"piece", Piece},      {"points_csv", PointsCsv},
    {"query", Query},
#ifdef PHONGPD_FUZZES_ROBOTS
    {"gltf", Gltf},        {"robot", Robot},
#endif
    {"scene", Scene}};

}  // namespace phongpd::fuzz
