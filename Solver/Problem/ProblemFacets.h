// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/BoundaryFacet.h"
#include "Solver/Problem/OpenFacets.h"
#include "Solver/Problem/OpenVertices.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * What a problem says of the facets of its cells: asks for it, a batch of cells at a time, and
 * keeps it until it is known which facets are the boundary's. What is said of a facet inside is
 * forgotten with its second cell.
 */
class ProblemFacets
{
public:
  /**
   * Of a problem without facets() nothing is asked, and only those facets are taken whose corners
   * all have the same Dirichlet condition.
   */
  ProblemFacets(Pool& pool, Problem& problem, CellType type, const OpenVertices& vertices);

  /** As many vertices have come. */
  void extend(std::int64_t vertices) { this->Open.extend(vertices); }
  void release(std::int64_t first) { this->Open.release(first); }

  /**
   * Takes the facets of the block's cells: all but those of cells that use a vertex twice or are
   * flagged as duplicates. Throws Error if an answer is not valid.
   */
  void add(const MeshBlock& block);

  /** Calls found(facet) for each boundary facet whose lowest corner is `vertex`, which is final;
   * what the facet points to holds for the call. Throws Error if a value is not valid. */
  template <class Found>
  void take(std::int64_t vertex, Found&& found)
  {
    this->Open.take(vertex,
      [&](std::int64_t middle, std::int64_t high, std::int32_t data)
      {
        found(this->facet(vertex, middle, high, data));
        this->forget(data);
      });
  }

private:
  static constexpr std::size_t BatchCells = 64;

  void ask(const MeshBlock& block, std::size_t first, std::size_t cells);
  void addCell(const MeshBlock& block, std::size_t first, std::size_t c);
  bool mayHaveWanted(const std::int64_t* corner) const;
  bool isWanted(const std::int64_t* vertex) const;
  std::int32_t keep(const int* order, std::size_t facet, std::int64_t cell);
  void require(const BoundaryFacet& facet, std::int64_t name) const;
  BoundaryFacet facet(
    std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data) const;
  void forget(std::int32_t data)
  {
    if (data > 0)
    {
      this->Kept.give(data);
    }
  }

  Problem& Given;
  const OpenVertices& Vertices;
  CellType Type;
  bool Asks;
  std::size_t Columns, Corners; // Corners: of a facet
  ConditionCounts Counts;
  OpenFacets Open;
  /** Of a facet: its conditions, its cell's name, flux, coefficients, ambient. The name is the
   * number in the original file, or -1 less that in the stream. */
  Slots<double> Kept;
  // The block.
  const Column* CellIds = nullptr;
  std::int64_t FirstCell = 0;
  // The batch.
  std::vector<std::int32_t> Flux, Robin;
  std::vector<double> FluxValue, Coefficient, Ambient;
};

} // namespace smg
