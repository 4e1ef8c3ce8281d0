// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/JsonNode.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

TEST(JsonComplaint, SaysWhatAndWhere)
{
  const std::pair<std::string, std::string> complaints[] = {
    { "{\"a\":\n  [1, x]}", "line 2, column 7: this is not valid JSON: unexpected character 'x'" },
    { "[tree]", "line 1, column 2: this is not valid JSON: unexpected word 'tree'" },
    { "[1,\r\n]", "line 2, column 1: this is not valid JSON: unexpected ']'" },
    { "[1 -23]", "line 1, column 4: this is not valid JSON: unexpected number literal" },
    { "{\"a\" \"b\"}", "line 1, column 6: this is not valid JSON: unexpected string literal" },
    { "[1,\n2", "line 2, column 2: this is not valid JSON: unexpected end" },
    { "[\"a", "line 1, column 4: this is not valid JSON: unexpected end" },
    { "[\"\xc3\xa4\", ?]", "line 1, column 7: this is not valid JSON: unexpected character '?'" },
    { "[\n1e999]", "line 2, column 1: the number '1e999' is out of range" },
  };
  for (const auto& [text, complaint] : complaints)
  {
    EXPECT_EQ(smg::jsonComplaint(text), complaint);
  }
  for (const char* number : { "NaN", "nan", "Infinity", "-Infinity", "inf" })
  {
    EXPECT_EQ(smg::jsonComplaint("{\n  \"scale\": " + std::string(number) + " }"),
      "line 2, column 12: this is not valid JSON: NaN and Infinity are no JSON numbers");
  }
}
