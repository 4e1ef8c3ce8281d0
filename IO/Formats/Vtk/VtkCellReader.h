// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkArrayReader.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Import/RawMeshBuilder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** Reads a list of cells sequentially. */
class VtkCellReader
{
public:
  /** The maximum number of points of a cell other than points and lines. */
  static constexpr std::int64_t MaxPoints = std::int64_t(1) << 20;

  /** `takesLines`: also points and lines, up to MaxPoints points of each. */
  VtkCellReader(VtkFiles& files, std::size_t file, const VtkCellList& list, Workspace& workspace,
    bool takesLines);

  /** The points of the next cell, valid until the next call; none for points and lines that are not
   * taken. Throws Error if the list is invalid. */
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
  bool TakesLines;
  std::optional<VtkIndexReader> Points, Offsets, Types;
  std::int64_t Last = 0; ///< end of the last cell
};

/** Converts `count` scalars of the file to the column type of the array. */
void convertVtkScalars(
  const VtkArray& array, const std::byte* from, std::size_t count, std::byte* to);

/** Reads tuples of a column in chunks and passes those for which `stays` is true to `take`. */
void copyVtkTuples(
  VtkArrayReader& reader, std::int64_t tuples, const auto& stays, bool allStay, const auto& take)
{
  const VtkArray& array = reader.array();
  const auto components = static_cast<std::size_t>(array.components);
  const std::size_t tupleBytes = components * sizeOf(array.columnType);
  const std::size_t chunk = std::max<std::size_t>(std::size_t(1 << 16) / (components * 8), 1);
  const bool converts = array.type != array.columnType;
  std::vector<std::byte> read(chunk * components * sizeOf(array.type));
  std::vector<std::byte> converted(converts ? chunk * tupleBytes : 0);
  for (std::int64_t left = tuples; left > 0;)
  {
    const auto count =
      static_cast<std::size_t>(std::min<std::int64_t>(left, static_cast<std::int64_t>(chunk)));
    reader.read(read.data(), count * components);
    std::byte* values = read.data();
    if (converts)
    {
      convertVtkScalars(array, read.data(), count * components, converted.data());
      values = converted.data();
    }
    std::size_t kept = allStay ? count : 0;
    for (std::size_t i = 0; i < count && !allStay; ++i)
    {
      if (stays())
      {
        std::memmove(values + kept++ * tupleBytes, values + i * tupleBytes, tupleBytes);
      }
    }
    take(std::span<const std::byte>(values, kept * tupleBytes));
    left -= static_cast<std::int64_t>(count);
  }
}

/**
 * Merges points of several pieces with the same global number; the first one is kept. Out of core.
 */
class VtkPointMerger
{
public:
  /** Whether there are several pieces and all have the global numbers of their points. */
  static bool applies(const VtkLayout& layout);

  /** Reads the global numbers and passes the merged numbers of the points to the builder. Throws
   * Error if the files are invalid. */
  VtkPointMerger(VtkFiles& files, const VtkLayout& layout, RawMeshBuilder& builder);

  /** Iterates over the points of all pieces and returns for each whether it is kept. */
  class Walk
  {
  public:
    explicit Walk(const VtkPointMerger& merger)
      : Merged(merger.Merged)
    {
      this->More = this->Merged.next(this->Next);
    }
    /** Whether the next point is kept. */
    bool next()
    {
      const bool stays = !this->More || this->Next != this->Point;
      ++this->Point;
      this->More = stays ? this->More : this->Merged.next(this->Next);
      return stays;
    }

  private:
    RecordFile<std::uint32_t>::Reader Merged;
    std::uint32_t Next = 0, Point = 0;
    bool More = false;
  };

private:
  RecordFile<std::uint32_t> Merged; ///< points that are not kept, ascending
};

} // namespace smg
