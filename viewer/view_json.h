// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "viewer/display_mesh.h"
#include "viewer/view.h"

namespace phongpd {

// The data block of the page:
//   title, unit, notes[]
//   center[3], scale       meshes hold (p − center) / scale, which fits single
//                          precision wherever the scene lies
//   meshes[{name, role, triangles (of the original), shown, positions (base64
//     of float32 triples), indices (base64 of uint32 triples)}]
//   robot                  the same without a role, relative to the origin: its
//                          vertices are p / scale; null: none
//   start, goal            [x, y, z] or null; these and all below in the user's
//                          unit
//   paths[{name, free, points[[x, y, z]]}]
//   motion {positions[], traces[{name, pd[], status[]}]} or null
//   answers[{position, orientation [w, x, y, z], status, depth, clearance,
//     direction, on_a, on_b}]  on_a and on_b are null without witness points
//   graphs[{path (its number), name, points, edges (how many there are),
//     positions (base64 of float32 triples, as those of meshes), indices
//     (base64 of uint32 pairs)}]
//   planes[{path, planes[{point, normal, size}]}]
//   iterates[{path, count (of all iterations), kept[{number, stage,
//     restoration, free, objective, violation}], points (of each), positions
//     (base64 of float32 triples, as those of meshes, one path after the
//     other)}]
//   regions[{path, min, max}]  that were modelled around paths
//   windows[{reaches[], axes[3][x, y, z]} or null]  one for each answer
//   probe {module (base64 of WebAssembly), length (D), spaces[{positions
//     (base64 of float64 triples), indices}]} or null
//   solver {module (base64 of WebAssembly), robot {positions (base64 of float64
//     triples), indices}, obstacles[the same]} or null: where the page can plan
//   task {command, served, clearance (0: none is asked for)}  whether start and
//     goal can be moved, and what the page asks then: the server that it came
//     from, or the person who reads it to run the command; null: it shows no
//     such scene
// Of graphs with more than kMaxDisplayEdges edges some are left out, and a note
// says so; another where not every iteration is there.  Meshes with more than
// `most_triangles` together are shown coarser, and a note says so.
nlohmann::ordered_json ViewJson(
    const View& view, std::size_t most_triangles = kMaxDisplayTriangles);

}  // namespace phongpd
