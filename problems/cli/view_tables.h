// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/view.h"

// Answers out of the files that commands wrote, to look at.  Errors are
// InputErrors that name file, line and column.
namespace phongpd::cli {

// What a table is by the columns of its header.
enum class TableKind {
  kMotion,  // frame, metric, status, pd_x, pd_y, pd_z (motion)
  kDepth,   // x, ..., on_a_x, ..., on_b_z (depth --pose)
  kQuery,   // x, y, z, status, contact_x, ... (query)
  kOther,
};
TableKind KindOfTable(std::string_view content);

// The metrics in the order of the file, a trace each of as many frames.
std::vector<ViewTrace> ParseTraces(std::string_view content,
                                   const std::string& file);

// An answer a row.
std::vector<ViewAnswer> ParseDepthTable(std::string_view content,
                                        const std::string& file);
std::vector<ViewAnswer> ParseQueryTable(std::string_view content,
                                        const std::string& file);

}  // namespace phongpd::cli
