// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkCellReader.h"

#include "IO/Formats/Vtk/VtkCell.h"

#include <string>

namespace smg
{

VtkCellReader::VtkCellReader(
  VtkFiles& files, std::size_t file, const VtkCellList& list, Workspace& workspace)
  : Cells(list.cells)
  , Type(list.type)
{
  if (list.cells == 0)
  {
    return;
  }
  this->Points.emplace(files.open(file, VtkFiles::Main), *list.points, workspace);
  if (list.offsets)
  {
    this->Offsets.emplace(files.open(file, VtkFiles::Offsets), *list.offsets, workspace);
    if (list.offsets->values == list.cells + 1 && this->Offsets->next() != 0)
    {
      this->Offsets->fail("should begin with 0");
    }
  }
  if (list.types)
  {
    this->Types.emplace(files.open(file, VtkFiles::Types), *list.types, workspace);
  }
}

std::int64_t VtkCellReader::nextSize()
{
  if (!this->Offsets)
  {
    const std::int64_t size = this->Points->next();
    if (size < 0)
    {
      this->Points->fail("says that cell " + std::to_string(this->Cell) + " has " +
                         std::to_string(size) + " points");
    }
    return size;
  }
  const std::int64_t end = this->Offsets->next();
  if (end < this->Last)
  {
    this->Offsets->fail("says that cell " + std::to_string(this->Cell) + " ends at " +
                        std::to_string(end) + ", before it begins");
  }
  const std::int64_t size = end - this->Last;
  this->Last = end;
  return size;
}

std::span<const std::int64_t> VtkCellReader::next()
{
  if (this->Types)
  {
    const std::int64_t type = this->Types->next();
    this->Type = type >= 0 && type < 256 ? static_cast<int>(type) : 255;
  }
  const std::int64_t size = this->nextSize();
  if (isPointOrLine(this->Type))
  {
    this->Points->skip(size);
    ++this->Cell;
    return {};
  }
  if (size > MostPoints)
  {
    this->Points->fail("has a cell, number " + std::to_string(this->Cell) + ", of " +
                       std::to_string(size) + " points; at most " + std::to_string(MostPoints) +
                       " are read");
  }
  ++this->Cell;
  return this->Points->next(static_cast<std::size_t>(size));
}

void VtkCellReader::finish()
{
  if (this->Points && !this->Points->atEnd())
  {
    this->Points->fail("has more numbers than its cells take: a count is wrong");
  }
  if (this->Offsets && !this->Offsets->atEnd())
  {
    this->Offsets->fail("has more numbers than there are cells: a count is wrong");
  }
}

} // namespace smg
