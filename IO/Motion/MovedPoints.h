// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/** A mesh stream with the positions of a solution of three columns, rounded to the precision of the
 * stream. The bounds of its info are unknown. */
class SMG_EXPORT MovedPoints : public MeshSource
{
public:
  /** The positions must outlive this object. */
  MovedPoints(std::unique_ptr<MeshSource> source, Solution& positions);

  const StreamInfo& info() const override { return this->Info; }

  /** Throws Error if a position is not finite in the stream's precision. */
  bool next(MeshBlock& block) override;

private:
  std::unique_ptr<MeshSource> Source;
  StreamInfo Info;
  Solution& Positions;
};

} // namespace smg
