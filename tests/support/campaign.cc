// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/campaign.h"

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

namespace phongpd::testing {

bool IsLongCampaign() {
  const char* const form = std::getenv("PHONGPD_CAMPAIGN");
  return form != nullptr && std::string(form) == "long";
}

long CampaignCases(long brief, long whole) {
  return IsLongCampaign() ? whole : brief;
}

void ReportCampaign(const CampaignRow& row) {
  if (!IsLongCampaign()) return;
  const nlohmann::ordered_json line = {
      {"item", row.item},   {"subject", row.subject},
      {"cases", row.cases}, {"failures", row.failures},
      {"worst", row.worst}, {"bound", row.bound},
      {"unit", row.unit},   {"seed", row.seed},
  };
  std::cout << "CAMPAIGN " << line.dump() << std::endl;
}

}  // namespace phongpd::testing
