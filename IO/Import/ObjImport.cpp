// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CellCollector.h"
#include "IO/Import/Formats.h"
#include "IO/Import/TextScanner.h"

#include <cstring>

namespace smg
{

namespace
{

/** Counts the lines that begin with `v ` and `f `, for the memory they will take. */
MeshSizes countLines(InputFile& file)
{
  MeshSizes sizes;
  const char* at = file.begin();
  while (at < file.end())
  {
    while (at < file.end() && (*at == ' ' || *at == '\t'))
    {
      ++at;
    }
    if (file.end() - at > 1 && (at[1] == ' ' || at[1] == '\t'))
    {
      sizes.vertices += *at == 'v';
      sizes.cells += *at == 'f';
    }
    const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(file.end() - at));
    at = newline ? static_cast<const char*>(newline) + 1 : file.end();
  }
  return sizes;
}

/** Reads the lines of an OBJ file. */
class ObjReader
{
public:
  explicit ObjReader(InputFile& file)
    : Scanner(file, '#')
  {
  }

  IndexedMesh read(const MeshSizes& sizes)
  {
    this->Mesh.positions.reserve(static_cast<std::size_t>(sizes.vertices) * 3);
    this->Cells.reserve(sizes.cells, 0);
    while (!this->Scanner.atEnd())
    {
      const std::string_view keyword = this->Scanner.tokenInLine();
      if (keyword == "v")
      {
        this->readVertex();
      }
      else if (keyword == "f")
      {
        this->readFace();
      }
      this->Scanner.skipLine();
    }
    if (this->LargestCorner >= this->Mesh.vertices())
    {
      this->Scanner.failAt(
        this->LargestLine, "the face names vertex " + std::to_string(this->LargestCorner + 1) +
                             ", but the file has " + std::to_string(this->Mesh.vertices()));
    }
    this->Cells.finish(this->Mesh);
    return std::move(this->Mesh);
  }

private:
  void readVertex()
  {
    for (const char* what : { "the coordinate x", "the coordinate y", "the coordinate z" })
    {
      this->Mesh.positions.push_back(this->Scanner.toNumber(this->Scanner.tokenInLine(), what));
    }
  }

  /** A token of a face's line; a backslash at the end of a line continues it. */
  std::string_view faceToken()
  {
    std::string_view token = this->Scanner.tokenInLine();
    while (token == "\\")
    {
      this->Scanner.skipLine();
      token = this->Scanner.tokenInLine();
    }
    return token;
  }

  void readFace()
  {
    this->Polygon.clear();
    for (std::string_view token = this->faceToken(); !token.empty(); token = this->faceToken())
    {
      const std::int64_t number =
        this->Scanner.toInteger(token.substr(0, token.find('/')), "a vertex of a face");
      const std::int64_t corner = number < 0 ? this->Mesh.vertices() + number : number - 1;
      if (number == 0 || corner < 0)
      {
        this->Scanner.fail("a face names vertex " + std::to_string(number) + ", where " +
                           std::to_string(this->Mesh.vertices()) + " vertices have come so far");
      }
      if (corner > this->LargestCorner)
      {
        this->LargestCorner = corner;
        this->LargestLine = this->Scanner.line();
      }
      this->Polygon.push_back(corner);
    }
    if (this->Polygon.size() < 3)
    {
      this->Scanner.fail("a face has fewer than three vertices");
    }
    this->Cells.polygon(this->Polygon);
  }

  TextScanner Scanner;
  IndexedMesh Mesh;
  CellCollector Cells;
  std::vector<std::int64_t> Polygon;
  std::int64_t LargestCorner = -1;
  std::int64_t LargestLine = 0;
};

} // namespace

IndexedMesh importObj(InputFile& file, const ImportOptions& options)
{
  const MeshSizes sizes = countLines(file);
  options.budget.check(file.path(), sizes);
  return ObjReader(file).read(sizes);
}

} // namespace smg
