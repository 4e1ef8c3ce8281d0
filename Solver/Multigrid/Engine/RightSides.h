// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Assembly/KnownLinks.h"
#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "smg/Export.h"

#include <cstdint>
#include <vector>

namespace smg
{

/**
 * What further right-hand sides need besides the rows of the finest level, which are in memory: the
 * vertices whose rows are those of the identity, the edges to them, which rows omit, and how the
 * residual of each row counts. It is collected in the first pass, and takes memory where there is
 * something to say.
 */
class SMG_EXPORT RightSides final : public RowListener
{
public:
  explicit RightSides(Pool& pool)
    : Memory(pool)
  {
  }

  // During the first pass:

  void link(std::int32_t delta, double weight) override;
  void unknown(double share, std::int32_t label) override;
  void close(const double* point, std::int64_t reach) override;

  // Afterwards, with x and b of all vertices in the window:

  /** Sets x to b where rows are those of the identity. */
  void setKnown(LevelWindow<double>& finest) const;
  /** Adds w_ij x_j of the neighbours with such rows to b of the others. */
  void addKnown(LevelWindow<double>& finest) const;
  /** The residual b - A x as the first pass sums it up, to the last bit. Counts b, x and the
   * residual for the components, which must have no counts. */
  InitialResidual residual(
    LevelWindow<double>& finest, Components& components, ComponentLabels& labels) const;

private:
  /** What there is to say of RowBlock::Nodes vertices, which are numbered from the first of them.
   */
  struct Block
  {
    /** From this node on, unknowns are of this component. */
    struct Run
    {
      std::int16_t begin;
      std::int32_t label;
    };

    std::vector<KnownLink<double>> links;
    std::vector<std::int16_t> known; ///< ascending
    std::vector<double> shares;      ///< of all nodes; empty: 1
    std::vector<Run> runs;

    std::int64_t bytes() const;
  };

  Block& block();
  template <class Arrays>
  void addRows(const Arrays& rows, const BlockPart<double>& part, InitialResidual& sum,
    Components& components, ComponentLabels& labels) const;

  std::vector<Block> Blocks;
  Reservation Memory;
  std::int64_t Vertices = 0;
  bool IsUnknown = false; // the next vertex
};

} // namespace smg
