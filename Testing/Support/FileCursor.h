// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/FileMesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace smg::testing
{

/** Reads words, numbers and bytes from a text. */
class FileCursor
{
public:
  explicit FileCursor(std::string text)
    : Text(std::move(text))
  {
  }

  bool atEnd()
  {
    this->skipBlanks();
    return this->At == this->Text.size();
  }
  std::string word()
  {
    this->skipBlanks();
    const std::size_t begin = this->At;
    while (this->At < this->Text.size() && this->Text[this->At] > ' ')
    {
      ++this->At;
    }
    return this->Text.substr(begin, this->At - begin);
  }
  std::string line()
  {
    const std::size_t end = this->Text.find('\n', this->At);
    const std::string line = this->Text.substr(this->At, end - this->At);
    this->At = end + 1;
    return line;
  }
  void expect(const std::string& expected)
  {
    if (const std::string found = this->word(); found != expected)
    {
      throw std::runtime_error("'" + found + "' instead of '" + expected + "'");
    }
  }
  double number() { return std::stod(this->word()); }
  std::int64_t integer() { return std::stoll(this->word()); }
  template <class T>
  T binary(std::endian order)
  {
    std::array<char, sizeof(T)> bytes{};
    this->Text.copy(bytes.data(), sizeof(T), this->At);
    this->At += sizeof(T);
    if (order != std::endian::native)
    {
      std::ranges::reverse(bytes);
    }
    return std::bit_cast<T>(bytes);
  }
  double binary(const std::string& type, std::endian order)
  {
    if (type == "float")
    {
      return this->binary<float>(order);
    }
    if (type == "double")
    {
      return this->binary<double>(order);
    }
    if (type == "int")
    {
      return this->binary<std::int32_t>(order);
    }
    if (type == "uchar" || type == "unsigned_char")
    {
      return this->binary<std::uint8_t>(order);
    }
    if (type == "vtktypeint64")
    {
      return static_cast<double>(this->binary<std::int64_t>(order));
    }
    throw std::runtime_error("a number of type '" + type + "'");
  }
  void points(std::int64_t count, FileMesh& mesh)
  {
    for (std::int64_t i = 0; i < 3 * count; ++i)
    {
      mesh.points.push_back(this->number());
    }
  }
  /** Corners that count from `first`. */
  void cell(std::int64_t corners, std::int64_t first, FileMesh& mesh)
  {
    mesh.cells.emplace_back();
    for (std::int64_t i = 0; i < corners; ++i)
    {
      mesh.cells.back().push_back(this->integer() - first);
    }
  }

private:
  void skipBlanks()
  {
    while (this->At < this->Text.size() && this->Text[this->At] <= ' ')
    {
      ++this->At;
    }
  }

  std::string Text;
  std::size_t At = 0;
};

/** Legacy VTK, binary. */
FileMesh readVtk(FileCursor in);
/** VTK XML, arrays inline in base64. */
FileMesh readVtkXml(const std::string& text);

} // namespace smg::testing
