// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Off/BinaryOff.h"

#include "IO/Files/ByteOrder.h"
#include "IO/Files/InputFile.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/TriangleRuns.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace smg
{

namespace
{

constexpr std::size_t NumberBytes = 4;

/** The consecutive numbers of a file. */
class BigEndianNumbers
{
public:
  BigEndianNumbers(InputFile& file, std::size_t begin)
    : File(file)
    , At(begin)
  {
  }

  std::int32_t integer() { return this->next<std::int32_t>(); }
  double real() { return static_cast<double>(this->next<float>()); }
  /** The position of the next number. */
  std::size_t offset() const { return this->At; }
  /** Throws Error at the previous number. */
  [[noreturn]] void fail(const std::string& sentence) const
  {
    this->File.fail(this->At - NumberBytes, sentence);
  }

private:
  template <class T>
  T next()
  {
    const std::string_view bytes = this->File.at(this->At, NumberBytes);
    if (bytes.size() < NumberBytes)
    {
      this->File.fail(this->At, "the file is truncated here");
    }
    this->At += NumberBytes;
    return numberAt<T>(bytes.data(), std::endian::big);
  }

  InputFile& File;
  std::size_t At;
};

/** The number of values after the coordinates of a vertex. */
std::size_t furtherNumbers(const OffHeader& header)
{
  return (header.normals ? 3 : 0) + (header.colors ? 4 : 0) + (header.textureCoordinates ? 2 : 0);
}

void readVertices(BigEndianNumbers& numbers, const OffHeader& header, RawMeshBuilder& builder)
{
  OffAttributes attributes(header, builder);
  std::array<double, 9> further{};
  const std::span used = std::span(further).first(furtherNumbers(header));
  builder.useSinglePrecision();
  for (std::int64_t i = 0; i < header.vertices; ++i)
  {
    const auto fail = [&numbers, i](const std::string& sentence)
    { numbers.fail("vertex " + std::to_string(i) + ": " + sentence); };
    const double x = numbers.real();
    const double y = numbers.real();
    const double z = numbers.real();
    try
    {
      builder.vertex(x, y, z);
    }
    catch (const MeshError& error)
    {
      fail(error.what());
    }
    for (double& number : used)
    {
      number = numbers.real();
      if (!std::isfinite(number))
      {
        fail("a number behind its coordinates is not finite");
      }
    }
    attributes.add(used);
  }
  attributes.finish();
}

void readFaces(BigEndianNumbers& numbers, const OffHeader& header, RawMeshBuilder& builder)
{
  TriangleFan fan(builder);
  TextColors colors(builder, ImportColumn::Of::Elements);
  std::array<double, 4> color{};
  for (std::int64_t i = 0; i < header.faces; ++i)
  {
    const std::int32_t corners = numbers.integer();
    if (corners < 0)
    {
      numbers.fail("the number of corners of a face is negative");
    }
    for (std::int32_t k = 0; k < corners; ++k)
    {
      const std::int32_t corner = numbers.integer();
      if (corner < 0 || corner >= header.vertices)
      {
        numbers.fail("the corner " + std::to_string(corner) + " is none of the " +
                     std::to_string(header.vertices) + " vertices");
      }
      fan.corner(corner);
    }
    fan.end();
    const std::int32_t components = numbers.integer();
    if (components < 0 || components > 4)
    {
      numbers.fail("a colour has at most 4 numbers, not " + std::to_string(components));
    }
    const std::span used = std::span(color).first(static_cast<std::size_t>(components));
    for (double& number : used)
    {
      number = numbers.real();
    }
    colors.add(used);
  }
  colors.finish();
}

} // namespace

void readBinaryOffCounts(InputFile& file, OffHeader& header)
{
  BigEndianNumbers numbers(file, header.body);
  header.vertices = numbers.integer();
  header.faces = numbers.integer();
  numbers.integer(); // edges
  header.body = numbers.offset();
  const auto left = static_cast<std::int64_t>((file.size() - header.body) / NumberBytes);
  const auto vertexNumbers = static_cast<std::int64_t>(3 + furtherNumbers(header));
  if (header.vertices < 0 || header.faces < 0 || header.vertices > left / vertexNumbers ||
      2 * header.faces > left - header.vertices * vertexNumbers)
  {
    numbers.fail("the counts of " + std::to_string(header.vertices) + " vertices and " +
                 std::to_string(header.faces) +
                 " faces do not fit the size of the file: it is truncated, or its numbers do not "
                 "begin with the most significant byte");
  }
}

void readBinaryOff(InputFile& file, const OffHeader& header, RawMeshBuilder& builder)
{
  BigEndianNumbers numbers(file, header.body);
  try
  {
    readVertices(numbers, header, builder);
    readFaces(numbers, header, builder);
  }
  catch (const MeshError& error)
  {
    numbers.fail(error.what());
  }
  if (numbers.offset() < file.size())
  {
    file.fail(
      numbers.offset(), "there is more after the last face: the counts at the beginning are wrong");
  }
}

} // namespace smg
