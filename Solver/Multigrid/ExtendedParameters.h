// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

namespace smg
{

/** Parameters of the operator set Extended; the defaults are those for triangles. */
struct ExtendedParameters
{
  /** IndependentSetLifting::strength, sliverStrength and cancelling. */
  float strength = 0.2F;
  float sliverStrength = 0.5F;
  float cancelling = 1.2F;
  /** ExtendedInterpolation::finestEntries, entries and sweeps. */
  int finestEntries = 3;
  int entries = 4;
  int sweeps = 1;
  /** Patches::setRings(). */
  int patchRings = 1;
  /** GalerkinProduct::cancelling. */
  double coarseCancelling = 1.1;
  /** Sparsification::dropsNegative. */
  bool dropsNegative = false;

  /**
   * The parameters that were best in experiments. A strength of 0.2 instead of 0.1 on surfaces
   * costs 5 to 10 % of memory and time per V-cycle and saves up to a third of the V-cycles on real
   * scans. Of slivers alone, 0.5 costs nothing and saves a sixth to a half of the V-cycles on
   * lattices of obtuse triangles. On tetrahedra 0 treats the small weights of slivers as strong,
   * and values above 0.1 cost more memory than they save V-cycles. Keeping rows that cancel little,
   * and negative weights without a common neighbour, pays off only on surfaces.
   *
   * Most of the set-up is the product from the finest level to the next one. Fewer entries there
   * save some of it where slivers do not need them. A second sweep of the interpolation saves at
   * most an eighth of the V-cycles on slivers, and needs one more ring in every window.
   */
  static ExtendedParameters forCells(CellType type)
  {
    ExtendedParameters parameters;
    if (type == CellType::Tetrahedron)
    {
      parameters.strength = parameters.sliverStrength = 0.08F;
      parameters.entries = 5;
      parameters.patchRings = 2;
      parameters.cancelling = 1.5F;
      parameters.coarseCancelling = 1.5;
      parameters.dropsNegative = true;
    }
    return parameters;
  }

  /** For a given number of V-cycles: each is up to twice as effective, the set-up takes longer. */
  static ExtendedParameters forFewCycles(CellType type)
  {
    ExtendedParameters parameters = forCells(type);
    parameters.finestEntries = parameters.entries;
    if (type == CellType::Tetrahedron)
    {
      parameters.strength = parameters.sliverStrength = 0.05F;
      parameters.sweeps = 2;
    }
    return parameters;
  }
};

} // namespace smg
