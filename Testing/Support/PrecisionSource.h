// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/MemorySource.h"

namespace smg::testing
{

/** A source that declares its positions as single or double precision. */
class PrecisionSource : public MeshSource
{
public:
  PrecisionSource(const StreamMesh& mesh, std::int64_t blockCells, bool doublePositions)
    : Source(mesh, blockCells)
    , Info(this->Source.info())
  {
    this->Info.doublePositions = doublePositions;
  }

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override { return this->Source.next(block); }

private:
  MemorySource Source;
  StreamInfo Info;
};

} // namespace smg::testing
