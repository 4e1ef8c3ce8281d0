// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkCellParts.h"

#include "IO/External/Workspace.h"
#include "IO/Formats/Vtk/VtkCell.h"
#include "smg/Error.h"

#include <numeric>
#include <string>

namespace smg
{
namespace
{

/** Memory for the parts on their way; more go through scratch files. */
constexpr std::int64_t Memory = std::int64_t(64) << 20;

std::vector<std::int64_t> numbersIn(RecordFile<std::uint32_t>& file)
{
  std::vector<std::int64_t> numbers;
  numbers.reserve(static_cast<std::size_t>(file.size()));
  RecordFile<std::uint32_t>::Reader reader(file);
  for (std::uint32_t number = 0; reader.next(number);)
  {
    numbers.push_back(number);
  }
  return numbers;
}

} // namespace

VtkCellParts cutVtkCells(std::int64_t points, std::int64_t cells, CellChoice choice,
  const VtkCellAt& at, const std::filesystem::path& scratch)
{
  std::vector<std::int64_t> ofCell;
  Workspace space(scratch, Memory);
  RawMeshBuilder builder(space, choice);
  for (std::int64_t point = 0; point < points; ++point)
  {
    builder.vertex(0.0, 0.0, 0.0);
  }
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    try
    {
      const int type = at(cell, ofCell);
      takeVtkCell(type, ofCell, builder);
    }
    catch (const MeshError& error)
    {
      throw Error("The input: cell " + std::to_string(cell) + ": " + error.what() + '.');
    }
  }
  try
  {
    RawMesh mesh = builder.finish();
    VtkCellParts parts{ mesh.cellType, numbersIn(mesh.corners), numbersIn(mesh.elements) };
    if (parts.cellOf.empty())
    {
      parts.cellOf.resize(static_cast<std::size_t>(mesh.cells));
      std::iota(parts.cellOf.begin(), parts.cellOf.end(), 0);
    }
    return parts;
  }
  catch (const MeshError& error)
  {
    throw Error("The input: " + std::string(error.what()) + '.');
  }
}

} // namespace smg
