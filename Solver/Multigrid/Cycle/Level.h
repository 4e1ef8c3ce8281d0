// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Cycle/Sweep.h"
#include "Solver/Multigrid/Cycle/Transfer.h"
#include "Solver/Multigrid/Schedule/Cursor.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/** The power of two that scales numbers of this size to about 1, so that nothing is rounded; 1 if
 * the size is not a usable number. */
inline double scaleFor(double typical)
{
  const bool isUsable =
    typical > std::numeric_limits<double>::min() && typical < std::numeric_limits<double>::max();
  return isUsable ? std::exp2(-std::ilogb(typical)) : 1.0;
}

/**
 * A level in a pass: its window and its stages. Real is double on the finest level and float on the
 * others, which only precondition.
 *
 * The schedule follows from one rule: a stage may advance over a group of nodes once the stage
 * before it has passed the largest index that the group depends on. For a sweep this is the largest
 * neighbour (RowBlock::Header::reach()), for restriction the largest parent, for the first sweep on
 * a coarse level the largest child. Nodes below have then been processed by both stages, nodes
 * above only by the earlier one: exactly the state that Gauss-Seidel in stream order has when all
 * stages run one after the other over the whole level. The results are therefore the bits of the
 * in-core method, for any window, step and number of threads.
 *
 * The paper instead keeps counters in each node and notifies neighbours (section 2.2). Cursors need
 * no counters per node, and little more memory if the span of the stream order is close to its
 * width.
 */
template <class Real>
class Level
{
public:
  using CoarseLevel = Level<float>;
  friend class Level<double>;

  Level(Pool& pool, ResidentNodes& resident, int index, int columns, int sweeps,
    const CompiledRelaxation& relaxation)
    : Relax(relaxation.table<Real>())
    , Window(pool, resident, index, columns)
    , At(sweeps)
    , Squares(2 * static_cast<std::size_t>(strideOf(columns)))
  {
  }

  LevelWindow<Real>& window() { return this->Window; }
  const LevelCursors& cursors() const { return this->At; }
  void setCoarse(CoarseLevel* coarse) { this->Coarse = coarse; }
  void setFine(const LevelCursors* fine) { this->Fine = fine; }
  /** Makes this a core level: it takes no part in the passes; the core cycle processes it
   * between them. */
  void setCore() { this->Core = true; }
  bool core() const { return this->Core; }

  void startPass(bool first)
  {
    this->First = first;
    this->History = nullptr;
    this->At.rewind();
    std::fill(this->Squares.begin(), this->Squares.end(), Real{});
    if (this->Energy)
    {
      this->Energy->startPass(first);
    }
    if (this->Flow)
    {
      this->Flow->startPass();
    }
    this->Window.startPass(first);
    if (this->Core)
    {
      this->Window.zeroB(0, this->Window.nodes());
    }
  }

  /** Between passes: saves and restores all that later passes need. */
  void save(StateWriter& state)
  {
    state.part("level");
    state(this->Scale, this->Patched, this->Window);
  }
  void load(StateReader& state)
  {
    state.part("level");
    state(this->Scale, this->Patched, this->Window);
  }

  void endPass()
  {
    this->Window.endPass();
    if (this->History)
    {
      this->History->endPass();
    }
  }

  /**
   * Restriction in the next pass multiplies by `scale`, a power of two, and the prolongation of
   * that pass, which finishes the V-cycle before, divides by the scale before. So the numbers in
   * single precision depend neither on units nor on the size of the residual, and nothing is
   * rounded by scaling.
   */
  void setScale(Real scale)
  {
    this->Unscale = 1 / this->Scale;
    this->Scale = scale;
  }

  /** The next prolongation adds nothing, since the coarse levels have another right-hand side:
   * setScale() then divides by infinity. */
  void skipNextCorrection() { this->Scale = std::numeric_limits<Real>::infinity(); }

  /** On the finest level, in a pass after LevelWindow::renew(): the state of the downward part
   * is complete for nodes below `end`. */
  void setRenewed(std::int64_t end) { this->At.renewed = end; }

  /** On the finest level: accelerates the iterates of this pass, which has started; null: it
   * does not. */
  void setHistory(IterateHistory* history) { this->History = history; }
  /** On the finest level: sums the energies of the iterates there; null: it does not. */
  void setEnergy(IterateEnergy* energy) { this->Energy = energy; }
  /** On the finest level: measures what flows in the iterates there; null: it does not. */
  void setFlow(IterateFlow* flow) { this->Flow = flow; }

  /** The end of the nodes from `end` on whose x is final in the upward part, as seen by a stage
   * that `follows` it on the same thread, or does not. */
  std::int64_t finishedUp(std::int64_t end, bool follows) const
  {
    const std::int64_t swept = this->At.postSweep.back().seen(follows);
    return this->endPatched() ? this->Window.reachable(end, swept, true) : swept;
  }

  /** Adds the next block of rows while the hierarchy is built. */
  void append(RowBlock block)
  {
    // Already with the first member of a patch: the last one, where the sweep relaxes it, may be in
    // a later block. Special nodes need not be in patches, though; then stages wait longer than
    // necessary, with the same result.
    const RowBlock::Header& h = block.header();
    this->Patched = this->Patched || h.specials > 0;
    if (this->Coarse)
    {
      this->Coarse->window().extendB(
        h.parentReach[LevelWindow<Real>::groupIn(h, h.first + h.nodes - 1)] + 1);
    }
    this->Window.append(std::move(block));
  }

  /** Loads, on this and the coarser levels, all data that the upward part needs to finish nodes
   * 0 .. node. */
  void load(std::int64_t node);

  // The stages (LevelStages.cpp), in the order in which nodes pass them. VCycle.h declares them to
  // a schedule.

  /** The number of sweeps of each half of the V-cycle. */
  std::size_t sweeps() const { return this->At.preSweep.size(); }
  CoarseLevel& coarse() { return *this->Coarse; }
  bool isAccelerated() const { return this->History != nullptr; }

  void prolong(bool follows);
  void postSweep(std::size_t s, bool follows);
  void preSweep(std::size_t s, bool follows);
  void combine(bool follows);
  void restrict(bool follows);

  /** Publishes the cursors of this and the coarser levels for stages on other threads; between
   * two steps. */
  void publish()
  {
    this->At.publish();
    if (!this->Coarse->core())
    {
      this->Coarse->publish();
    }
  }

  /** Adds tasks that prefetch what load() will take next, on this and the coarser levels. They
   * may run beside all stages. */
  void addReaders(Schedule& schedule)
  {
    schedule.addBeside([this] { this->Window.readAhead(); });
    if (this->History)
    {
      schedule.addBeside([this] { this->History->readAhead(); });
    }
    if (!this->Coarse->core())
    {
      this->Coarse->addReaders(schedule);
    }
  }

  /** Adds tasks that write what the downward part has finished, on this and the coarser levels.
   * They may run beside all stages. */
  void addWriters(Schedule& schedule)
  {
    schedule.addBeside([this] { this->writeWindow(); });
    if (this->History)
    {
      schedule.addBeside([this] { this->writeHistory(); });
    }
    if (!this->Coarse->core())
    {
      this->Coarse->addWriters(schedule);
    }
  }

  /** Traces what this and the coarser levels have in memory. */
  void addWindows(StepTrace& trace) const
  {
    const LevelWindow<Real>& window = this->Window;
    trace.addWindow(
      window.index(), [&window] { return window.first(); }, [&window] { return window.loaded(); });
    if (!this->Coarse->core())
    {
      this->Coarse->addWindows(trace);
    }
  }

  /** Releases written data that no stage needs any more; between two steps. */
  void release()
  {
    this->Window.release(this->At.restricted);
    if (this->History)
    {
      this->History->release();
    }
    if (!this->Coarse->core())
    {
      this->Coarse->release();
    }
  }

  /** Publishes the cursors, writes what the downward part has finished, and releases what no
   * stage needs any more. */
  void settle()
  {
    this->publish();
    this->write();
    this->release();
  }

  /** Whether all nodes have passed all stages of the pass. */
  bool finished() const { return this->At.restricted == this->Window.nodes(); }

  /** Whether x of node `node`, for which load() was asked, is final in the upward part, as seen
   * by a stage that `follows` it. */
  bool isFinal(std::int64_t node, bool follows) const
  {
    return this->Core || this->At.postSweep.back().seen(follows) > this->finalWith(node);
  }

  /** Prepares b of nodes 0 .. node for restriction, that is, sets it to zero, once the V-cycle
   * before needs neither the b nor the x of these nodes. Returns whether this was possible. */
  bool prepare(std::int64_t node);

  /** ||b - A x||^2 of each column, from the restriction of the last pass. */
  std::span<const Real> squares() const { return std::span(this->Squares).first(this->lanes()); }
  /** The same for the terms A_ii x_i, on the finest level. */
  std::span<const Real> termSquares() const
  {
    return std::span(this->Squares).subspan(this->lanes());
  }

  // A whole level in memory at once, with the same kernels.

  void relaxDown()
  {
    for (std::size_t s = 0; s < this->sweeps(); ++s)
    {
      // The first sweep starts from x = 0, which need not be stored first.
      this->relax(0, this->Window.nodes(), this->Window.down(), s == 0,
        s == 0 ? SweepKind::LowerOnly : SweepKind::Forward);
    }
  }
  void relaxUp()
  {
    for (std::size_t s = 0; s < this->sweeps(); ++s)
    {
      this->relax(0, this->Window.nodes(), this->Window.up(), s == 0, SweepKind::Forward);
    }
  }
  /** The transpose of relaxDown(): its sweeps backwards, in the opposite order. */
  void relaxUpBackward();
  /** Stores b - A x, with the stride of the window. */
  void residualAll(Real* residual)
  {
    this->forAll(this->Window.down(), StoreResidual<Real>{ residual });
  }
  void restrictAll() { this->forAll(this->Window.down(), this->restriction()); }
  void prolongAll() { this->forAll(this->Window.up(), this->prolongation()); }

private:
  void write()
  {
    this->writeWindow();
    this->writeHistory();
    if (!this->Coarse->core())
    {
      this->Coarse->write();
    }
  }
  void writeWindow()
  {
    // If the last sweep relaxes patches, the end of an unfinished patch may still change nodes
    // before it.
    this->Window.write((this->endPatched() ? this->At.restricted : this->At.combined).published());
  }
  void writeHistory()
  {
    if (this->History)
    {
      this->History->write(this->At.restricted.published());
    }
  }

  /** The end of the nodes from `cursor` on whose neighbours sweep s of `sweeps` has passed, and
   * does not touch any more: the first sweep relaxes patches, whose nodes change at the end of
   * the patch. */
  std::int64_t reachable(
    std::int64_t cursor, const std::vector<Cursor>& sweeps, std::size_t s, bool follows) const
  {
    return this->Window.reachable(cursor, sweeps[s].seen(follows), s == 0 && this->Patched);
  }
  /** Whether the last sweep of each half of the V-cycle is also its first one, which relaxes
   * patches. */
  bool endPatched() const { return this->Patched && this->At.preSweep.size() == 1; }

  std::size_t lanes() const { return this->Squares.size() / 2; }

  using State = typename LevelWindow<Real>::State;
  /** One sweep over [begin, end). */
  void relax(
    std::int64_t begin, std::int64_t end, State& state, bool relaxesPatches, SweepKind sweep);
  Prolongation<Real> prolongation() { return { this->Coarse->window().x(), this->Unscale }; }
  Restriction<Real> restriction()
  {
    Real* squares = this->Squares.data();
    return { this->Coarse->window().b(), this->Scale, squares, squares + this->lanes(),
      this->History, this->Energy, this->Flow };
  }
  template <class Kernel>
  void forAll(State& state, const Kernel& kernel)
  {
    this->Window.forColumns(0, this->Window.nodes(), state, kernel);
  }

  std::int64_t finalWith(std::int64_t node) const;
  void load(int stage, std::int64_t node);
  std::int64_t firstPreSweepEnd(bool follows);

  const SweepTable<Real>& Relax;
  LevelWindow<Real> Window;
  LevelCursors At;
  std::vector<Real> Squares; // squares of the residual, then of its terms, a lane each
  CoarseLevel* Coarse = nullptr;
  const LevelCursors* Fine = nullptr;
  IterateHistory* History = nullptr;
  IterateEnergy* Energy = nullptr;
  IterateFlow* Flow = nullptr;
  Real Scale = 1;
  Real Unscale = 1;
  bool First = true;
  bool Core = false;
  bool Patched = false; // some nodes may be relaxed together with later ones
};

extern template class Level<double>;
extern template class Level<float>;

} // namespace smg
