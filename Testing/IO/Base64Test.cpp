// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Base64.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace smg::testing
{
namespace
{

/** The encoding of the bytes, passed in parts of `part` bytes. */
std::string encoded(std::string_view bytes, std::size_t part)
{
  std::string text;
  Base64Encoder encoder;
  for (std::size_t i = 0; i < bytes.size(); i += part)
  {
    encoder.append(std::as_bytes(std::span(bytes.substr(i, part))), text);
  }
  encoder.finish(text);
  EXPECT_EQ(Base64Encoder::encodedSize(static_cast<std::int64_t>(bytes.size())),
    static_cast<std::int64_t>(text.size()));
  return text;
}

} // namespace

TEST(Base64, VectorsOfTheStandard)
{
  EXPECT_EQ(encoded("", 1), "");
  EXPECT_EQ(encoded("f", 1), "Zg==");
  EXPECT_EQ(encoded("fo", 2), "Zm8=");
  EXPECT_EQ(encoded("foo", 3), "Zm9v");
  EXPECT_EQ(encoded("foob", 4), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba", 5), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar", 6), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd\xfb\xff\xbf", 6), "//79+/+/");
}

TEST(Base64, PartsOfAnySizeMakeOneUnit)
{
  std::string bytes;
  for (int i = 0; i < 256; ++i)
  {
    bytes += static_cast<char>(i);
  }
  const std::string whole = encoded(bytes, bytes.size());
  EXPECT_TRUE(whole.starts_with("AAECAwQF"));
  EXPECT_TRUE(whole.ends_with("+fr7/P3+/w=="));
  for (std::size_t part = 1; part < 10; ++part)
  {
    EXPECT_EQ(encoded(bytes, part), whole) << part;
  }
}

TEST(Base64, AnEncoderIsUsedAgain)
{
  std::string text;
  Base64Encoder encoder;
  for (int i = 0; i < 2; ++i)
  {
    encoder.append(std::as_bytes(std::span(std::string_view("f"))), text);
    encoder.finish(text);
  }
  EXPECT_EQ(text, "Zg==Zg==");
}

} // namespace smg::testing
