// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

/** The data of a problem on the facets of its cells, queried in batches and stored until it is
 * known which facets are on the boundary. The data of an interior facet are released with its
 * second cell.
 */
class ProblemFacets
{
public:
  /** A problem without data on facets is not queried; then only facets whose corners all have the
   * same Dirichlet condition are added. */
  ProblemFacets(Pool& pool, Problem& problem, CellType type, const OpenVertices& vertices);

  /** Sets the number of vertices so far. */
  void extend(std::int64_t vertices) { this->Open.extend(vertices); }
  void release(std::int64_t first) { this->Open.release(first); }

  /** Adds the facets of the cells of the block, except for cells that use a vertex twice or are
   * flagged as duplicates. Throws Error if a value is invalid. */
  void add(const MeshBlock& block);

  /** The facets so far. */
  const OpenFacets& open() const { return this->Open; }

  /** Excludes interior facets whose second cell belongs to another part of the mesh. */
  void exclude(FacetSet facets) { this->Inner = std::move(facets); }

  /** Calls found(facet, area) for each boundary facet whose lowest corner is `vertex`, which is
   * final, with its length or area; the pointers of the facet are valid during the call. Throws
   * Error if a value is invalid. */
  template <class Found>
  void take(std::int64_t vertex, Found&& found)
  {
    this->Open.take(vertex,
      [&](std::int64_t middle, std::int64_t high, std::int32_t data)
      {
        const BoundaryFacet facet = this->facet(vertex, middle, high, data);
        if (!this->isInner(facet))
        {
          found(facet, this->areaOf(facet));
        }
        this->forget(data);
      });
  }

private:
  static constexpr std::size_t BatchCells = 64;

  void ask(const MeshBlock& block, std::size_t first, std::size_t cells);
  void addCell(const std::int64_t* corner, std::int64_t cell, std::size_t c);
  bool mayHaveWanted(const std::int64_t* corner) const;
  bool isWanted(const std::int64_t* vertex) const;
  std::int32_t keep(const int* order, std::size_t facet, std::int64_t cell);
  void require(const BoundaryFacet& facet, std::int64_t name) const;
  BoundaryFacet facet(
    std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data) const;
  bool isInner(const BoundaryFacet& facet) const;
  double areaOf(const BoundaryFacet& facet) const;
  void forget(std::int32_t data)
  {
    if (data > 0)
    {
      this->Data.give(data);
    }
  }

  Problem& Given;
  const OpenVertices& Vertices;
  CellType Type;
  bool Asks;
  std::size_t Columns, Corners; // Corners: of a facet
  ConditionCounts Counts;
  OpenFacets Open;
  FacetSet Inner; ///< those that are excluded
  /** The data of a facet: its two conditions, its cell, fluxes, coefficients and ambient values.
   * The cell is given by its index in the original file, or as -1 minus its index in the stream. */
  FreeList<double> Data;
  // The block.
  const Column* CellIds = nullptr;
  std::int64_t FirstCell = 0;
  // The batch.
  std::vector<std::int32_t> Flux, Robin;
  std::vector<double> FluxValue, Coefficient, Ambient;
};

} // namespace smg
