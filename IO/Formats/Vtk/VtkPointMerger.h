// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkFiles.h"
#include "IO/Raw/RawMeshBuilder.h"

#include <cstdint>
#include <optional>

namespace smg
{

/**
 * Points of several pieces that are one point of the mesh: those with the same global number, of
 * which the first one stays. Everything is out of core.
 */
class VtkPointMerger
{
public:
  /** Whether all pieces tell the global numbers of their points, and there are several pieces. */
  static bool applies(const VtkLayout& layout);

  /**
   * Reads the global numbers and tells the builder what the points become. Throws Error where the
   * files are wrong.
   */
  VtkPointMerger(VtkFiles& files, const VtkLayout& layout, RawMeshBuilder& builder);

  /** Goes through the points of all pieces: tells of each whether it stays. */
  class Walk
  {
  public:
    explicit Walk(const VtkPointMerger& merger)
      : Merged(merger.Merged)
    {
      this->More = this->Merged.next(this->Next);
    }
    /** Whether the next point stays. */
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
  RecordFile<std::uint32_t> Merged; ///< points that do not stay, ascending
};

} // namespace smg
