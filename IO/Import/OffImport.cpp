// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Formats.h"
#include "IO/Import/OffHeader.h"
#include "IO/Import/TextScanner.h"
#include "IO/Import/TriangleRuns.h"

#include <string>

namespace smg
{

namespace
{

/** Passes the keyword, if there is one, and refuses what is not a text in three dimensions. */
void readKeyword(TextScanner& scanner)
{
  const std::string keyword(scanner.peek());
  if (!keyword.ends_with("OFF"))
  {
    return;
  }
  if (keyword.find_first_of("4n") != std::string::npos)
  {
    scanner.fail("the vertices of a " + inQuotes(keyword) + " file are not points of space");
  }
  scanner.tokenInLine();
  if (scanner.peek() == "BINARY")
  {
    scanner.fail("binary OFF files are not read: write it as text, or as PLY");
  }
}

void readVertices(TextScanner& scanner, std::int64_t vertices, RawMeshBuilder& builder)
{
  for (std::int64_t i = 0; i < vertices; ++i)
  {
    const double x = scanner.number("the coordinate x of a vertex");
    const double y = scanner.number("the coordinate y of a vertex");
    const double z = scanner.number("the coordinate z of a vertex");
    builder.vertex(x, y, z);
    scanner.skipLine();
  }
}

void readFaces(
  TextScanner& scanner, std::int64_t faces, std::int64_t vertices, RawMeshBuilder& builder)
{
  TriangleFan fan(builder);
  for (std::int64_t i = 0; i < faces; ++i)
  {
    const std::int64_t corners = scanner.count("the number of corners of a face", 2);
    for (std::int64_t k = 0; k < corners; ++k)
    {
      const std::int64_t corner = scanner.integer("a corner of a face");
      if (corner < 0 || corner >= vertices)
      {
        scanner.fail("the corner " + std::to_string(corner) + " is none of the " +
                     std::to_string(vertices) + " vertices");
      }
      fan.corner(corner);
    }
    fan.end();
    scanner.skipLine();
  }
}

} // namespace

OffHeader readOffHeader(TextScanner& scanner)
{
  readKeyword(scanner);
  OffHeader header;
  header.vertices = scanner.count("the number of vertices", 6);
  header.faces = scanner.count("the number of faces", 2);
  scanner.integer("the number of edges");
  return header;
}

void importOff(InputFile& file, RawMeshBuilder& builder)
{
  TextScanner scanner(file, '#');
  const auto [vertices, faces] = readOffHeader(scanner);
  try
  {
    readVertices(scanner, vertices, builder);
    readFaces(scanner, faces, vertices, builder);
    if (!scanner.atEnd())
    {
      scanner.fail("there is more after the last face: the counts at the beginning are wrong");
    }
  }
  catch (const MeshError& error)
  {
    scanner.fail(error.what());
  }
}

} // namespace smg
