// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

// The campaign at the extremes: tests with a short form in the suite and a
// long one that `scripts/bench.sh extremes` publishes in results/extremes.
namespace phongpd::testing {

// True where the environment has PHONGPD_CAMPAIGN=long.
bool IsLongCampaign();

// `brief` cases in the suite, `whole` ones in the long form.
long CampaignCases(long brief, long whole);

// What one test of the campaign found.
struct CampaignRow {
  std::string item;     // of the campaign: "separation", "motion checks", …
  std::string subject;  // what was tried: "10 shapes, rational truth"
  long cases = 0;
  long failures = 0;
  double worst = 0.0;  // the largest error seen, in units of `unit`
  double bound = 0.0;  // what it may be; 0: failures are all that counts
  std::string unit;    // of worst and bound: "L", "ulp", "s"; may be empty
  std::uint64_t seed = 0;
};

// In the long form, prints the row to stdout as one line that begins with
// "CAMPAIGN " and goes on with a JSON object; nothing in the suite.
void ReportCampaign(const CampaignRow& row);

}  // namespace phongpd::testing
