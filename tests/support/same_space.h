// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/contact/contact_space.h"

namespace phongpd::testing {

// What two contact spaces do not share to the last bit, of mesh, planes, kinds
// and what is said of the surface, in words; empty: nothing.
std::string DifferenceOf(const ContactSpace& a, const ContactSpace& b);

}  // namespace phongpd::testing
