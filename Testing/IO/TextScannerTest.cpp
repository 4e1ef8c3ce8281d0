// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/TextScanner.h"

#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

class Scanner : public ::testing::Test
{
protected:
  InputFile open(std::string_view text)
  {
    writeBytes(this->Folder / "text", text);
    return InputFile(this->Folder / "text", {}, "name.off");
  }

  TemporaryFolder Folder;
};

/** A token of a text, and where it is. */
struct Word
{
  std::string text;
  std::int64_t line;
};

/** Words of all lengths between blanks, line ends and comments: `bytes` bytes or more. */
std::string longText(std::size_t bytes, std::vector<Word>& words)
{
  Random random(3);
  std::string text;
  std::int64_t line = 1;
  while (text.size() < bytes)
  {
    const std::int64_t longest = random.below(40) == 0 ? 3000 : 12;
    words.push_back(
      { std::string(std::size_t(random.below(longest)) + 1, 'a') + std::to_string(words.size()),
        line });
    text += words.back().text;
    if (random.below(10) == 0)
    {
      text += "# a comment" + std::string(std::size_t(random.below(100)), '#');
      text += '\n';
      ++line;
    }
    text.append(std::size_t(random.below(4)) + 1, random.below(2) ? ' ' : '\t');
    for (std::int64_t i = random.below(3); i > 0; --i)
    {
      text += "\r\n";
      ++line;
    }
  }
  return text;
}

} // namespace

TEST_F(Scanner, TokensOfALongTextAreThoseOfTheText)
{
  std::vector<Word> words;
  InputFile file = this->open(longText(3 * InputFile::WindowBytes, words));
  TextScanner scanner(file, '#');
  for (const Word& word : words)
  {
    ASSERT_EQ(scanner.peek(), word.text);
    ASSERT_EQ(scanner.line(), word.line);
    ASSERT_EQ(scanner.token(), word.text);
  }
  EXPECT_TRUE(scanner.atEnd());
  EXPECT_TRUE(scanner.token().empty());
}

TEST_F(Scanner, LinesOfALongTextAreThoseOfTheText)
{
  std::string text;
  for (int i = 0; i < 300000; ++i)
  {
    text += std::to_string(i) + " rest of the line\n";
  }
  text += "# " + std::string(2 * InputFile::WindowBytes, 'x') + "\nend";
  InputFile file = this->open(text);
  TextScanner scanner(file, '#');
  for (int i = 0; i < 300000; ++i)
  {
    ASSERT_EQ(scanner.toInteger(scanner.tokenInLine(), "a number"), i);
    ASSERT_EQ(scanner.line(), i + 1);
    scanner.skipLine();
  }
  EXPECT_TRUE(scanner.tokenInLine().empty()); // the long comment
  scanner.skipLine();
  EXPECT_EQ(scanner.tokenInLine(), "end");
  EXPECT_TRUE(scanner.tokenInLine().empty());
  EXPECT_EQ(scanner.line(), 300002);
  EXPECT_EQ(scanner.offset(), text.size());
}

/** Lines of words, of numbers that are integers, real, or out of range, and of comments. */
std::string manyNumbers(std::size_t bytes)
{
  constexpr std::string_view Special[] = { "-0", "+7", "+-7", "1e400", "-1e400", "1e-400", "nan",
    "9223372036854775807", "9223372036854775808", "-12/3", ".5", "-", "1.5e", "0x10", "007",
    "17976931348623157e292", "v" };
  Random random(11);
  std::string text;
  while (text.size() < bytes)
  {
    for (std::int64_t words = random.below(6); words > 0; --words)
    {
      const std::int64_t kind = random.below(20);
      text += kind == 0 ? std::string(Special[std::size_t(random.below(std::ssize(Special)))])
              : kind < 10
                ? std::to_string(random.below(1000000) - 1000)
                : std::to_string(static_cast<double>(random.below(1000000000)) / 1024.0 - 1e3);
      text.append(std::size_t(random.below(3)) + 1, random.below(5) ? ' ' : '\t');
    }
    text += random.below(10) ? "" : "12#34 a comment # of two words";
    text += random.below(5) ? "\n" : "\r\n";
  }
  return text;
}

enum Request : int
{
  Peek,
  SkipLine,
  TokenInLine,
  Integer // others: a number
};

/** What a request to a scanner returns or throws, and where it is afterwards. */
std::string answer(TextScanner& scanner, Request request)
{
  std::string said;
  try
  {
    switch (request)
    {
      case Peek:
        said = scanner.peek();
        break;
      case SkipLine:
        scanner.skipLine();
        break;
      case TokenInLine:
        said = scanner.tokenInLine();
        break;
      case Integer:
        said = std::to_string(scanner.integer("an integer"));
        break;
      default:
        const double number = scanner.number("a number");
        said = std::to_string(std::signbit(number)) + std::to_string(number);
    }
  }
  catch (const Error& error)
  {
    said = error.what();
  }
  return said + " at " + std::to_string(scanner.offset()) + " in line " +
         std::to_string(scanner.line());
}

TEST_F(Scanner, OtherThreadsChangeNothing)
{
  const std::string numbers = manyNumbers(2 * InputFile::WindowBytes);
  // A line longer than what is read ahead, and a long comment.
  const std::string longLine(2 * WordPrefetch::BlockBytes, ' ');
  for (const std::string& text :
    { numbers, numbers + longLine + numbers, numbers + "#" + longLine + "1 2\n" + numbers + "end" })
  {
    Workspace workspace(this->Folder.path(), std::int64_t(64) << 20, {}, 0, 3);
    InputFile file = this->open(text), sameFile = this->open(text);
    TextScanner alone(file, '#'), helped(sameFile, '#', &workspace);
    Random random(4);
    while (!alone.atEnd() && !helped.atEnd())
    {
      const auto request = static_cast<Request>(random.below(20));
      ASSERT_EQ(answer(helped, request), answer(alone, request));
      if (random.below(100000) == 0) // which ends what is found ahead
      {
        helped.moveTo(helped.offset());
      }
    }
    EXPECT_TRUE(helped.atEnd() && alone.atEnd());
    EXPECT_GT(workspace.pool().peak(), 0);
  }
}

TEST_F(Scanner, ManyBlanksAreOneSeparator)
{
  InputFile file = this->open("a" + std::string(2 * InputFile::WindowBytes + 5, ' ') + "b\n\n c");
  TextScanner scanner(file);
  EXPECT_EQ(scanner.tokenInLine(), "a");
  EXPECT_EQ(scanner.tokenInLine(), "b");
  EXPECT_EQ(scanner.tokenInLine(), "");
  EXPECT_EQ(scanner.token(), "c");
  EXPECT_EQ(scanner.line(), 3);
}

TEST_F(Scanner, TextAndBytesAlternate)
{
  std::string text = "3 numbers\n";
  const std::size_t begin = text.size();
  text += std::string(2 * InputFile::WindowBytes, '\n');
  const std::size_t end = text.size();
  text += "and\nmore";
  InputFile file = this->open(text);
  TextScanner scanner(file);
  EXPECT_EQ(scanner.integer("a number"), 3);
  scanner.skipLine();
  EXPECT_EQ(scanner.offset(), begin);
  EXPECT_EQ(file.at(begin + InputFile::WindowBytes)[0], '\n');
  scanner.moveTo(end);
  EXPECT_EQ(scanner.token(), "and");
  EXPECT_EQ(scanner.line(), 2);
  EXPECT_EQ(scanner.token(), "more");
  EXPECT_EQ(scanner.line(), 3);
  scanner.moveTo(text.size() + 10);
  EXPECT_TRUE(scanner.atEnd());
}

TEST_F(Scanner, ReadsNumbersAsFilesHaveThem)
{
  InputFile file = this->open("+1 -2.5e+3 1e-400 .5 +7 -9223372036854775808 nan");
  TextScanner scanner(file);
  EXPECT_EQ(scanner.number("x"), 1.0);
  EXPECT_EQ(scanner.number("x"), -2500.0);
  EXPECT_EQ(scanner.number("x"), 0.0);
  EXPECT_EQ(scanner.number("x"), 0.5);
  EXPECT_EQ(scanner.integer("x"), 7);
  EXPECT_EQ(scanner.integer("x"), INT64_MIN);
  EXPECT_TRUE(std::isnan(scanner.toNumber(scanner.token(), "x", false)));
}

TEST_F(Scanner, WhatIsNoNumberIsRefusedWithItsPlace)
{
  const std::pair<const char*, const char*> numbers[] = { { "1,5", "'1,5' is not a number" },
    { "nan", "not finite" }, { "-inf", "not finite" }, { "1e999", "not finite" },
    { "+-1", "is not a number" }, { "0x", "is not a number" }, { "", "ends where the width" } };
  for (const auto& [text, complaint] : numbers)
  {
    InputFile file = this->open(std::string("\n\n") + text);
    TextScanner scanner(file);
    const std::string message = messageOf([&] { scanner.number("the width"); });
    EXPECT_TRUE(message.starts_with("name.off, line 3: ")) << message;
    EXPECT_NE(message.find(complaint), std::string::npos) << message;
  }
  InputFile file = this->open("1.0 9223372036854775808 -");
  TextScanner scanner(file);
  for (int i = 0; i < 3; ++i)
  {
    expectError([&] { scanner.integer("x"); }, "is not an integer");
  }
}

TEST_F(Scanner, CountsAreCheckedAgainstTheFile)
{
  InputFile file = this->open("3 1 2 3");
  EXPECT_EQ(TextScanner(file).count("the number of things", 2), 3);
  InputFile tooMany = this->open("4 1 2 3");
  expectError([&] { TextScanner(tooMany).count("the number of things", 2); },
    "line 1: 4 cannot be the number of things: the file has 6 more bytes");
  InputFile negative = this->open("-1 1 2 3");
  expectError([&] { TextScanner(negative).count("the number of things", 2); }, "-1 cannot be");
}

TEST_F(Scanner, EndlessTokensAreRefused)
{
  InputFile file = this->open("\n" + std::string(TextScanner::MaxTokenBytes, 'x') + " " +
                              std::string(3 * InputFile::WindowBytes, 'y'));
  TextScanner scanner(file);
  EXPECT_EQ(scanner.token().size(), TextScanner::MaxTokenBytes);
  expectError([&] { scanner.token(); }, "name.off, line 2: a word has more than 65536 bytes");
}

} // namespace smg::testing
