// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/LevelWindow.h"

#include <algorithm>
#include <string>

// What a checkpoint contains of a level, between two passes. Streamed levels have everything in
// scratch files in the folder of the checkpoint; only the places of the blocks are saved. Core
// levels are in memory: their rows are written to a file once, at the first save(), and their b
// with every state, since the core cycle computes x from it. All that is read is checked: counts,
// sizes and checksums.

namespace smg
{

template <class Real>
void LevelWindow<Real>::keepRows(const ScratchFolder& folder, ScratchTraffic& traffic)
{
  this->KeptRows.emplace(
    folder, "level" + std::to_string(this->Index) + ".core", traffic.add("rows", this->Index));
}

/** Calls f(begin, end, b) for every block of a level in memory; b has room for the right-hand
 * side of its nodes. */
template <class Real>
template <class F>
void LevelWindow<Real>::forBlocks(F&& f)
{
  for (std::int64_t begin = 0; begin < this->Nodes; begin += RowBlock::Nodes)
  {
    const std::int64_t end = std::min(this->Nodes, begin + RowBlock::Nodes);
    this->Packed.resize(static_cast<std::size_t>((end - begin) * this->Columns));
    f(begin, end, std::span<Real>(this->Packed));
  }
}

template <class Real>
void LevelWindow<Real>::save(StateWriter& state)
{
  state.part("window");
  state(this->Columns, this->Nodes);
  if (this->Rows)
  {
    this->Rows->save(state);
    this->Values->save(state);
    if (this->RightSide)
    {
      this->RightSide->save(state);
    }
    return;
  }
  if (!this->RowsAreKept)
  {
    this->KeptRows->startPass(true);
    for (const RowBlock& block : this->Blocks)
    {
      this->KeptRows->append(block.stored());
    }
    this->KeptRows->endPass();
    this->RowsAreKept = true;
  }
  this->KeptRows->save(state);
  this->forBlocks(
    [&](std::int64_t begin, std::int64_t end, std::span<Real> b)
    {
      this->pack(this->Now.b, this->Columns, begin, end, b.data());
      state.write(std::as_bytes(b));
    });
}

template <class Real>
void LevelWindow<Real>::load(StateReader& state)
{
  state.part("window");
  std::int64_t nodes = 0;
  state(this->Columns, nodes);
  state.require(nodes >= 0 && this->Columns > 0 && strideOf(this->Columns) == this->Stride);
  this->WrittenColumns = this->Columns;
  // Rounded up; none if the level has no nodes.
  const std::int64_t blocks = nodes / RowBlock::Nodes + (nodes % RowBlock::Nodes != 0 ? 1 : 0);
  const auto checkRows = [&](std::int64_t index, std::span<const std::byte> rows)
  {
    const std::int64_t first = index * RowBlock::Nodes;
    state.require(RowBlock::fits(rows, first, std::min(RowBlock::Nodes, nodes - first)));
  };
  if (!this->Rows)
  {
    this->KeptRows->load(state, blocks, checkRows);
    this->loadInMemory(state, nodes);
    return;
  }
  this->Nodes = nodes;
  this->Rows->load(state, blocks, checkRows);
  this->Values->load(state, blocks);
  if (this->RightSide)
  {
    this->RightSide->load(state, blocks);
  }
}

template <class Real>
void LevelWindow<Real>::loadInMemory(StateReader& state, std::int64_t nodes)
{
  this->KeptRows->startPass(false);
  while (this->Nodes < nodes)
  {
    this->append(this->readRows(*this->KeptRows, std::min(RowBlock::Nodes, nodes - this->Nodes)));
  }
  this->KeptRows->endPass();
  this->RowsAreKept = true;
  this->forBlocks(
    [&](std::int64_t begin, std::int64_t end, std::span<Real> b)
    {
      state.read(std::as_writable_bytes(b));
      this->unpack(this->Now.b, begin, end, b.data());
    });
}

} // namespace smg
