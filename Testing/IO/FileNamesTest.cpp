// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace smg::testing
{

TEST(FileNames, QuotesKeepWhatCanBeRead)
{
  const std::string name = "temperature of the inner wall at the end of the second step";
  const std::string long200(200, 'x');
  const std::pair<std::string, std::string> cases[] = { { "", "''" }, { "a b", "'a b'" },
    { name, "'" + name + "'" }, { "\u00e4 \u20ac \U0001F600", "'\u00e4 \u20ac \U0001F600'" },
    { std::string("a\0b\n\x1b[1m\x7f", 9), "'a?b?\?[1m?'" },
    // Bytes that are not UTF-8: alone, cut, overlong, surrogates, controls, too large.
    { "\xe4", "'?'" }, { "\xe2\x82", "'\?\?'" }, { "\xc0\xaf", "'\?\?'" },
    { "\xed\xa0\x80", "'\?\?\?'" }, { "\xc2\x85", "'?'" }, { "\xf4\x90\x80\x80", "'\?\?\?\?'" },
    { long200 + "y", "'" + long200 + "...'" } };
  for (const auto& [text, quoted] : cases)
  {
    EXPECT_EQ(inQuotes(text), quoted);
  }
}

} // namespace smg::testing
