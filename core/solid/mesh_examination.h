// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/solid/mesh_check.h"

// The steps of ExamineMesh, which MakeSolid takes one by one: the cheap ones
// may refuse a mesh before those that take long are asked.
namespace phongpd::internal {

// Of each vertex: does a triangle use it?  Requires valid indices.
std::vector<bool> UsedVertices(const TriangleMesh& mesh);

// Used vertices, equal coordinates next to each other, the earlier first.
std::vector<int> SortedByCoordinates(const TriangleMesh& mesh);

// Edges that are not between two triangles of one orientation.
std::size_t BadEdges(const MeshReport& report);

// Everything that needs no geometry beyond equality; cheap.
MeshReport ExamineTopology(const TriangleMesh& mesh);

// The rest, added to what ExamineTopology found; nothing where that found
// invalid indices or coordinates that are no numbers.
void ExamineGeometry(const TriangleMesh& mesh, MeshReport* report);

// The report's warnings, from its counts.
void AddWarnings(MeshReport* report);

// Adds the counts and the volume of a part to those of the whole; warnings,
// which need the part's name, are the caller's.
void AddCounts(const MeshReport& part, MeshReport* whole);

}  // namespace phongpd::internal
