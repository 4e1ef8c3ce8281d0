// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/LegacyVtkCells.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace smg
{

namespace
{

/** Reads integers of a text or of big-endian binary data from a place of the file on. */
class Integers
{
public:
  Integers(const InputFile& file, std::size_t offset, bool binary)
    : File(file)
    , At(offset)
    , Binary(binary)
  {
  }

  std::int64_t next()
  {
    const std::string_view text = this->File.text();
    if (this->Binary)
    {
      if (text.size() - this->At < 4)
      {
        this->fail();
      }
      std::uint32_t value = 0;
      for (int i = 0; i < 4; ++i)
      {
        value = value << 8 | static_cast<unsigned char>(text[this->At++]);
      }
      return static_cast<std::int32_t>(value);
    }
    this->At = std::min(text.find_first_not_of(" \t\r\n", this->At), text.size());
    std::int64_t value = 0;
    const auto result = std::from_chars(text.data() + this->At, text.data() + text.size(), value);
    if (result.ec != std::errc())
    {
      this->fail();
    }
    this->At = static_cast<std::size_t>(result.ptr - text.data());
    return value;
  }

  /** Goes to the beginning of the next line. */
  void skipLine()
  {
    const std::size_t end = this->File.text().find('\n', this->At);
    this->At = end == std::string_view::npos ? this->File.size() : end + 1;
  }

  void toBinary(bool binary) { this->Binary = binary; }

  [[noreturn]] void fail() const
  {
    this->File.fail(this->At, "the list of cells is wrong here, or the file is truncated");
  }

private:
  const InputFile& File;
  std::size_t At;
  bool Binary;
};

/** Checks the list behind the keyword that ends at `offset`; answers its number of cells. */
std::int64_t checkList(const InputFile& file, std::size_t offset, bool binary, bool counted)
{
  Integers integers(file, offset, false);
  const std::int64_t cells = integers.next();
  const std::int64_t size = integers.next();
  const auto most = static_cast<std::int64_t>(file.size());
  if (cells < 0 || cells > most || size < 0 || size > most)
  {
    integers.fail();
  }
  if (!counted)
  {
    return cells;
  }
  integers.skipLine();
  integers.toBinary(binary);
  std::int64_t left = size;
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    const std::int64_t points = integers.next();
    if (points < 0 || points >= left)
    {
      integers.fail();
    }
    for (std::int64_t i = 0; i < points; ++i)
    {
      integers.next();
    }
    left -= points + 1;
  }
  if (left != 0)
  {
    integers.fail();
  }
  return cells;
}

} // namespace

std::int64_t checkLegacyVtkCells(const InputFile& file)
{
  constexpr std::string_view Title = "# vtk DataFile Version ";
  const std::string_view text = file.text();
  const std::string_view head = text.substr(0, 4096);
  const auto isDigit = [&head](std::size_t i)
  { return i < head.size() && head[i] >= '0' && head[i] <= '9'; };
  if (!head.starts_with(Title) || !isDigit(Title.size()) || head[Title.size() + 1] != '.' ||
      !isDigit(Title.size() + 2))
  {
    file.fail(0, "the first line does not say the version of the format, as '4.2'");
  }
  const bool counted = head[Title.size()] < '5';
  const bool binary = head.find("\nBINARY") != std::string_view::npos;
  std::int64_t cells = 0;
  // Some writers leave out the line end between binary points and the next keyword.
  const std::size_t dataset = std::min(text.find("\nDATASET "), text.size());
  for (const std::string_view keyword :
    { "VERTICES ", "LINES ", "POLYGONS ", "TRIANGLE_STRIPS ", "CELLS " })
  {
    const std::size_t at = text.find(keyword, dataset);
    if (at != std::string_view::npos)
    {
      cells += checkList(file, at + keyword.size(), binary, counted);
    }
  }
  return cells;
}

} // namespace smg
