// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/ReadStream.h"

#include "IO/Import/RawMeshBuilder.h"
#include "smg/Error.h"

#include <string>

namespace smg
{

RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace)
{
  const StreamInfo& info = source.info();
  const bool triangles = info.cellType == CellType::Triangle;
  RawMeshBuilder builder(workspace, CellChoice::Only);
  if (!info.doublePositions)
  {
    builder.useSinglePrecision();
  }
  std::vector<int> vertexColumns, cellColumns;
  for (const ColumnSpec& spec : info.vertexColumns)
  {
    vertexColumns.push_back(builder.addVertexColumn(spec));
  }
  for (const ColumnSpec& spec : info.cellColumns)
  {
    cellColumns.push_back(spec.name == CellFlagsName ? -1 : builder.addElementColumn(spec));
  }
  try
  {
    for (MeshBlock block; source.next(block);)
    {
      for (std::size_t i = 0; i < block.positions.size(); i += 3)
      {
        builder.vertex(block.positions[i], block.positions[i + 1], block.positions[i + 2]);
      }
      for (std::size_t c = 0; c < vertexColumns.size(); ++c)
      {
        builder.vertexTuples(vertexColumns[c], block.vertexColumns[c].bytes);
      }
      const std::int64_t* corner = block.corners.data();
      const std::int64_t* const end = corner + block.corners.size();
      for (; corner != end; corner += triangles ? 3 : 4)
      {
        triangles ? builder.triangle(corner[0], corner[1], corner[2])
                  : builder.tetrahedron(corner[0], corner[1], corner[2], corner[3]);
      }
      for (std::size_t c = 0; c < cellColumns.size(); ++c)
      {
        builder.elementTuples(cellColumns[c], block.cellColumns[c].bytes);
      }
    }
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw Error(name + ": the stream cannot be brought into another order: " + error.what() + '.');
  }
}

} // namespace smg
