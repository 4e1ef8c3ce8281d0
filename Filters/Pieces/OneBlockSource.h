// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <utility>

namespace smg
{

/** Delivers a mesh in one block. */
class OneBlockSource : public MeshSource
{
public:
  OneBlockSource(StreamInfo info, MeshBlock block)
    : Info(std::move(info))
    , Block(std::move(block))
  {
  }

  const StreamInfo& info() const override { return this->Info; }

  bool next(MeshBlock& block) override
  {
    if (std::exchange(this->IsDone, true))
    {
      return false;
    }
    block = std::move(this->Block);
    return true;
  }

private:
  StreamInfo Info;
  MeshBlock Block;
  bool IsDone = false;
};

} // namespace smg
