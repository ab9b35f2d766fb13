// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/number_text.h"

// What files and pages write beside numbers (core/number_text.h).
namespace phongpd {

// One cell of a CSV file (RFC 4180): quoted where it holds a comma, a quote or
// a line's end.
std::string CsvCell(const std::string& text);

// `text` between the tags of HTML or SVG: & < > " as entities.
std::string Escaped(const std::string& text);

}  // namespace phongpd
