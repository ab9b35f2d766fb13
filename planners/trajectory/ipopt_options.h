// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "planners/trajectory/ipopt_solve.h"

namespace Ipopt {
class IpoptApplication;
}

namespace phongpd {

// Hands the settings to Ipopt; the linear solver is one for settings that name
// none.  Throws InputError for an option of settings.ipopt_options that Ipopt
// does not know, that does more than change numbers, or a value it refuses or
// ends the process with.
void ApplyIpoptOptions(const IpoptSettings& settings,
                       const std::string& linear_solver,
                       Ipopt::IpoptApplication* application);

// Ipopt's ApplicationReturnStatus by its own name, and its class.
const char* IpoptStatusName(int status);
SolveStatus ClassifyIpoptStatus(int status);

}  // namespace phongpd
