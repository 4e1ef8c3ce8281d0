// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkArrayReader.h"
#include "IO/Formats/Vtk/VtkFiles.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace smg
{

/** Reads a list of cells sequentially. */
class VtkCellReader
{
public:
  /** The maximum number of points of a cell other than points and lines. */
  static constexpr std::int64_t MostPoints = std::int64_t(1) << 20;

  VtkCellReader(VtkFiles& files, std::size_t file, const VtkCellList& list, Workspace& workspace);

  /** The points of the next cell, valid until the next call; none for points and lines. Throws
   * Error if the list is invalid. */
  std::span<const std::int64_t> next();
  /** VTK's type of that cell. */
  int type() const { return this->Type; }
  /** Throws Error if there are more numbers than the cells take. */
  void finish();

private:
  std::int64_t nextSize();

  std::int64_t Cells;
  std::int64_t Cell = 0; ///< the next one
  int Type;
  std::optional<VtkIndexReader> Points, Offsets, Types;
  std::int64_t Last = 0; ///< end of the last cell
};

} // namespace smg
