// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

// What a command is at, on standard error.  A terminal sees every stage at
// once, and counts within it every two seconds; a log, of whatever takes long,
// a line every ten seconds.  PHONGPD_PROGRESS=never silences it.
namespace phongpd::cli {

// A stage begins.
void Progress(const std::string& text);

// `done` of `all` things are over; with the time that the others will take if
// they take as long.  Cheap; silent for the first two seconds of `what`.
void ProgressOf(const std::string& what, std::size_t done, std::size_t all);

// Tells of contact spaces while they are built: stage, time, and the time left
// that was predicted.
void TellOfBuilds();

// The last stage that began, shown or not.
std::string& Stage();

}  // namespace phongpd::cli
