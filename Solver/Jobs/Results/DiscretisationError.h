// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/ProblemFacets.h"
#include "Solver/Assembly/WeightedCells.h"
#include "Solver/Mesh/StreamCheck.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** Squares of energy norms, ||v||^2 = the integral of grad v . K grad v, summed over the columns.
 */
struct EnergySquares
{
  double error = 0.0;    ///< of the discretisation, estimated
  double solution = 0.0; ///< of the solution itself
};

/**
 * Estimates how far linear finite elements on this mesh are off, from the jumps of the flux across
 * the facets between cells (Kelly, Gago, Zienkiewicz and Babuska 1983; on surfaces Demlow and Dziuk
 * 2007), in one pass over the mesh.
 *
 * With w the weights of a cell and u the solution, the flux out of the cell through its facet
 * opposite to corner k, integrated, is d R_k, R_k = sum_j w_kj (u_j - u_k) and d the dimension of
 * the cells; s_k = sum_j w_kj is the conductance across the facet. So neither gradients nor tensors
 * are needed, and conormals of surfaces need no plane:
 *
 *     error^2 = d / 12 * sum over facets of (sum over its cells of R)^2 / (mean over these of s),
 *
 * which is exact where only one coordinate counts and all s are equal. The mean is that of s, not
 * of 1/s, so that beside a poor conductor the flux counts by the good one that it is in (Petzoldt
 * 2002). On the boundary, R is reduced by the prescribed inflow; facets with prescribed corners do
 * not count. Against true errors it is within 0.7 and 1.35, of smooth solutions and with a
 * conductivity that jumps (Testing/Solver/DiscretisationErrorTest.cpp). What it does not see: the
 * shape of a curved surface, and data, sources and screening that change within a cell.
 *
 * In memory are the open vertices and facets. The sums are in the order of the vertices, so they do
 * not depend on blocks.
 */
class SMG_EXPORT DiscretisationError
{
public:
  /** Reads the solution at the vertices [first, first + count): `columns` values each. */
  using ReadValues =
    std::function<void(std::int64_t first, std::int64_t count, std::span<double> values)>;

  /** `problem` is queried again, from the first block on. */
  DiscretisationError(Pool& pool, const StreamInfo& info, Problem& problem, ReadValues readValues);

  void add(const MeshBlock& block);
  /** After the last block. */
  EnergySquares finish();

private:
  void addVertices(const MeshBlock& block);
  void addCell(const WeightedCell& cell);
  std::int32_t termsOf(const std::int64_t* corners);
  void finalize(std::int64_t final);
  void addInflows(std::int64_t vertex);
  bool isPrescribed(std::int64_t low, std::int64_t middle, std::int64_t high) const;

  CellType Type;
  std::size_t Columns;
  ReadValues Read;
  StreamCheck Check;
  OpenVertices Vertices;  // their values are the solution
  WeightedCells Weighted; // with the weights of the solve
  std::optional<ProblemFacets> Conditions;
  OpenFacets Facets;
  /** For each facet: the sum of R (`columns` numbers), the sum of s, and the number of cells. */
  FreeList<double> Terms;
  std::vector<double> Values;
  EnergySquares Sums;
  std::int64_t Final = 0;
};

} // namespace smg
