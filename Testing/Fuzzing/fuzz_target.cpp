// SPDX-License-Identifier: BSD-3-Clause
// The libFuzzer program of the target SMG_FUZZ_TARGET.
#include "Testing/Fuzzing/FuzzTargets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const smg::testing::FuzzTarget& target = smg::testing::fuzzTarget(SMG_FUZZ_TARGET);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  target.run(bytes, smg::testing::choiceFor(bytes));
  return 0;
}
