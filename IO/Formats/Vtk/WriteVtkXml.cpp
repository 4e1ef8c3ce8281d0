// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/WriteVtkXml.h"

#include "IO/Formats/Vtk/VtkXmlFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

namespace
{

/** Writes the cells of a block, which all have the same number of corners. */
class CellBlocks
{
public:
  explicit CellBlocks(CellType type)
    : Type(type)
  {
  }

  void append(const MeshBlock& block, VtkXmlFile& file)
  {
    const std::int64_t corners = cornersOf(this->Type);
    this->Ends.resize(block.corners.size() / static_cast<std::size_t>(corners));
    for (std::size_t i = 0; i < this->Ends.size(); ++i)
    {
      this->Ends[i] = corners * (block.firstCell + static_cast<std::int64_t>(i) + 1);
    }
    this->Kinds.assign(this->Ends.size(),
      this->Type == CellType::Triangle ? VtkXmlFile::Triangle : VtkXmlFile::Tetrahedron);
    file.appendCells(block.corners, this->Ends, this->Kinds, block.cellColumns);
  }

private:
  CellType Type;
  std::vector<std::int64_t> Ends;
  std::vector<std::uint8_t> Kinds;
};

VtkXmlContent contentOf(const StreamInfo& info)
{
  return { info.doublePositions, info.vertices, info.cells, info.cells * cornersOf(info.cellType),
    info.vertexColumns, info.cellColumns };
}

} // namespace

void writeVtkXml(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamInfo& info = source.info();
  Progress reported(progress);
  VtkXmlFile file(path, contentOf(info));
  CellBlocks cells(info.cellType);
  for (MeshBlock block; source.next(block);)
  {
    file.appendPoints(block.positions, block.vertexColumns);
    cells.append(block, file);
    const auto end = static_cast<double>(block.firstCell) +
                     static_cast<double>(block.corners.size()) / cornersOf(info.cellType);
    reported.update(end / static_cast<double>(info.cells));
  }
  file.finish();
}

} // namespace smg
