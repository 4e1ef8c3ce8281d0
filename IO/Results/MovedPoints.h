// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Results/InvertedCells.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/MovedMesh.h"
#include "smg/Solve.h"

#include <memory>
#include <optional>
#include <vector>

namespace smg
{

/** A mesh stream with the positions of a solution of three columns, rounded to the precision of the
 * stream. The bounds of its info are unknown. */
class SMG_EXPORT MovedPoints : public MeshSource
{
public:
  /** The positions must outlive this object, and so must `report`, if it is given: at the end of
   * the stream, it gets the cells that the motion inverts (see InvertedCells, with `options`). */
  MovedPoints(std::unique_ptr<MeshSource> source, Solution& positions, Report* report = nullptr,
    const NormalsOptions& options = {});

  const StreamInfo& info() const override { return this->Info; }

  /** Throws Error if a position is not finite in the stream's precision. */
  bool next(MeshBlock& block) override;

private:
  std::unique_ptr<MeshSource> Source;
  StreamInfo Info;
  Solution& Positions;
  Report* Judged;
  std::optional<InvertedCells> Inverted; ///< until the end of the stream, if there is a report
  std::vector<double> Rest;              ///< positions of a block
};

} // namespace smg
