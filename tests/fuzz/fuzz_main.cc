// SPDX-License-Identifier: GPL-3.0-or-later
// A libFuzzer program for the target that the build names.
#include "tests/fuzz/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  phongpd::fuzz::PHONGPD_FUZZ_TARGET(data, size);
  return 0;
}
