// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/view.h"

namespace phongpd {

// Entries of the page's lists paths, answers and movers (view_json.h), for
// pages that get them later.  A path's has no robot of its own, a mover's no
// body.
nlohmann::ordered_json PathEntry(const NamedPath& path);
nlohmann::ordered_json MoverEntries(const std::vector<ViewMover>& movers);
nlohmann::ordered_json AnswerEntry(const ViewAnswer& answer);

}  // namespace phongpd
