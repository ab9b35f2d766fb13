// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/mesh/mesh_error.h"

namespace phongpd {

// Throws InputError if the program gnuplot is not on PATH.
void RequireGnuplot();

// The text between single quotes, where gnuplot reads all as it stands.
std::string GnuplotText(const std::string& text);

// Runs `script` (which carries its data as $name << EOD blocks) through
// gnuplot's SVG terminal of the given size in pixels and returns the picture.
// Throws InputError without gnuplot or room for its temporary files, and
// std::runtime_error, with gnuplot's first message, if it fails.
std::string RenderSvg(const std::string& script, int width, int height);

}  // namespace phongpd
