// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/campaign.h"

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "core/number_text.h"

namespace phongpd::testing {
namespace {

// JSON has no infinity.
std::string Number(double value) {
  return std::isfinite(value) ? FormatDouble(value) : "null";
}

}  // namespace

bool IsLongCampaign() {
  const char* const form = std::getenv("PHONGPD_CAMPAIGN");
  return form != nullptr && std::string(form) == "long";
}

long CampaignCases(long brief, long whole) {
  return IsLongCampaign() ? whole : brief;
}

// Its texts are ours: without quotes, backslashes and control characters.
void ReportCampaign(const CampaignRow& row) {
  if (!IsLongCampaign()) return;
  std::cout << "CAMPAIGN {\"item\":\"" << row.item << "\",\"subject\":\""
            << row.subject << "\",\"cases\":" << row.cases
            << ",\"failures\":" << row.failures
            << ",\"worst\":" << Number(row.worst)
            << ",\"bound\":" << Number(row.bound) << ",\"unit\":\"" << row.unit
            << "\",\"seed\":" << row.seed << '}' << std::endl;
}

}  // namespace phongpd::testing
