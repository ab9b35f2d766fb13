// SPDX-License-Identifier: GPL-3.0-or-later
// The inputs that fuzzing kept, through the functions it was done with.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/mesh/input_file.h"
#include "tests/fuzz/fuzz_targets.h"

namespace phongpd {
namespace {

class FuzzCorpus : public testing::TestWithParam<fuzz::Target> {};

TEST_P(FuzzCorpus, KeepsItsPromises) {
  const std::filesystem::path folder =
      std::filesystem::path(PHONGPD_FUZZ_CORPUS) / GetParam().name;
  int inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().filename().string());
    const std::string bytes =
        ReadInputFile(entry.path().string(), "an input", 1 << 20);
    GetParam().run(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                   bytes.size());
    ++inputs;
  }
  EXPECT_GT(inputs, 0);
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, testing::ValuesIn(fuzz::kTargets),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace phongpd
