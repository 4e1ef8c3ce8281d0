// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <cstdint>

class vtkDataObject;

namespace smg
{

class PieceInput;

/** In how many pieces an input is requested: a given number, or one for which pieces are small. */
struct VTKSTREAMINGMULTIGRIDIO_EXPORT PieceCount
{
  static constexpr int Usual = 64;
  static constexpr int Most = 1000000;

  int given = 0;                                            ///< 0: chosen
  std::int64_t pieceBytes = std::int64_t(64) * 1024 * 1024; ///< most of a VTK data object
  int least = Usual;                                        ///< the smallest number that is chosen

  /** `given` pieces; 0: as many as a program with this memory limit (bytes) can afford. */
  static PieceCount within(int given, std::int64_t memoryLimit);

  /** The number for an input whose pieces have not been seen: from the size of its mesh, if it is
   * that of a .vsm file; else Usual. */
  int first(PieceInput& input) const;

  /** The number for an input of which this is one of `pieces` pieces. */
  int enough(int pieces, vtkDataObject& piece) const;
};

} // namespace smg
