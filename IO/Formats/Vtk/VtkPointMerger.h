// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkFiles.h"
#include "IO/Import/RawMeshBuilder.h"

#include <cstdint>
#include <optional>

namespace smg
{

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
