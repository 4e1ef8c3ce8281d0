// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CellCollector.h"
#include "IO/Import/Formats.h"
#include "IO/Import/TextScanner.h"

namespace smg
{

namespace
{

/** Passes the keyword, if there is one, and refuses what is not a text in three dimensions. */
void readKeyword(TextScanner& scanner)
{
  const std::string_view keyword = scanner.peek();
  if (keyword.ends_with("OFF"))
  {
    if (keyword.find_first_of("4n") != std::string_view::npos)
    {
      scanner.fail("the vertices of a " + inQuotes(keyword) + " file are not points of space");
    }
    scanner.tokenInLine();
    if (scanner.peek() == "BINARY")
    {
      scanner.fail("binary OFF files are not read: write it as text, or as PLY");
    }
  }
}

void readVertices(TextScanner& scanner, std::int64_t vertices, IndexedMesh& mesh)
{
  mesh.positions.reserve(static_cast<std::size_t>(vertices) * 3);
  for (std::int64_t i = 0; i < vertices; ++i)
  {
    mesh.positions.push_back(scanner.number("the coordinate x of a vertex"));
    mesh.positions.push_back(scanner.number("the coordinate y of a vertex"));
    mesh.positions.push_back(scanner.number("the coordinate z of a vertex"));
    scanner.skipLine();
  }
}

void readFaces(TextScanner& scanner, std::int64_t faces, IndexedMesh& mesh)
{
  CellCollector cells;
  cells.reserve(faces, 0);
  std::vector<std::int64_t> polygon;
  for (std::int64_t i = 0; i < faces; ++i)
  {
    const std::int64_t corners = scanner.count("the number of corners of a face", 2);
    polygon.clear();
    for (std::int64_t k = 0; k < corners; ++k)
    {
      const std::int64_t corner = scanner.integer("a corner of a face");
      if (corner < 0 || corner >= mesh.vertices())
      {
        scanner.fail("the corner " + std::to_string(corner) + " is none of the " +
                     std::to_string(mesh.vertices()) + " vertices");
      }
      polygon.push_back(corner);
    }
    cells.polygon(polygon);
    scanner.skipLine();
  }
  cells.finish(mesh);
}

} // namespace

IndexedMesh importOff(InputFile& file, const ImportOptions& options)
{
  TextScanner scanner(file, '#');
  readKeyword(scanner);
  MeshSizes sizes;
  sizes.vertices = scanner.count("the number of vertices", 6);
  sizes.cells = scanner.count("the number of faces", 2);
  scanner.integer("the number of edges");
  options.budget.check(file.path(), sizes);
  IndexedMesh mesh;
  readVertices(scanner, sizes.vertices, mesh);
  readFaces(scanner, sizes.cells, mesh);
  return mesh;
}

} // namespace smg
