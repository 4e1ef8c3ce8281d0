// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyFormat.h"

#include "IO/Files/TextScanner.h"
#include "IO/Formats/Ply/PlyHeader.h"

#include <vector>

namespace smg
{

namespace
{

bool isPly(std::string_view start)
{
  const std::string_view bytes = withoutMark(start);
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

std::vector<ColumnSpec> plyColumns(const PlyElement& element, PlyRole role)
{
  std::vector<ColumnSpec> columns;
  planOf(element, role,
    [&columns](const ColumnSpec& column)
    {
      columns.push_back(column);
      return static_cast<int>(columns.size()) - 1;
    });
  return columns;
}

std::optional<FileCounts> countsOfPly(InputFile& file, const MeshPart&)
{
  FileCounts counts;
  counts.counted = true;
  double least = 0;
  for (const PlyElement& element : readPlyHeader(file).elements)
  {
    // Every property takes at least a byte: the length of a list, or the space after a number.
    least += static_cast<double>(element.count) * static_cast<double>(element.properties.size());
    if (least > static_cast<double>(file.size()))
    {
      return {};
    }
    if (element.name == "vertex")
    {
      const PlyProperty* const x = findNumber(element, "x");
      counts.mesh.vertices = element.count;
      counts.mesh.doublePositions = x && x->type == ScalarType::Float64;
      counts.mesh.vertexColumns = plyColumns(element, PlyRole::Vertices);
    }
    else if (element.name == "face")
    {
      counts.mesh.cells = element.count;
      counts.mesh.cellColumns = plyColumns(element, PlyRole::Cells);
    }
  }
  return counts;
}

constexpr FileSuffix PlySuffixes[] = { { ".ply", true, false, FileForm::Either } };

} // namespace

const Format PlyFormat{
  .name = "PLY",
  .suffixes = PlySuffixes,
  .description = "text and binary of both byte orders",
  .cells = "triangles, polygons, strips",
  .holdsColumns = true,
  .isReadByVtk = true,
  .hasMagic = isPly,
  .alwaysHasMagic = true,
  .parse = parseWith<importPly>,
  .counts = countsOfPly,
  .bytes = bytesOfPly,
  .writer = makePlyWriter,
  .writeOrder = WriteOrder::Interleaved,
};

} // namespace smg
