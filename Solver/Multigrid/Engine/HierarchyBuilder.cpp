// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/HierarchyBuilder.h"

#include "Solver/Multigrid/Cycle/RowBlockPacker.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace smg
{

namespace
{

/** The number of levels whose stages may be tasks of their own. */
constexpr int MaxPipelined = 3;

} // namespace

HierarchyBuilder::HierarchyBuilder(Pool& pool, const CompiledOperators& operators,
  LevelStorage& levels, int firstCore, SliverRows stiff, bool pipelined, CancelCheck& check)
  : Owner(pool)
  , Operators(operators)
  , Storage(levels)
  , FirstCore(firstCore)
  , PipelinedLevels(operators.canRunApart && pipelined ? std::min(MaxPipelined, firstCore) : 0)
  , Stiff(stiff)
  , Check(check)
{
  this->addRows();
  for (int l = 0; l < firstCore; ++l)
  {
    this->addStep();
  }
}

void HierarchyBuilder::begin()
{
  std::int64_t nodes = StepNodes;
  for (int l = 0; l < this->PipelinedLevels; ++l)
  {
    nodes = this->Steps[static_cast<std::size_t>(l)]->beginPipelined(nodes);
  }
}

void HierarchyBuilder::addStages(Schedule& schedule)
{
  using Step = LevelCoarsening;
  struct Part
  {
    const char* name;
    void (Step::*advance)();
    std::int64_t (Step::*cursor)() const;
  };
  constexpr Part Parts[] = {
    { "choose C-points, P0", &Step::advanceChoice, &Step::atInitial },
    { "relax P", &Step::advanceInterpolation, &Step::atInterpolation },
    { "A P", &Step::advanceProducts, &Step::atProduct },
    { "P^T A P", &Step::advanceGathering, &Step::atGathering },
    { "sparsify, finish rows", &Step::advanceCoarseRows, &Step::atFinish },
  };
  for (int l = 0; l < this->FirstCore; ++l)
  {
    const auto k = static_cast<std::size_t>(l);
    Step* step = this->Steps[k].get();
    const bool pipelined = l < this->PipelinedLevels;
    for (const Part part : Parts)
    {
      if (pipelined)
      {
        schedule.startChain();
        schedule.add({ part.name, l, 0.0, [step, part](bool) { (step->*part.advance)(); } });
      }
      schedule.trace().addStage(part.name, l, std::bind_front(part.cursor, step));
    }
    schedule.startChain();
    pipelined ? schedule.add({ "pack rows", l, 0.0, [this, l](bool) { this->pack(l); } })
              : schedule.add({ "coarsen", l, 0.0, [this, l](bool) { this->advanceLevel(l); } });
    schedule.trace().addStage("pack rows", l, [this, k] { return this->Packed[k]; });
    if (l > 0)
    {
      schedule.trace().addWindow(
        l, [this, k] { return this->Storage.coarse[k - 1]->window().first(); },
        [this, k] { return this->Rows[k]->end(); });
    }
  }
}

void HierarchyBuilder::handOver()
{
  for (int l = 0; l < this->FirstCore; ++l)
  {
    LevelCoarsening& step = *this->Steps[static_cast<std::size_t>(l)];
    if (l < this->PipelinedLevels)
    {
      step.release();
    }
    step.handOver();
    this->append(l);
  }
}

bool HierarchyBuilder::complete() const
{
  for (int l = 0; l < this->FirstCore; ++l)
  {
    const auto k = static_cast<std::size_t>(l);
    if (!this->Rows[k + 1]->Ended || this->Packed[k] < this->Rows[k]->end())
    {
      return false;
    }
  }
  return true;
}

int HierarchyBuilder::finish(const std::function<void(int)>& addLevel)
{
  for (int k = 0; k < this->FirstCore; ++k)
  {
    this->close(k);
  }
  int l = 1;
  for (;; ++l)
  {
    if (l >= this->FirstCore)
    {
      this->build(l);
    }
    if (this->nodes(l) <= CoarsestNodes || this->stalled(l))
    {
      break;
    }
    if (l >= this->FirstCore)
    {
      addLevel(l + 1);
    }
  }
  this->Storage.sizes.resize(static_cast<std::size_t>(l + 1));
  return l;
}

void HierarchyBuilder::advanceLevel(int l)
{
  const auto k = static_cast<std::size_t>(l);
  const std::int64_t end = this->Rows[k]->end();
  std::int64_t& rows = this->Advanced[k];
  // A few rows at a time, whose intermediate data are released before the next ones.
  do
  {
    rows = std::min(end, rows + RowBlock::Nodes);
    this->Steps[k]->advance(rows);
    this->pack(l);
  } while (rows < end);
}

void HierarchyBuilder::build(int l)
{
  this->addStep();
  for (std::int64_t end = RowBlock::Nodes; this->Packed.back() < this->nodes(l);
       end += RowBlock::Nodes)
  {
    this->Steps.back()->advance(end);
    this->pack(l);
    this->Steps.back()->handOver();
    this->append(l);
  }
  this->close(l);
}

std::int64_t HierarchyBuilder::nodes(int l) const
{
  const auto k = static_cast<std::size_t>(l);
  return k < this->Storage.sizes.size() ? this->Storage.sizes[k].nodes : this->Rows[k]->end();
}

bool HierarchyBuilder::stalled(int l) const
{
  return static_cast<double>(this->nodes(l)) >
         StalledShare * static_cast<double>(this->nodes(l - 1));
}

void HierarchyBuilder::close(int l)
{
  const auto k = static_cast<std::size_t>(l);
  this->Storage.sizes.push_back({ this->Rows[k]->end(), this->Rows[k]->nonzeros() });
  this->Storage.frozen += l > 0 ? this->Rows[k]->frozen() : 0;
  if (k < this->Steps.size())
  {
    this->Steps[k].reset();
  }
  this->Rows[k].reset();
  this->Buffers[k].clear();
}

void HierarchyBuilder::addRows()
{
  this->Rows.push_back(std::make_unique<LevelRows>(this->Owner));
  this->Buffers.emplace_back(this->Owner);
  this->Ready.emplace_back();
}

void HierarchyBuilder::addStep()
{
  this->addRows();
  this->Advanced.push_back(0);
  this->Packed.push_back(0);
  const std::size_t l = this->Steps.size();
  this->Steps.push_back(this->Operators.coarsening(this->Owner, *this->Rows[l], *this->Rows[l + 1],
    this->Stiff, static_cast<int>(l) < this->PipelinedLevels));
  this->Steps.back()->setCheck(this->Check);
}

void HierarchyBuilder::append(int l)
{
  if (l == 0)
  {
    this->append(l, *this->Storage.finest);
  }
  else
  {
    this->append(l, *this->Storage.coarse[static_cast<std::size_t>(l - 1)]);
  }
}

template <class AnyLevel>
void HierarchyBuilder::append(int l, AnyLevel& level)
{
  std::vector<RowBlock>& ready = this->Ready[static_cast<std::size_t>(l)];
  for (RowBlock& block : ready)
  {
    level.append(std::move(block));
  }
  ready.clear();
  level.window().giveSpareRows(this->Buffers[static_cast<std::size_t>(l)]);
}

void HierarchyBuilder::pack(int l)
{
  const auto k = static_cast<std::size_t>(l);
  const LevelRows& rows = *this->Rows[k];
  LevelCoarsening& step = *this->Steps[k];
  const std::int64_t final = step.multiplied();
  const bool ended = rows.Ended && final == rows.end();
  std::int64_t& begin = this->Packed[k];
  while (begin + RowBlock::Nodes <= final || (ended && begin < final))
  {
    const std::int64_t nodes = std::min(RowBlock::Nodes, final - begin);
    this->Ready[k].push_back(
      packRows(this->Buffers[k], rows, &step.data(), begin, nodes, l > 0 && !this->Stiff.any()));
    begin += nodes;
    step.packed(begin);
    if (l >= this->PipelinedLevels)
    {
      step.release();
    }
  }
}

} // namespace smg
