// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Blending/PatchLabels.h"

#include <cstdint>
#include <span>

namespace smg
{

/** The patch and the values of each open vertex of a mesh stream: one that a later cell may use. */
class PatchedValues
{
public:
  /** For `columns` values a vertex. */
  PatchedValues(PatchLabels& labels, int columns)
    : Patches(labels)
    , Labels(labels.memory())
    , Values(labels.memory(), columns)
  {
  }

  /** Takes the vertices of the next block; the first block restarts it. Returns their values, to
   * be set. */
  std::span<double> startBlock(const MeshBlock& block)
  {
    if (block.firstVertex == 0)
    {
      this->Labels.restart();
      this->Values.restart();
      this->Finalized = 0;
    }
    this->Labels.release(this->Finalized);
    this->Values.release(this->Finalized);
    this->Finalized = block.finalized;
    this->Patches.read(block, this->Labels.append(block.vertices()));
    return this->Values.append(block.vertices());
  }

  /** The values of an open vertex. */
  const double* at(std::int64_t vertex) const { return this->Values.at(vertex); }

  bool inOnePatch(std::int64_t a, std::int64_t b) const
  {
    return *this->Labels.at(a) == *this->Labels.at(b);
  }
  /** Whether a cell with these corners is in one patch. */
  bool inOnePatch(std::span<const std::int64_t> corners) const
  {
    bool is = true;
    for (const std::int64_t corner : corners)
    {
      is = is && this->inOnePatch(corners[0], corner);
    }
    return is;
  }

private:
  PatchLabels& Patches;
  OpenValues<double> Labels, Values;
  std::int64_t Finalized = 0; ///< of the previous block
};

} // namespace smg
