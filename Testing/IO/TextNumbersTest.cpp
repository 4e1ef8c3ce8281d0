// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/TextNumbers.h"

#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** Appends words of 1 to 9 letters, sometimes of hundreds, with blanks of all kinds before them,
 * and where each word ends. */
void appendWords(int words, std::string& text, std::vector<std::size_t>& ends)
{
  Random random(5);
  for (int i = 0; i < words; ++i)
  {
    text.append(
      static_cast<std::size_t>(random.below(i % 50 ? 3 : 200)) + 1, " \t\r\n\f\v"[random.below(6)]);
    text.append(static_cast<std::size_t>(random.below(i % 70 ? 9 : 300)) + 1,
      static_cast<char>('!' + random.below(20)));
    ends.push_back(text.size());
  }
}

TEST(TextNumbers, SkipsWords)
{
  constexpr int Words = 3000;
  std::vector<std::size_t> ends;
  // The first window of the file ends among the words.
  constexpr std::size_t Begin = InputFile::WindowBytes - 17000;
  std::string text(Begin + 1000, 'x');
  ends.push_back(text.size());
  appendWords(Words - 1, text, ends);
  TemporaryFolder folder;
  writeBytes(folder / "whole", text + " ");
  writeBytes(folder / "ended", text + "</DataArray> 1 2 3");
  for (const char* name : { "whole", "ended" })
  {
    InputFile file(folder / name);
    for (int count = 0; count <= Words; count += count % 100 < 20 ? 1 : 7)
    {
      file.at(0);
      TextNumbers numbers(file, Begin);
      ASSERT_EQ(numbers.skip(count), count) << name;
      ASSERT_EQ(numbers.offset(), count == 0 ? Begin : ends[static_cast<std::size_t>(count) - 1])
        << name << ", " << count;
    }
    EXPECT_EQ(TextNumbers(file, Begin).skip(Words + 1000), Words) << name;
    EXPECT_EQ(TextNumbers(file, ends[9]).skip(Words + 1000), Words - 10) << name;
  }
}

} // namespace
} // namespace smg::testing
