// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>

namespace smg::testing
{

/** The message of the Error of `run`, which receives the options with a separate scratch folder;
 * empty if there is none. Checks that it is one line and that no scratch file is left. */
template <class Options>
std::string scratchErrorOf(Options options, const auto& run)
{
  const TemporaryFolder folder;
  options.scratch = folder.path();
  const std::string sentence = messageOf([&] { run(options); });
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
  return sentence;
}

} // namespace smg::testing
