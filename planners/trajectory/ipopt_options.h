// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/trajectory/ipopt_solve.h"

namespace Ipopt {
class IpoptApplication;
}

namespace phongpd {

// Hands the settings to Ipopt, which then prints into settings.output.  Throws
// InputError for an option of settings.ipopt_options that Ipopt does not know
// or a value it refuses.
void ApplyIpoptOptions(const IpoptSettings& settings,
                       Ipopt::IpoptApplication* application);

// Ipopt's ApplicationReturnStatus by its own name, and its class.
const char* IpoptStatusName(int status);
SolveStatus ClassifyIpoptStatus(int status);

}  // namespace phongpd
