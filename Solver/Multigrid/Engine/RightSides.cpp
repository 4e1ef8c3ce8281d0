// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/RightSides.h"

#include <algorithm>
#include <cstddef>
#include <span>

// A problem whose right-hand side is given on the rows of an earlier one begins as if it had been
// assembled: the same terms in the same order, and so the same bits.

namespace smg
{
static_assert(RowBlock::Nodes == static_cast<std::int64_t>(ComponentLabels::Block));

std::int64_t RightSides::Block::bytes() const
{
  return static_cast<std::int64_t>(sizeof(Block) + this->links.capacity() * sizeof(this->links[0]) +
                                   this->known.capacity() * sizeof(this->known[0]) +
                                   this->shares.capacity() * sizeof(this->shares[0]) +
                                   this->runs.capacity() * sizeof(this->runs[0]));
}

/** The block of the next vertex. */
auto RightSides::block() -> Block&
{
  if (this->Vertices == static_cast<std::int64_t>(this->Blocks.size()) * RowBlock::Nodes)
  {
    this->Blocks.emplace_back();
  }
  return this->Blocks.back();
}

void RightSides::link(std::int32_t delta, double weight)
{
  this->block().links.push_back(
    { static_cast<std::int32_t>(this->Vertices % RowBlock::Nodes), delta, weight });
}

void RightSides::unknown(double share, std::int32_t label)
{
  this->IsUnknown = true;
  Block& block = this->block();
  const auto node = static_cast<std::size_t>(this->Vertices % RowBlock::Nodes);
  if (share != 1.0 && block.shares.empty())
  {
    block.shares.assign(static_cast<std::size_t>(RowBlock::Nodes), 1.0);
  }
  if (!block.shares.empty())
  {
    block.shares[node] = share;
  }
  if (block.runs.empty() || block.runs.back().label != label)
  {
    block.runs.push_back({ static_cast<std::int16_t>(node), label });
  }
}

/** Completes the next vertex, and the block that ends with it. */
void RightSides::close(const double* /*point*/, std::int64_t /*reach*/)
{
  Block& block = this->block();
  if (!this->IsUnknown)
  {
    block.known.push_back(static_cast<std::int16_t>(this->Vertices % RowBlock::Nodes));
  }
  this->IsUnknown = false;
  if (++this->Vertices % RowBlock::Nodes == 0)
  {
    this->Memory.resize(this->Memory.bytes() + block.bytes());
  }
}

void RightSides::setKnown(LevelWindow<double>& finest) const
{
  for (std::size_t n = 0; n < this->Blocks.size(); ++n)
  {
    for (const std::int16_t node : this->Blocks[n].known)
    {
      const std::int64_t i = static_cast<std::int64_t>(n) * RowBlock::Nodes + node;
      std::copy_n(finest.b().at(i), finest.stride(), finest.x().at(i));
    }
  }
}

void RightSides::addKnown(LevelWindow<double>& finest) const
{
  for (std::size_t n = 0; n < this->Blocks.size(); ++n)
  {
    addKnownValues(static_cast<std::int64_t>(n) * RowBlock::Nodes, std::span(this->Blocks[n].links),
      finest.columns(), finest.x(), finest.b(), [](std::int64_t) {});
  }
}

InitialResidual RightSides::residual(
  LevelWindow<double>& finest, Components& components, ComponentLabels& labels) const
{
  InitialResidual sum(finest.columns());
  finest.forRange(0, finest.nodes(), finest.up(),
    [&](const auto& rows, const BlockPart<double>& part)
    { this->addRows(rows, part, sum, components, labels); });
  return sum;
}

/** Adds the rows of a block. */
template <class Arrays>
void RightSides::addRows(const Arrays& rows, const BlockPart<double>& part, InitialResidual& sum,
  Components& components, ComponentLabels& labels) const
{
  const RowBlock::Header& h = part.header();
  const std::int64_t number = h.first / RowBlock::Nodes;
  const Block& block = this->Blocks[static_cast<std::size_t>(number)];
  auto known = block.known.begin();
  auto run = block.runs.begin();
  const auto add = [&](const auto& arrays, std::int64_t k)
  {
    if (known != block.known.end() && *known == k)
    {
      ++known;
      return;
    }
    while (run + 1 != block.runs.end() && (run + 1)->begin <= k)
    {
      ++run;
    }
    const double* x = part.x + k * part.stride;
    const double* b = part.b + k * part.stride;
    const RowView row(h, arrays, k);
    const double share = block.shares.empty() ? 1.0 : block.shares[static_cast<std::size_t>(k)];
    const std::span<const double> residual = sum.add(row, x, b, part.stride, share);
    if (run->label < 0)
    {
      return;
    }
    const bool floats = components.isFloating(components.root(run->label));
    const double mass = floats ? labels.block(number).masses[static_cast<std::size_t>(k)] : 0.0;
    sum.varying.add(run->label, RowBlock::rowSumOf(h, arrays, k), mass, b, share);
    if (floats)
    {
      components.count(run->label, b, x, residual.data(), mass);
    }
  };
  forRuns<double>(h, rows, part.nodes,
    [&](const auto& arrays, BlockRange nodes, auto /*isSpecial*/)
    {
      for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
      {
        add(arrays, k);
      }
    });
}

} // namespace smg
