// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Level.h"
#include "Solver/Multigrid/Cycle/RowBlockPacker.h"
#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "Solver/Multigrid/Engine/Levels.h"
#include "Solver/Multigrid/Schedule/Schedule.h"
#include "smg/Report.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace smg
{

/**
 * Builds the hierarchy while the rows of the finest level arrive. Levels below `firstCore` are
 * built in the same sweep, window by window; those from `firstCore` on, which are in memory as a
 * whole, after it.
 *
 * For each level it has a Coarsening, which makes the rows of the next level, and packs rows into
 * blocks of the window once the stages of the passes can use them. All levels advance by steps. In
 * a step each works on what the finer one handed over after the step before, so the levels, and
 * with `apart` even the stages of the three finest ones, are tasks that need not wait for each
 * other.
 */
class HierarchyBuilder
{
public:
  /** Coarsening ends at a level of at most CoarsestNodes nodes, or of more than this share of
   * the nodes of the next finer level: such a level has few strong edges or many stiff rows,
   * and further ones would shrink as little. */
  static constexpr double StalledShare = 0.8;
  /** The number of rows of the finest level that a step processes if its stages are tasks of
   * their own. */
  static constexpr std::int64_t StepNodes = 5 * RowBlock::Nodes;

  /** `stiff` finds the stiff rows of each coarse level. `apart`: for several threads, the stages
   * of each of the finest levels, where most of the work is, are tasks of their own. */
  HierarchyBuilder(Pool& pool, const CompiledOperators& operators, Levels& levels, int firstCore,
    SliverRows stiff, bool apart)
    : Owner(pool)
    , Set(operators)
    , Built(levels)
    , FirstCore(firstCore)
    , ApartLevels(operators.canRunApart && apart ? std::min(MaxApart, firstCore) : 0)
    , Stiff(stiff)
  {
    this->addRows();
    for (int l = 0; l < firstCore; ++l)
    {
      this->addStep();
    }
  }

  /** The rows of the finest level, to which the assembly appends between two steps. */
  LevelRows& finestRows() { return *this->Rows.front(); }

  /** Whether the finest level has enough rows for a step: more would only take memory. */
  bool isBusy() const
  {
    return this->ApartLevels > 0 && this->Steps.front()->waiting() > StepNodes;
  }

  /** Begins a step of all streamed levels. */
  void begin()
  {
    std::int64_t nodes = StepNodes;
    for (int l = 0; l < this->ApartLevels; ++l)
    {
      nodes = this->Steps[static_cast<std::size_t>(l)]->beginApart(nodes);
    }
  }

  /** Adds the stages of a step: those of each of the finest levels, or a whole level as one stage.
   * Each works on what the others have published before the step, and what they make for other
   * levels is handed over after it. */
  void addStages(Schedule& schedule)
  {
    using Step = LevelCoarsening;
    struct Part
    {
      const char* name;
      void (Step::*advance)();
    };
    // The longest ones of a level come first, so that no thread begins one when the others have
    // finished. Their costs are measured while they run.
    for (const Part part : { Part{ "relax P", &Step::advanceInterpolation },
           Part{ "sparsify, finish rows", &Step::advanceCoarseRows },
           Part{ "P^T A P", &Step::advanceGathering }, Part{ "A P", &Step::advanceProducts },
           Part{ "choose C-points, P0", &Step::advanceChoice } })
    {
      for (int l = 0; l < this->ApartLevels; ++l)
      {
        Step* step = this->Steps[static_cast<std::size_t>(l)].get();
        schedule.add({ part.name, l, 0.0, [step, part](bool) { (step->*part.advance)(); } });
      }
    }
    for (int l = 0; l < this->ApartLevels; ++l)
    {
      schedule.add({ "pack rows", l, 0.0, [this, l](bool) { this->pack(l); } });
    }
    for (int l = this->ApartLevels; l < this->FirstCore; ++l)
    {
      schedule.add({ "coarsen", l, 0.0, [this, l](bool) { this->advanceLevel(l); } });
    }
  }

  /** Ends a step of all streamed levels: hands over rows to the next level and blocks to the
   * windows. */
  void handOver()
  {
    for (int l = 0; l < this->FirstCore; ++l)
    {
      LevelCoarsening& step = *this->Steps[static_cast<std::size_t>(l)];
      if (l < this->ApartLevels)
      {
        step.release();
      }
      step.handOver();
      this->append(l);
    }
  }

  /** Whether all rows of the streamed levels are in their windows. */
  bool complete() const
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

  /**
   * Builds the core levels when the streamed ones are complete. It calls `addLevel(l)` for each
   * level l that is coarser than firstCore, and returns the number of the coarsest level. That may
   * be a streamed one, if it is small enough; the coarser ones that exist already are then not
   * used.
   */
  template <class AddLevel>
  int finish(AddLevel&& addLevel)
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
    this->Built.sizes.resize(static_cast<std::size_t>(l + 1));
    return l;
  }

private:
  static constexpr int MaxApart = 3; // levels

  void advanceLevel(int l)
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

  /** Packs core level l, whose rows are complete, and builds the rows of the next one, even if
   * that is not used: the interpolation and the patches of the blocks must not depend on
   * whether the coarsest level was streamed. */
  void build(int l)
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

  /** The number of nodes of a level whose rows are complete. */
  std::int64_t nodes(int l) const
  {
    const auto k = static_cast<std::size_t>(l);
    return k < this->Built.sizes.size() ? this->Built.sizes[k].nodes : this->Rows[k]->end();
  }

  bool stalled(int l) const
  {
    return static_cast<double>(this->nodes(l)) >
           StalledShare * static_cast<double>(this->nodes(l - 1));
  }

  /** Notes the size of level l and releases its rows, all of which have been packed. */
  void close(int l)
  {
    const auto k = static_cast<std::size_t>(l);
    this->Built.sizes.push_back({ this->Rows[k]->end(), this->Rows[k]->nonzeros() });
    if (k < this->Steps.size())
    {
      this->Steps[k].reset();
    }
    this->Rows[k].reset();
    this->Buffers[k].clear();
  }

  void addRows()
  {
    this->Rows.push_back(std::make_unique<LevelRows>(this->Owner));
    this->Buffers.emplace_back(this->Owner);
    this->Ready.emplace_back();
  }

  void addStep()
  {
    this->addRows();
    this->Advanced.push_back(0);
    this->Packed.push_back(0);
    const std::size_t l = this->Steps.size();
    this->Steps.push_back(this->Set.coarsening(this->Owner, *this->Rows[l], *this->Rows[l + 1],
      this->Stiff, static_cast<int>(l) < this->ApartLevels));
  }

  /** Passes the packed blocks of level l to its window, and takes the buffers of released ones
   * for reuse. */
  void append(int l)
  {
    if (l == 0)
    {
      this->append(l, *this->Built.finest);
    }
    else
    {
      this->append(l, *this->Built.coarse[static_cast<std::size_t>(l - 1)]);
    }
  }
  template <class Level>
  void append(int l, Level& level)
  {
    std::vector<RowBlock>& ready = this->Ready[static_cast<std::size_t>(l)];
    for (RowBlock& block : ready)
    {
      level.append(std::move(block));
    }
    ready.clear();
    level.window().giveSpareRows(this->Buffers[static_cast<std::size_t>(l)]);
  }

  /** Packs the blocks of level l whose nodes are all final: interpolation, and the patches of
   * neighbours. The last block may be shorter. */
  void pack(int l)
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
      if (l >= this->ApartLevels)
      {
        step.release();
      }
    }
  }

  Pool& Owner;
  const CompiledOperators& Set;
  Levels& Built;
  int FirstCore;
  int ApartLevels; // number of levels whose stages are tasks
  SliverRows Stiff;
  std::vector<std::unique_ptr<LevelRows>> Rows;
  std::vector<std::unique_ptr<LevelCoarsening>> Steps;
  std::vector<std::int64_t> Advanced, Packed;
  std::vector<std::vector<RowBlock>> Ready; // packed, not yet in the windows
  std::vector<SpareBuffers> Buffers;
};

} // namespace smg
