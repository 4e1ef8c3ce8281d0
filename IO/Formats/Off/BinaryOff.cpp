// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Off/BinaryOff.h"

#include "IO/Files/BinaryInput.h"
#include "IO/Import/ImportColumn.h"

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

/** The number of values after the coordinates of a vertex. */
std::size_t furtherNumbers(const OffHeader& header)
{
  return (header.normals ? 3 : 0) + (header.colors ? 4 : 0) + (header.textureCoordinates ? 2 : 0);
}

void readVertices(BinaryInput& input, const OffHeader& header, RawMeshBuilder& builder)
{
  OffAttributes attributes(header, builder);
  std::array<double, 9> further{};
  const std::span used = std::span(further).first(furtherNumbers(header));
  builder.useSinglePrecision();
  std::int64_t vertex = 0;
  try
  {
    for (; vertex < header.vertices; ++vertex)
    {
      const double x = input.take<float>();
      const double y = input.take<float>();
      const double z = input.take<float>();
      builder.vertex(x, y, z);
      for (double& number : used)
      {
        number = input.take<float>();
        if (!std::isfinite(number))
        {
          throw MeshError("a number behind its coordinates is not finite");
        }
      }
      attributes.add(used);
    }
  }
  catch (const MeshError& error)
  {
    throw MeshError("vertex " + std::to_string(vertex) + ": " + error.what());
  }
  attributes.finish();
}

void readFaces(BinaryInput& input, const OffHeader& header, RawMeshBuilder& builder)
{
  TextColors colors(builder, ColumnOf::Elements);
  std::array<double, 4> color{};
  for (std::int64_t i = 0; i < header.faces; ++i)
  {
    const auto corners = input.take<std::int32_t>();
    input.requireRoom(corners, NumberBytes, "the number of corners of a face");
    for (std::int32_t k = 0; k < corners; ++k)
    {
      builder.fanCorner(input.take<std::int32_t>());
    }
    builder.endTriangles();
    const auto components = input.take<std::int32_t>();
    if (components < 0 || components > 4)
    {
      throw MeshError("a colour has at most 4 numbers, not " + std::to_string(components));
    }
    const std::span used = std::span(color).first(static_cast<std::size_t>(components));
    for (double& number : used)
    {
      number = input.take<float>();
    }
    colors.add(used);
  }
  colors.finish();
}

} // namespace

void readBinaryOffCounts(InputFile& file, OffHeader& header)
{
  BinaryInput input(file, header.body, std::endian::big);
  input.locateErrors(
    [&]
    {
      header.vertices = input.take<std::int32_t>("the number of vertices");
      header.faces = input.take<std::int32_t>("the number of faces");
      input.take<std::int32_t>("the number of edges");
      const std::size_t vertexBytes = NumberBytes * (3 + furtherNumbers(header));
      input.requireRoom(header.vertices, vertexBytes, "the number of vertices");
      input.requireRoom(header.faces, 2 * NumberBytes, "the number of faces");
    });
  header.body = input.offset();
}

void readBinaryOff(InputFile& file, const OffHeader& header, RawMeshBuilder& builder)
{
  BinaryInput input(file, header.body, std::endian::big);
  input.locateErrors(
    [&]
    {
      readVertices(input, header, builder);
      readFaces(input, header, builder);
      if (input.left() > 0)
      {
        throw MeshError("there is more after the last face: the counts at the beginning are wrong");
      }
    });
}

} // namespace smg
