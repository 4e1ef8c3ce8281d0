// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <map>
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

  /** Excludes interior facets whose second cell belongs to another part of the mesh, unless they
   * have conditions of their own. */
  void exclude(FacetSet facets) { this->Excluded = std::move(facets); }

  /** Calls found(facet, area) for each boundary facet whose lowest corner is `vertex`, which is
   * final, with its length or area, then for each inner one with conditions; the pointers of the
   * facet are valid during the call. Throws Error if a value is invalid. */
  template <class Found>
  void take(std::int64_t vertex, Found&& found)
  {
    this->Open.take(vertex,
      [&](std::int64_t middle, std::int64_t high, std::int32_t data)
      {
        const BoundaryFacet facet = this->facet(vertex, middle, high, data);
        if (!this->isExcluded(facet))
        {
          found(facet, this->areaOf(facet));
        }
        else if (const std::int32_t inside = this->insideOf(data); inside > 0)
        {
          found(this->innerFacet(vertex, middle, high, inside), this->areaOf(facet));
        }
        this->forget(data);
      });
    const auto inner = this->Inner.find(vertex);
    if (inner == this->Inner.end())
    {
      return;
    }
    for (const InnerFacet& kept : inner->second)
    {
      const BoundaryFacet facet = this->innerFacet(vertex, kept.middle, kept.high, kept.data);
      found(facet, this->areaOf(facet));
      this->forget(kept.data);
    }
    this->Inner.erase(inner);
  }

private:
  static constexpr std::size_t BatchCells = 64;

  void ask(const MeshBlock& block, std::size_t first, std::size_t cells);
  void addCell(const std::int64_t* corner, std::int64_t cell, std::size_t c);
  bool mayHaveWanted(const std::int64_t* corner) const;
  bool isWanted(const std::int64_t* vertex) const;
  /** What the problem has set on the facets of a batch. */
  struct BatchValues
  {
    std::vector<std::int32_t> flux, robin;
    std::vector<double> fluxValue, coefficient, ambient;

    bool hasAny(std::size_t facet) const
    {
      return this->flux[facet] >= 0 || this->robin[facet] >= 0;
    }
  };
  FacetBatch start(
    BatchValues& values, const MeshBlock& block, std::size_t first, std::size_t cells) const;
  std::int32_t keep(
    const int* order, const std::int64_t* corner, int k, std::size_t facet, std::int64_t cell);
  std::int32_t keep(const BatchValues* values, const int* order, const std::int64_t* vertices,
    std::size_t facet, std::int64_t cell);
  bool hasTied(const std::int64_t* corner) const;
  void requireApart(
    const CellFacet& facet, std::int32_t first, std::int32_t second, std::int64_t cell) const;
  void require(const BoundaryFacet& facet, std::int64_t name) const;
  BoundaryFacet facet(
    std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data) const;
  bool isExcluded(const BoundaryFacet& facet) const;
  /** The data of the conditions that hold if the facet is between cells; 0: none. */
  std::int32_t insideOf(std::int32_t data) const
  {
    return data > 0 ? static_cast<std::int32_t>(this->Data.at(data)[InsideLane]) : 0;
  }
  BoundaryFacet innerFacet(
    std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data) const
  {
    BoundaryFacet facet = this->facet(low, middle, high, data);
    facet.isInner = true;
    return facet;
  }
  void keepInside(const CellFacet& facet, std::int32_t data);
  double areaOf(const BoundaryFacet& facet) const;
  void forget(std::int32_t data)
  {
    if (data > 0)
    {
      this->forget(this->insideOf(data));
      this->Data.give(data);
    }
  }

  Problem& Given;
  const OpenVertices& Vertices;
  CellType Type;
  bool Asks, AsksInside;
  std::size_t Columns, Corners; // Corners: of a facet
  ConditionCounts Counts;
  OpenFacets Open;
  FacetSet Excluded;
  struct InnerFacet
  {
    std::int64_t middle, high;
    std::int32_t data;
  };
  /** Facets of two cells or more with conditions, by their lowest corner, which is open. */
  std::map<std::int64_t, std::vector<InnerFacet>> Inner;
  static constexpr int InsideLane = 2, VertexLane = 3;
  std::size_t ValueLane;
  /** The data of a facet: its two conditions, its cell, the data of those that hold if it is
   * between cells (0: none), with ties where its corners are, fluxes, coefficients and ambient
   * values. The cell is given by its
   * index in the original file, or as -1 minus its index in the stream. */
  FreeList<double> Data;
  // The block.
  const Column* CellIds = nullptr;
  std::int64_t FirstCell = 0;
  // The batch.
  BatchValues Asked, AskedInside;
};

} // namespace smg
