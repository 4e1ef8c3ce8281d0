// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/WriteVtkXml.h"

#include "IO/Files/Suffix.h"
#include "IO/Formats/Vtk/VtkXmlFile.h"
#include "IO/Import/OtherCounts.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include <cstdint>
#include <vector>

namespace smg
{

void writeVtkXml(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamInfo& info = source.info();
  if (info.cellType == CellType::Tetrahedron && lowerSuffix(path) == ".vtp")
  {
    throw Error(path.string() + ": a .vtp file holds no tetrahedra: choose .vtu.");
  }
  Progress reported(progress);
  const auto corners = static_cast<std::uint32_t>(cornersOf(info.cellType));
  VtkXmlFile file(path, { info.cellType, info.doublePositions, info.vertices, info.cells,
                          info.cells * corners, info.vertexColumns, info.cellColumns });
  std::int64_t vertices = 0, cells = 0;
  std::vector<std::uint32_t> sizes;
  for (MeshBlock block; source.next(block);)
  {
    file.appendPoints(block.positions, block.vertexColumns);
    sizes.assign(block.corners.size() / corners, corners);
    file.appendCells(block.corners, sizes, block.cellColumns);
    vertices += block.vertices();
    cells += static_cast<std::int64_t>(sizes.size());
    const auto end =
      static_cast<double>(block.firstCell) + static_cast<double>(block.corners.size()) / corners;
    reported.update(end / static_cast<double>(info.cells));
  }
  if (vertices != info.vertices || cells != info.cells)
  {
    throw Error(otherCounts(path.string(), info));
  }
  file.finish();
}

} // namespace smg
