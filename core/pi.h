// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace phongpd
