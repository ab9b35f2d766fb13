// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace phongpd {

// Throws InputError unless the browser Chromium (or Chrome) is on PATH.
void RequireBrowser();

// The page (ViewPage) as a picture in PNG of that size, drawn by a headless
// browser in software: nothing but the scene, its title and its legend, the
// robot at stages along its way, or at one moment, a share of its way in
// [0, 1].  Throws like RequireBrowser, InputError where no temporary folder can
// be written, and std::runtime_error if the browser gives no picture.
std::string StillPicture(const std::string& page, int width, int height,
                         std::optional<double> moment = std::nullopt);

}  // namespace phongpd
