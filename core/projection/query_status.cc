// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/query_status.h"

namespace phongpd {

const char* ToString(QueryStatus status) {
  switch (status) {
    case QueryStatus::kOk:
      return "ok";
    case QueryStatus::kBranchEnded:
      return "branch_ended";
    case QueryStatus::kEuclideanFallback:
      return "euclidean_fallback";
    case QueryStatus::kFollowing:
      return "following";
    case QueryStatus::kSliding:
      return "sliding";
    case QueryStatus::kLeftElsewhere:
      return "left_elsewhere";
    case QueryStatus::kOutside:
      return "outside";
    case QueryStatus::kInvalid:
      break;
  }
  return "invalid";
}

}  // namespace phongpd
